/* A context's inside: threads, and all memory that stays from frame to frame. */
#ifndef DP_DRAW_CONTEXT_H
#define DP_DRAW_CONTEXT_H

#include "mesh/adjacency.h"
#include "core/smooth.h"
#include "raster/stages.h"
#include "mesh/normals.h"
#include "find/finder.h"
#include "printed/quads.h"
#include "shade/shade.h"
#include "sink/raster.h"
#include "base/pool.h"
#include "stream/stream.h"
#include "raster/xray.h"
#include "strokes/detail.h"

#include <stdatomic.h>

typedef struct dp_recording dp_recording; /* immediate.c */

/* A mirror's own memory (mirror.c). Zero is empty. */
typedef struct dp_mirror_store {
    struct dp_reflection *reflection; /* its sources */
    dp_normal_store normals;          /* of the reflected scene */
    uint8_t *rgba;                    /* what is seen in the mirror, over the whole picture */
    float *distance;                  /* the same, INFINITY: paper */
    size_t rgba_cap, distance_cap;
} dp_mirror_store;

struct dp_context {
    dp_allocator memory;   /* passes all on to … */
    dp_allocator given;    /* … the application's, and keeps … */
    atomic_size_t refused; /* … the size of what it refused last, bytes; 0: nothing */
    int (*progress)(void *user, double fraction);
    void *user;
    double share_from, share_to; /* of the drawing's progress that this picture is: 0 to 1, or less
                                    where several make one (mirror.c) */
    double told;                 /* the last that was told of the drawing, 0 to 1 */
    dp_threads *threads;
    uint32_t workers;

    size_t limit; /* bytes beyond the picture (dp_context_desc.memory) */
    dp_polygon_store polygons;
    dp_lines drawing; /* the lines of the last picture */
    dp_lines once;    /* without what lies on others, where strokes have gaps */
    dp_pool once_scratch;
    dp_detail_store detail;  /* scratch for cleaning lines */
    bool inks_once;          /* `once` is inked */
    bool drawn;              /* there is one */
    dp_normal_store normals; /* made for models without */
    dp_smooth_store smooth;  /* curved triangles, where those are drawn */
    dp_shade_store shade;    /* G-buffer and what is made of it */
    int shade_pass;          /* the one that runs */
    dp_xray xray;            /* layers of surfaces that are seen through */
    uint32_t xray_layer;     /* the one that is drawn */
    dp_target xray_target;   /* the picture's, while layers are shaded */
    dp_mirror_store mirror;
    dp_bin_worker *bin_workers; /* [workers] */
    dp_finder *finders;         /* [workers] */
    dp_printer *printers;       /* [workers] */
    dp_found *found;            /* [workers] */
    dp_raster raster;           /* what the sink that inks keeps */
    dp_frame frame;
    dp_style *styles; /* of dp_draw_grouped: the picture's, then those of groups, resolved */
    size_t styles_cap;
    dp_adjacency adjacency; /* of the last source that asked for it */

    dp_stream_draw *stream; /* while one is drawn */

    dp_stats stats;
    dp_recording *recording; /* made when first used */
    bool recording_lost;     /* there was no memory to make it; dp_finish says so */
};

/* What the allocator has given to the context and not got back; between dp_draw's stages
 * (context.c). */
uint64_t dp_context_bytes(const dp_context *context);

/* Ends dp_draw or dp_finish: counts the memory, and says in a message that it is out how much was
 * asked for. Returns the result. */
dp_result dp_context_settle(dp_context *context, dp_result result, dp_diag *diag);

/* dp_draw with resolved styles: styles[0] is the picture's, and of groups that have none of their
 * own; styles[1 + g] is that of group g. */
dp_result dp_draw_groups(dp_context *context, dp_source *source, const dp_camera *camera,
                         const dp_style *styles, uint32_t style_count, const dp_target *target,
                         dp_diag *diag);

/* The same, and with the first style's mirror where it has one; such a drawing changes that style, and
 * puts back what it was. */
dp_result dp_draw_resolved(dp_context *context, dp_source *source, const dp_camera *camera,
                           dp_style *styles, uint32_t style_count, const dp_target *target,
                           dp_diag *diag);

/* There is no drawing, as before the first one. */
void dp_forget_drawing(dp_context *context);

enum { DP_PICTURE_MOST = 32768 /* px, either side */ };

/* The target with its defaults filled in; DP_ERR_ARGUMENT, DP_ERR_LIMIT. */
dp_result dp_check_target(const dp_target *target, dp_target *out, dp_diag *diag);

/* Does any texture need the centre of the picture? (draw.c) */
bool dp_needs_centre(const dp_frame *frame);

/* Reads the source, unless it is to be streamed: *streams (gather.c). Tells progress up to DP_GATHERED. */
dp_result dp_gather_picture(dp_context *context, dp_source *source, bool *streams, dp_diag *diag);
static const double DP_GATHERED = 0.05;

/* Tells how far the picture is, 0 to 1, or below 0 where that is not known; DP_ERR_CANCELLED when
 * it is to stop. What is told must not fall (dp_context_desc). */
dp_result dp_tell_progress(dp_context *context, double fraction, dp_diag *diag);

/* Runs a task for every tile; progress goes from `from` to `to` (draw.c). */
dp_result dp_for_tiles(dp_context *context, dp_task *task, void *arg, double from, double to,
                       dp_diag *diag);

/* The passes of shading over all tiles, and of the edge map, if there are any (draw.c). */
dp_result dp_shade_picture(dp_context *context, double from, double to, dp_diag *diag);

/* Which lines are looked for behind surfaces: those asked for, or all that an x-ray shows
 * (draw/xray.c). */
void dp_begin_hidden(dp_frame *frame);

/* What is shaded next is that layer of an x-ray, if there is one, up to dp_draw_layers' end; edges of its
 * edge map are kept apart: they are ink on it (draw/xray.c). */
void dp_shade_layer(dp_context *context, uint32_t layer);

/* Draws the layers of an x-ray behind the first one, if there is one (draw/xray.c). */
dp_result dp_draw_layers(dp_context *context, double from, double to, dp_diag *diag);

/* Normals of the gathered polygons, smooth but for creases as the first style says; false: no memory. */
bool dp_compute_normals(dp_context *context, dp_source *source, dp_attribute *out);

/* Replaces the frame's gathered polygons by curved ones, as the first style says (draw/smooth.c). */
dp_result dp_smooth_frame(dp_context *context, dp_source *source, dp_diag *diag);

/* dp_draw_groups with a mirror (draw/mirror.c). Changes the first style, and puts back what it was. */
dp_result dp_draw_mirrored(dp_context *context, dp_source *source, const dp_camera *camera,
                           dp_style *styles, uint32_t style_count, const dp_target *target,
                           dp_diag *diag);

void dp_mirror_store_free(dp_mirror_store *store, const dp_allocator *memory);
uint64_t dp_mirror_store_bytes(const dp_mirror_store *store);

/* NULL allowed (immediate.c). */
void dp_recording_free(dp_recording *recording, const dp_allocator *memory);
uint64_t dp_recording_bytes(const dp_recording *recording);

#endif
