/* drypoint/draw.h: the batch interface: a source, a camera, a style and a target in, a picture out.
 *
 *     dp_context *context = NULL;
 *     dp_source *source = NULL;
 *     uint8_t *rgba = malloc(1600 * 1200 * 4);
 *     dp_camera camera;
 *     dp_diag diag;
 *     if (dp_version_check(&diag)) return fputs(diag.message, stderr), 1;
 *     dp_context_create(NULL, &context, &diag);
 *     dp_source_open("fandisk.obj", NULL, &source, &diag);
 *     dp_camera_fit_source(&camera, NULL, source, NULL, &diag);
 *     const dp_target target = {.width = 1600, .height = 1200, .rgba = rgba};
 *     dp_draw(context, source, &camera, NULL, &target, &diag);
 *
 * Not here: windows, image files (drypoint/io.h). */
#ifndef DRYPOINT_DRAW_H
#define DRYPOINT_DRAW_H

#include <drypoint/camera.h>
#include <drypoint/source.h>
#include <drypoint/style.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A context owns its threads and all scratch memory, which stays for the next frame. Contexts are
 * independent of each other; one context serves one thread at a time. */
typedef struct dp_context dp_context;

typedef struct dp_context_desc {
    const dp_allocator *allocator; /* NULL: malloc; copied */
    uint32_t threads;              /* workers, the caller included; 0: one per processor. There are
                                      256 at most; a larger number means 256. In WebAssembly as
                                      many of them as the module's pool has (DRYPOINT_WEB_POOL) */
    /* The application's own thread pool: must call task(arg, i) once for every i in [0, count),
     * in any order and from any threads, one is enough, and return when all calls have. No call
     * waits for another: of more than `threads` at once the extra ones leave their work to the
     * others and return. NULL: the context's own threads. */
    void (*parallel_for)(void *user, uint32_t count, void (*task)(void *arg, uint32_t index),
                         void *arg);
    /* Called from the drawing thread now and then, from reading the source on, fraction in [0, 1],
     * or negative while a source of unknown length is streamed. A known one never falls and is 1
     * when a picture is done, whatever that takes: several readings, shading, a mirror. A non-zero
     * return stops the drawing with DP_ERR_CANCELLED. */
    int (*progress)(void *user, double fraction);
    void *user;
    /* Memory beyond the picture's own, bytes; 0 means 256 MB, the least is 48 MB. A source that
     * would take more is not gathered but streamed: read twice, in parts (dp_draw). */
    size_t memory;
} dp_context_desc;

/* desc may be NULL. DP_ERR_MEMORY, DP_ERR_LIMIT (threads could not be started). */
DP_API dp_result dp_context_create(const dp_context_desc *desc, dp_context **out, dp_diag *diag);
DP_API void dp_context_destroy(dp_context *context); /* NULL allowed */

/* Where the picture goes. Rows run from top to bottom; every plane is the caller's and optional. */
typedef struct dp_target {
    uint32_t width, height; /* px, 1 to 32768 */
    uint32_t samples;       /* per pixel: 1, 4, 8 or 16; 0 means 4 */
    uint8_t *rgba;          /* [height][width][4], not premultiplied */
    size_t rgba_stride;     /* bytes from row to row; 0 means 4 * width */
    float *depth;        /* [height][width], world units along the line of sight; INFINITY: none */
    uint8_t *line_class; /* [height][width], 1 + dp_line of the ink that covers the pixel, or 0 */
    float *normal;       /* [height][width][3], world space, unit, towards the eye; 0: none */
    /* The G-buffer that shading and edge map work on, one surface per pixel (its greatest part): */
    float *eye_normal; /* [height][width][3], camera space, unit, as shaded; 0: none */
    float *distance;   /* [height][width], as depth, at the pixel's centre; INFINITY: none */
    uint16_t *id;      /* [height][width], 1 + group, at most 65535; 0: none */
    uint8_t *edge_map; /* [height][width][4]: inner edges in RGB, profile edges in A; 255: no edge
                          (Nienhaus 2003, 4.1.2). Needs style.edge_map.detector; 255 without */
} dp_target;

/* Draws the source, from its start when it can be rewound, from where it is when not.
 *
 * With DP_INK_STROKES a source that would take more memory than the context may use is streamed:
 * read in parts, once for surface and lines, once for what hides them, and more often where
 * polygons that share an edge are many and far apart; memory then depends on the picture and on its
 * lines, not on the source's length. The lines are the same, but for these: an edge that lies in
 * the middle of another polygon may be taken for a border; with passes = 1 intersections are found
 * between polygons of one part; beyond 64 readings edges are given up, and where lines alone do not
 * fit they are thinned (dp_stats.edges_lost). Polygons of more than three corners are streamed as
 * triangles, which dp_segment.edge then counts by. What needs all polygons at once (shading,
 * adjacency, hidden lines, polar stroke textures, patterns, light on lines, smoothing) is drawn from memory. With dp_style.passes = 1
 * the source is read once, and what hides lines is known only as finely as the picture's samples. A
 * source that can be read only once and does not fit fails with DP_ERR_LIMIT unless passes is 1.
 * Sources of one stable batch are drawn from where they lie, whatever their size.
 *
 * style NULL: all defaults. The picture is the same, bit for bit, for any number of threads.
 *
 * A call whose own arguments are refused leaves the target as it was. After any other error,
 * DP_ERR_CANCELLED too, each pixel of each plane holds what it held before or what the picture
 * would have had at some stage (a surface without its lines, say): nothing to show. What lies
 * between rows is never written. The context can draw again at once.
 *
 * DP_ERR_ARGUMENT, DP_ERR_MEMORY (the message says how much was asked for last, and what the context
 * holds), DP_ERR_CANCELLED, whatever the source fails with;
 * DP_ERR_FORMAT when the source held polygons but every one of them had to be dropped; DP_ERR_LIMIT
 * when a picture's samples do not fit into a size_t, which takes one of 32 bits and more than 130
 * million pixels. */
DP_API dp_result dp_draw(dp_context *context, dp_source *source, const dp_camera *camera,
                         const dp_style *style, const dp_target *target, dp_diag *diag);

/* As dp_draw, with a style for each of the first `count` groups: groups[g] is that of group g (dp_batch),
 * all others have `style`. To change one group, fill in `style` for the groups before it. Of a group's
 * own style count
 *
 *     lines, line, ridge_angle, valley_angle    which lines it has, their widths and colours
 *     hidden.line                               the same of its hidden lines
 *     surface, section, shade.model_colors      its colour, or the model's, and that of cut faces
 *     xray                                      how opaque its surface is
 *     cull_back_faces
 *
 * and with DP_SHADING_PAPER no surface has a colour of its own. Everything else holds for the whole
 * picture and is that of `style`: paper, edges, ink, method, stroke, shading, edge map, mirror, look and
 * levels of hidden lines,
 * layers of x-rays, detail, smoothing … A line has the style of its polygon
 * (dp_segment.polygon): of two that share an edge or cross, the one that comes first in the source. A
 * mirror has `style`, and what is seen in it the groups' own.
 *
 * Drawn from memory, whatever the model's size. Keeps a copy of the styles in the context. Errors of
 * dp_draw; DP_ERR_ARGUMENT names the group whose style is refused; DP_ERR_LIMIT for more than 65536, and with a
 * mirror for more than DP_MIRROR_GROUP. */
DP_API dp_result dp_draw_grouped(dp_context *context, dp_source *source, const dp_camera *camera,
                                 const dp_style *style, const dp_style *groups, uint32_t count,
                                 const dp_target *target, dp_diag *diag);

/* What ends a segment. */
typedef enum dp_line_end {
    DP_END_VERTEX = 0, /* a vertex of its edge */
    DP_END_CROSSING,   /* of an intersection: one of the two polygons ends there */
    DP_END_HIDDEN,  /* a nearer polygon hides it from there on: up to an eighth of a pixel off, or
                          as exactly as float32 tells with dp_style.exact_ends; of a hidden line: there
                          it becomes visible, or its level changes */
    DP_END_PICTURE, /* the picture's edge, or the near or the far plane */
    DP_END_DETAIL   /* the rest of the line is left out (dp_style.detail) */
} dp_line_end;

/* A piece of a feature line, as found by the last dp_draw with DP_INK_STROKES, or with
 * DP_EDGES_ADJACENCY: a visible one, or, with dp_style.hidden, one that is hidden. */
typedef struct dp_segment {
    dp_line line;
    float a[3], b[3]; /* both ends on the screen: x right, y down, px; third: distance along
                         the line of sight, world units */
    double world_a[3], world_b[3]; /* world space: float32 about the source's origin, which is added
                                      in double precision */
    uint64_t polygon;   /* of the source, counted from 0 over all its batches; a mirror comes as one
                           more after them */
    uint64_t other;     /* the polygon across the edge, or that it cuts; UINT64_MAX: none known */
    uint32_t edge;      /* from corner `edge` to the next; UINT32_MAX for an intersection and, with
                           dp_style.smooth, for what lies within the polygon's patch */
    uint32_t group;     /* of the polygon; 0 where the source has no groups, or is streamed */
    dp_line_end end[2]; /* at a and at b */
    uint64_t hider[2];  /* where that is DP_END_HIDDEN: by which polygon of the source. With
                          dp_style.exact_ends the one that begins to hide the line there, else one of
                          those that hide it within two pixels of its end. UINT64_MAX: not known, as
                          where the source is streamed, and now and then where tiles meet; of
                          hidden lines never */
    uint32_t level; /* how many front-facing surfaces hide it, 1 at least where anything does, and
                           dp_hidden.levels at most; 0: it is visible */
    uint32_t chain; /* number of its chain: segments that a pen draws in one go; from 0 on */
    uint32_t place; /* its place in the chain, from 0 on */
    bool reversed;  /* in its chain it is drawn from b to a */
    float width;    /* px; both by class and, of hidden lines, by level */
    dp_color color;
} dp_segment;

/* The segments, in an order that depends neither on tiles nor on threads. The first call after a
 * drawing makes the chains. Borrowed: valid until the next call that draws, or the
 * context's end. NULL and 0 when there are none, the last dp_draw failed, or memory is out. */
DP_API const dp_segment *dp_segments(dp_context *context, size_t *count);

/* Stages of a frame, in order. */
typedef enum dp_stage {
    DP_STAGE_GATHER = 0, /* read the source, check and split its polygons */
    DP_STAGE_VERTICES,   /* transform */
    DP_STAGE_BIN,        /* polygons to tiles */
    DP_STAGE_TILES,      /* faces, edges, visibility */
    DP_STAGE_SEGMENTS,   /* merge the tiles' pieces */
    DP_STAGE_SHADE,      /* shading and edge map, from the G-buffer */
    DP_STAGE_INK,        /* strokes, resolve to the target */
    DP_STAGE_COUNT
} dp_stage;
DP_API const char *dp_stage_name(dp_stage stage);

typedef struct dp_stats {
    uint64_t polygons;        /* handed out by the source */
    uint64_t triangles;       /* the same, polygons counted as their corners - 2 */
    uint64_t split;           /* concave, non-planar or large polygons that were split */
    uint64_t dropped;         /* sum of the next four */
    uint64_t dropped_index;   /* index out of range */
    uint64_t dropped_finite;  /* NaN or infinite coordinate */
    uint64_t dropped_area;    /* no area */
    uint64_t dropped_corners; /* fewer than three corners */
    uint64_t clipped;         /* crossed the near or far plane or the guard band */
    uint64_t edges_resolved;  /* by the tiles' edge tables; counted per tile */
    uint64_t edges_emergent;  /* left to emerge */
    uint64_t open_edges;      /* edges met with one polygon; counted per tile */
    uint64_t added_polygons;  /* by the primitive shaders; counted per tile */
    uint64_t edges_lost; /* streamed: edges given up because too many waited for their polygons, and
                            polygons that may cross others, because too many did */
    uint64_t xray_layers; /* with dp_style.xray: layers of surfaces that were found; 0: opaque */
    uint64_t xray_lost; /* samples of the picture that have more layers than dp_style.xray_layers */
    uint64_t segments;
    uint64_t bytes; /* memory that the context held when dp_draw or dp_finish returned, whatever it
                       returned: all that the context, from its creation on, has asked of its
                       allocator and not given back, to the byte. Not counted: what sources and
                       textures hold, the target, the stacks of the threads; nor what was given back
                       before, as all that streaming a source takes is. Chains count once they
                       are made (dp_segments) */
    uint64_t adjacency_bytes; /* of it, adjacency (DP_EDGES_ADJACENCY) */
    double curvature_ms; /* time to make directions of least curvature (DP_SHADING_PENCIL); 0 where
                            they were kept */
    double adjacency_ms; /* time to build adjacency; 0 where it was kept */
    double stage_ms[DP_STAGE_COUNT];
    double frame_ms;
} dp_stats;

/* Of the last dp_draw. */
DP_API void dp_stats_of(const dp_context *context, dp_stats *stats);

#ifdef __cplusplus
}
#endif
#endif
