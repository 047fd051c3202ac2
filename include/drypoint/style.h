/* drypoint/style.h: which lines are drawn, how they are found, their widths and colours.
 *
 * The classes of lines (Raskar 2001, 1 and 2; docs/lines.md):
 *
 *     silhouette    edge between a front-facing and a back-facing polygon
 *     ridge         edge between two front-facing polygons, dihedral angle <= ridge_angle (theta)
 *     valley        edge between two front-facing polygons, dihedral angle >  valley_angle (phi)
 *     border        edge with one polygon
 *     intersection  where the interiors of two polygons cross
 *     section       outline of a section, where a clip plane cuts the model (section.h)
 *     hatching      parallel lines on the faces of a section
 *
 * The dihedral angle is that of Raskar 2001, 2.2: 180 degrees minus the angle between the normals
 * on a convex edge, plus it on a concave one; flat = 180. */
#ifndef DRYPOINT_STYLE_H
#define DRYPOINT_STYLE_H

#include <drypoint/shade.h>
#include <drypoint/strokes.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum dp_line {
    DP_LINE_SILHOUETTE = 0,
    DP_LINE_RIDGE,
    DP_LINE_VALLEY,
    DP_LINE_INTERSECTION,
    DP_LINE_BORDER,
    DP_LINE_SECTION,
    DP_LINE_HATCHING,
    DP_LINE_COUNT
} dp_line;

/* Sets of line classes. */
#define DP_SILHOUETTE       (1u << DP_LINE_SILHOUETTE)
#define DP_RIDGE            (1u << DP_LINE_RIDGE)
#define DP_VALLEY           (1u << DP_LINE_VALLEY)
#define DP_INTERSECTION     (1u << DP_LINE_INTERSECTION)
#define DP_BORDER           (1u << DP_LINE_BORDER)
#define DP_SECTION          (1u << DP_LINE_SECTION)
#define DP_HATCHING         (1u << DP_LINE_HATCHING)
#define DP_SIL_RIDGE_VALLEY (DP_SILHOUETTE | DP_RIDGE | DP_VALLEY) /* Raskar 2001, Figure 3 */
#define DP_ALL_LINES        (DP_SIL_RIDGE_VALLEY | DP_INTERSECTION | DP_BORDER | DP_SECTION | DP_HATCHING)
#define DP_NO_LINES         (1u << 31)

#define DP_COLOR_NONE 0xFFFFFF00u
#define DP_RGB(r, g, b)                                                                            \
    (((dp_color)(r) << 24) | ((dp_color)(g) << 16) | ((dp_color)(b) << 8) | 0xFFu)

/* How the added polygons of DP_INK_QUADS get their shape. */
typedef enum dp_method {
    DP_METHOD_EXACT = 0, /* built on the screen: exact widths in px; the plane's depth, limited */
    DP_METHOD_PAPER      /* the formulas of Raskar 2001, 2.1 to 2.3, as printed */
} dp_method;

/* The between-test of DP_INK_QUADS, which tells valleys and intersections from what is merely
 * hidden (Raskar 2001, 2.3 and 2.4). */
typedef enum dp_between {
    DP_BETWEEN_PLANE = 0, /* two passes: the planes cross within half a line width; independent of
                             the polygons' order */
    DP_BETWEEN_INTERVAL,  /* two depth buffers z1, z2 = z1 + offset, one pass (Raskar 2001, 2.3) */
    DP_BETWEEN_STENCIL    /* one depth and one stencil buffer, three passes (Raskar 2001, 7) */
} dp_between;

/* Where lines come from. */
typedef enum dp_edges {
    DP_EDGES_EMERGENT = 0, /* from the tiles, without knowledge of neighbours */
    DP_EDGES_ADJACENCY     /* from adjacency, built once per topology (Hermosilla and Vázquez 2010,
                              2.3) */
} dp_edges;

typedef enum dp_ink {
    DP_INK_STROKES = 0, /* visible segments, drawn as strokes with round ends */
    DP_INK_QUADS        /* the added polygons themselves are the line (Raskar 2001). A border cannot
                           be told from a ridge: it is drawn as a ridge, or in its own colour when
                           ridges are off */
} dp_ink;

typedef struct dp_line_style {
    float width;    /* the whole visible width, px; 0 means 2; 0.5 to 64 */
    dp_color color; /* 0 means black */
} dp_line_style;

/* How lines look that something hides (docs/lines.md). With DP_INK_STROKES and DP_EDGES_EMERGENT. */
typedef enum dp_hidden_look {
    DP_HIDDEN_NONE = 0, /* not drawn, not looked for */
    DP_HIDDEN_DASHED,   /* 12 widths drawn, 3 not (ISO 128-2); a little more or less, so that lines
                           begin and end with a dash */
    DP_HIDDEN_DOTTED,   /* round dots, one every 3 widths */
    DP_HIDDEN_THIN,     /* whole, but narrow */
    DP_HIDDEN_SOLID     /* whole, and as wide as visible ones */
} dp_hidden_look;

enum { DP_LEVELS = 8 /* the most that are told apart */ };

/* Hidden lines, drawn below visible ones, which they do not change. A line's level says how many
 * front-facing surfaces lie between it and the eye, and is 1 at least where anything hides it;
 * `levels` or more count as `levels`. DP_ERR_ARGUMENT with DP_INK_QUADS or DP_EDGES_ADJACENCY. Look,
 * levels and smooth hold for all groups (dp_draw_grouped, immediate.h). */
typedef struct dp_hidden {
    dp_hidden_look look;
    uint32_t levels; /* 1 to DP_LEVELS; 0 means 1: hidden by anything */
    bool smooth;     /* also folds of less than 40 degrees, which drawing offices leave out
                        (docs/lines.md) */
    /* By level - 1 and class. width: 0 means half the visible line's, or the same if solid; color: 0
     * means the visible line's. */
    dp_line_style line[DP_LEVELS][DP_LINE_COUNT];
} dp_hidden;

/* What is drawn as curved PN triangles (Vlachos et al. 2001; Raskar 2001, 5): each triangle becomes a
 * cubic patch over its own corners and their normals, cut into small ones for the picture
 * (docs/smooth.md). Normals are those that shading uses (dp_shade.normals; those of SMOOTH where the
 * model has none). */
typedef enum dp_smoothing {
    DP_SMOOTH_OFF = 0,
    DP_SMOOTH_SILHOUETTES, /* near silhouettes alone; all else stays as it is */
    DP_SMOOTH_SURFACE      /* the whole surface: folds, shading and what hides lines, too */
} dp_smoothing;

enum { DP_SMOOTH_LEVELS = 6 };

/* A pattern on lines (Raskar 2001, 2.1: "interesting patterns of silhouette edges can be rendered by
 * texture mapping the enlarged part", and 5; docs/patterns.md). A texture's u runs along the line, its
 * v across it: of outlines as quads from the edge (0) to the outer border (1); of all other lines
 * from one side (0) to the other (1). Its ink is as of stroke textures: it takes the line's colour,
 * or brings its own. With DP_INK_STROKES the first style's is a stroke texture whose u is DP_STROKE_WORLD (or,
 * `screen`, DP_STROKE_ARC), and dp_style.stroke.texture must be NULL or the same. With DP_INK_QUADS
 * intersections, which have no edge, stay plain. DP_ERR_ARGUMENT with DP_INK_QUADS and
 * DP_EDGES_ADJACENCY, whose silhouettes have stroke.texture. */
typedef struct dp_pattern {
    const dp_texture *texture; /* NULL: no pattern; must outlive the drawing */
    float length;       /* of one repeat, px in the middle of the model's box; 0 means natural: as
                           the texture is to its height, so is the repeat to the line's width, times stroke.scale */
    float world_length; /* of one repeat, in the model's units; 0: as `length` says */
    bool screen; /* repeats are equally long on the screen: they do not stick to the surface */
} dp_pattern;

/* How light falls on lines (Raskar 2001, 5; docs/patterns.md). `c` is the line's colour, N·L the
 * cosine between what it lies on and dp_shade.light. */
typedef enum dp_line_lighting {
    DP_LINE_LIGHT_OFF = 0,
    DP_LINE_LIGHT_LAMBERT, /* c + t (lit - c), t = max(N·L, 0) */
    DP_LINE_LIGHT_TOON,    /* the same, t in three steps: 0, 1/2, 1 */
    DP_LINE_LIGHT_GOOCH /* cool to warm, t = (1 + N·L) / 2, by gooch_… of dp_shade with k_d = c */
} dp_line_lighting;

typedef struct dp_line_light {
    dp_line_lighting lighting;
    dp_color lit; /* of what the light falls on squarely; its alpha says how much of it is taken.
                     0 means the paper's colour, four fifths of it */
} dp_line_light;

/* Zero is the default: `dp_style style = {0};` draws every class, 2 px wide, black on white. */
typedef struct dp_style {
    uint32_t lines;                    /* set of classes; 0 means DP_ALL_LINES; or DP_NO_LINES */
    dp_line_style line[DP_LINE_COUNT]; /* indexed by dp_line */
    float ridge_angle;                 /* theta, degrees in (0, 360); 0 means 150 */
    float valley_angle;                /* phi, degrees in (0, 360); 0 means 210 */
    dp_edges edges;
    dp_stroke_style stroke;   /* textures, taper, jitter: strokes.h */
    dp_pattern pattern;       /* on lines, along and across, in perspective; default: none */
    dp_line_light line_light; /* on lines; default: none */
    dp_method method;
    dp_between between;
    dp_ink ink;

    /* How often polygons are gone through; 0 means the first value.
     *     strokes             2, 1   1: a streamed source is read once (dp_draw)
     *     quads, plane        2
     *     quads, interval     1, 2   1: as printed; 2: independent of the polygons' order
     *     quads, stencil      3
     *     DP_EDGES_ADJACENCY  1, 2   the same picture */
    int passes;
    float between_offset; /* interval, stencil: z2 - z1, in pixel sizes at the surface; 0 means 1 */
    dp_color paper;       /* 0 means white */
    dp_color surface;     /* 0 means white; DP_COLOR_NONE: hides, but shows the paper */
    dp_color section;     /* of sections' faces (section.h); 0 means that of what was cut */
    bool cull_back_faces; /* do not paint back faces as surface (closed models lose nothing) */
    dp_hidden hidden;     /* strokes: lines that something hides; default: none */
    /* X-ray (Raskar 2001, 5: partially transparent front-facing polygons; docs/xray.md): the opacity of
     * each surface, 0 to 1; 0 and 1: opaque, as ever. Lines that are hidden shine through: as `hidden`
     * says; by default whole, as wide as visible ones, smooth folds too, and by level up to xray_layers.
     * Each layer above takes its share of them. DP_ERR_ARGUMENT with DP_INK_QUADS or DP_EDGES_ADJACENCY. */
    float xray;
    uint32_t
        xray_layers; /* surfaces that are told apart in a pixel's sample, 1 to DP_LEVELS; 0 means
                             DP_LEVELS; what lies deeper is not drawn (dp_stats.xray_lost). Of the
                             first style */
    /* Strokes: where something hides a line, its end is solved, not taken midway between two sample
     * points a quarter of a pixel apart; and what is a line on a closed surface is decided as finely
     * (docs/lines.md). Of the picture; not where the source is streamed. */
    bool exact_ends;
    /* Strokes: how much is drawn of a scan, or of a coarse model (docs/clean-lines.md). 0: all lines, as
     * exact as the polygons are. 1: what a person would draw at this size; 2: twice as fine; 0.5: half
     * as fine; 0.01 to 100. Lines are left out, cut and thinned, never moved; borders,
     * intersections, sections and hatching are all drawn. Of the picture. */
    float detail;
    bool edge_table_off;  /* strokes: do not resolve edges in the tile's table; all lines emerge */
    dp_shade shade;       /* shading of surfaces */
    dp_edge_map edge_map; /* default: off */
    dp_mirror mirror;     /* default: none */

    /* Drawn from memory, whatever the model's size. Of the picture. DP_ERR_LIMIT where that makes
     * more than 2^30 polygons or vertices. */
    dp_smoothing smooth;
    uint32_t
        smooth_level; /* points on each curved edge between its ends, 1 to DP_SMOOTH_LEVELS; 0: by
                              size on the screen, up to 15 */
} dp_style;

/* Fills in every default. With DP_ERR_ARGUMENT, *diag names the member that is out of range. */
DP_API dp_result dp_style_resolve(const dp_style *style, dp_style *resolved, dp_diag *diag);

/* "silhouette", "ridge", "valley", "intersection", "border", "section", "hatching". */
DP_API const char *dp_line_name(dp_line line);

#ifdef __cplusplus
}
#endif
#endif
