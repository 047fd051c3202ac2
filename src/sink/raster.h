/* The raster sink: strokes as ink over the target's pixels (raster.c). Plain strokes are inked by
 * ink.c, stylized ones by brush.c, tile by tile. */
#ifndef DP_SINK_RASTER_H
#define DP_SINK_RASTER_H

#include "core/bin.h"
#include "strokes/lines.h"
#include <drypoint/sink.h>

/* A worker's scratch for one tile. */
typedef struct dp_ink_worker {
    float coverage[64 * 64];
    uint64_t row[64];       /* pixels of `coverage` that are set */
    float nearest[64 * 64]; /* brush.c: px from the spine; colour */
    dp_color color[64 * 64];
    uint32_t *strokes, *sorted; /* of the tile: as they come; ink.c: by level and class */
    struct dp_xray_tile *xray;  /* one, where there is an x-ray */
    size_t strokes_cap, sorted_cap, xray_cap;
    bool failed;
} dp_ink_worker;

/* What inking keeps from frame to frame. */
typedef struct dp_raster {
    dp_ink_worker *workers; /* [count] */
    uint32_t count;
    dp_bins bins; /* which strokes reach which tile */
} dp_raster;

bool dp_raster_init(dp_raster *raster, uint32_t workers, const dp_allocator *memory);
void dp_raster_free(dp_raster *raster, const dp_allocator *memory);
uint64_t dp_raster_bytes(const dp_raster *raster);

/* A drawing that is being inked. */
typedef struct dp_inking {
    const dp_frame *frame;
    const dp_lines *drawing;
    dp_raster *raster;
    /* Runs a task for every tile; tells progress (draw/draw.c). */
    dp_result (*for_tiles)(void *user, dp_task *task, void *arg, dp_diag *diag);
    void *user;
    bool plain; /* the strokes that plain ink takes, though there are stylized ones */
    const struct dp_xray *xray; /* whose surfaces plain ink lays, with the strokes between them;
                                   NULL: the target holds the surface */
} dp_inking;

/* A sink that inks `inking`, which it borrows. */
dp_sink dp_raster_sink(dp_inking *inking);

/* From the bottom up: the order in which classes are laid over each other. */
extern const dp_line dp_layers[DP_LINE_COUNT];

/* Pixels of a tile beside a stroke, at most DP_PATCH columns and rows. */
enum { DP_PATCH = 8 };
typedef struct dp_ink_patch {
    uint32_t tile_x, tile_y; /* px of the tile's corner */
    uint32_t x0, y0, x1, y1; /* in the tile; from the first to before the last */
    const float *depth;      /* the tile's samples, which hide; NULL: nothing does */
} dp_ink_patch;

/* Tiles that strokes reach: those of plain ones, and of stylized ones. */
dp_tile_rect dp_stroke_rect(const dp_stroke *stroke);
dp_bin_place dp_place_strokes, dp_place_stylized;
dp_bin_touches dp_stroke_touches;

/* Which strokes a tile holds, into worker->strokes. False when memory is out. */
bool dp_fetch_strokes(const dp_inking *inking, dp_ink_worker *worker, uint32_t tile, size_t *count);

/* Share of the samples of pixel (x, y) that do not hide the stroke, `distance` px beside its
 * spine's point t. `tile_depth`: the samples of the tile at (x0, y0); NULL: there is no surface. */
float dp_visible_share(const dp_frame *frame, const float *tile_depth, uint32_t x0, uint32_t y0,
                       const dp_stroke *stroke, uint32_t x, uint32_t y, float t, float distance);

/* Inks one tile over what the target holds already: with plain strokes; with stylized ones. */
typedef void dp_ink_tile(const dp_inking *inking, dp_ink_worker *worker, uint32_t tile);
dp_ink_tile dp_ink_plain, dp_ink_stylized;

#endif
