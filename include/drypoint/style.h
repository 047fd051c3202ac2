/* drypoint/style.h: which lines, how wide, in which colour, found and inked how.
 *
 * Words (docs/lines.md): a silhouette is an edge between a front-facing and a back-facing polygon;
 * a border has one polygon; the dihedral angle is measured between the front sides' insides, 180
 * degrees = flat; a ridge has a dihedral angle <= ridge_angle (theta), a valley one > valley_angle
 * (phi), both between two front-facing polygons; an intersection is where the interiors of two
 * polygons cross. */
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
    DP_LINE_COUNT
} dp_line;

/* Sets of line classes. */
#define DP_SILHOUETTE       (1u << DP_LINE_SILHOUETTE)
#define DP_RIDGE            (1u << DP_LINE_RIDGE)
#define DP_VALLEY           (1u << DP_LINE_VALLEY)
#define DP_INTERSECTION     (1u << DP_LINE_INTERSECTION)
#define DP_BORDER           (1u << DP_LINE_BORDER)
#define DP_SIL_RIDGE_VALLEY (DP_SILHOUETTE | DP_RIDGE | DP_VALLEY) /* Raskar 2001, Figure 3 */
#define DP_ALL_LINES        (DP_SIL_RIDGE_VALLEY | DP_INTERSECTION | DP_BORDER)
#define DP_NO_LINES         (1u << 31)

#define DP_COLOR_NONE 0xFFFFFF00u
#define DP_RGB(r, g, b)                                                                            \
    (((dp_color)(r) << 24) | ((dp_color)(g) << 16) | ((dp_color)(b) << 8) | 0xFFu)

/* How the added polygons of DP_INK_QUADS get their shape. */
typedef enum dp_method {
    DP_METHOD_EXACT = 0, /* built on the screen: widths exact in pixels, plane depth with a limit */
    DP_METHOD_PAPER      /* the formulas of Raskar 2001, sections 2.1 to 2.3, as printed */
} dp_method;

/* How valleys and intersections are told from what is merely hidden, with DP_INK_QUADS
 * (Raskar 2001, 2.3, 2.4). */
typedef enum dp_between {
    DP_BETWEEN_PLANE = 0, /* two passes: the planes cross within half a line width; order-free */
    DP_BETWEEN_INTERVAL,  /* the paper's two depth buffers z1, z2 = z1 + offset, one pass */
    DP_BETWEEN_STENCIL    /* the appendix: one depth and one stencil buffer, three passes */
} dp_between;

/* Where lines come from. */
typedef enum dp_edges {
    DP_EDGES_EMERGENT = 0, /* from the tiles: nothing is known about neighbours beforehand */
    DP_EDGES_ADJACENCY /* from adjacency, built once per topology (Hermosilla and Vázquez 2010, 2.3)
                        */
} dp_edges;

typedef enum dp_ink {
    DP_INK_STROKES = 0, /* visible feature segments, drawn as round strokes */
    DP_INK_QUADS        /* the added polygons are the line, as in the paper; nothing tells a border
                           from a ridge there: it is drawn as one, or with ridges off in its own colour */
} dp_ink;

typedef struct dp_line_style {
    float width;    /* the whole visible width, px; 0 means 2; 0.5 to 64 */
    dp_color color; /* 0 means black */
} dp_line_style;

/* Zero is the default: `dp_style style = {0};` draws every class, 2 px wide, black on white. */
typedef struct dp_style {
    uint32_t lines;                    /* set of classes; 0 means DP_ALL_LINES; or DP_NO_LINES */
    dp_line_style line[DP_LINE_COUNT]; /* indexed by dp_line */
    float ridge_angle;                 /* theta, degrees in (0, 360); 0 means 150 */
    float valley_angle;                /* phi, degrees in (0, 360); 0 means 210 */
    dp_edges edges;
    dp_stroke_style stroke; /* textures, taper, jitter: strokes.h */
    dp_method method;
    dp_between between;
    dp_ink ink;
    int passes;           /* 0 means the first of these.
                             strokes: 2 or 1; 1: a source that is streamed is read once (dp_draw).
                             quads: how often a tile's polygons are gone through; plane 2, interval 1 (as
                             printed) or 2 (it does not depend on their order), stencil 3.
                             DP_EDGES_ADJACENCY: 1 or 2, to the same picture */
    float between_offset; /* interval, stencil: z2 - z1 in units of px seen at the surface; 0: 1 */
    dp_color paper;       /* 0 means white */
    dp_color surface;     /* 0 means white; DP_COLOR_NONE: hides, but shows the paper */
    bool cull_back_faces; /* do not paint back faces as surface (closed models lose nothing) */
    bool edge_table_off; /* strokes only: resolve no edge by the tile's table, let every line emerge
                          */
    dp_shade shade;      /* how surfaces look (shade.h) */
    dp_edge_map edge_map; /* off by default */
    dp_mirror mirror;     /* none by default */
} dp_style;

/* The style with every default filled in. DP_ERR_ARGUMENT names the member that is out of range. */
DP_API dp_result dp_style_resolve(const dp_style *style, dp_style *resolved, dp_diag *diag);

/* "silhouette", "ridge", "valley", "intersection", "border". */
DP_API const char *dp_line_name(dp_line line);

#ifdef __cplusplus
}
#endif
#endif
