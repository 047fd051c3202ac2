/* The raster sink: bins strokes when a drawing begins, and inks all tiles when it ends.
 *
 * The ink of a stroke reaches into neighbouring tiles; so nothing is inked before all strokes are
 * there. Within a tile classes are laid over each other in the order of dp_layers. */
#include "sink/raster.h"

#include "base/diag.h"

/* From the bottom up: where lines cross, outlines lie over creases, and all over hatching. */
const dp_line dp_layers[DP_LINE_COUNT] = {DP_LINE_HATCHING, DP_LINE_VALLEY, DP_LINE_INTERSECTION,
                                          DP_LINE_RIDGE,    DP_LINE_BORDER, DP_LINE_SILHOUETTE,
                                          DP_LINE_SECTION};

/* ------- memory ------- */

static const dp_array arrays[] = {DP_ARRAY(dp_ink_worker, strokes, strokes_cap),
                                  DP_ARRAY(dp_ink_worker, sorted, sorted_cap)};

bool dp_raster_init(dp_raster *raster, uint32_t workers, const dp_allocator *memory) {
    raster->workers = dp_alloc_zeroed(memory, dp_times(workers, sizeof *raster->workers));
    raster->count = raster->workers ? workers : 0;
    return raster->workers;
}

void dp_raster_free(dp_raster *raster, const dp_allocator *memory) {
    for (uint32_t i = 0; i < raster->count; i++)
        dp_arrays_free(memory, &raster->workers[i], DP_ARRAYS(arrays));
    dp_free(memory, raster->workers);
    dp_bins_free(&raster->bins, memory);
    *raster = (dp_raster){0};
}

uint64_t dp_raster_bytes(const dp_raster *raster) {
    uint64_t sum = raster->count * sizeof *raster->workers + dp_bins_bytes(&raster->bins);
    for (uint32_t i = 0; i < raster->count; i++)
        sum += dp_arrays_bytes(&raster->workers[i], DP_ARRAYS(arrays));
    return sum;
}

/* ------- the sink ------- */

/* How a kind of strokes is inked. */
typedef struct kind {
    dp_bin_place *place;
    dp_bin_touches *touches;
    dp_ink_tile *ink;
} kind;

static const kind plain = {dp_place_strokes, dp_stroke_touches, dp_ink_plain},
                  stylized = {dp_place_stylized, NULL, dp_ink_stylized};

static const kind *kind_of(const dp_inking *k) {
    return k->drawing->stylizes && !k->plain ? &stylized : &plain;
}

static dp_result begin(void *user, const dp_sheet *sheet, dp_diag *diag) {
    dp_inking *const k = user;
    const dp_frame *const f = k->frame;
    const size_t count =
        kind_of(k) == &stylized ? k->drawing->stylized.count : dp_inked_count(k->drawing);
    (void)sheet;
    for (uint32_t i = 0; i < k->raster->count; i++) k->raster->workers[i].failed = false;
    return dp_bins_fill(&k->raster->bins, (uint32_t)count, f->tiles_x, f->tiles_y,
                        kind_of(k)->place, kind_of(k)->touches, k, f->threads, f->memory)
               ? DP_OK
               : dp_fail(diag, DP_ERR_MEMORY, "out of memory while drawing");
}

static void ink_tile(void *arg, uint32_t tile, uint32_t worker) {
    const dp_inking *const k = arg;
    kind_of(k)->ink(k, &k->raster->workers[worker], tile);
}

static dp_result end(void *user, dp_result so_far, dp_diag *diag) {
    dp_inking *const k = user;
    if (so_far) return so_far;
    const dp_result result = k->for_tiles(k->user, ink_tile, k, diag);
    for (uint32_t i = 0; !result && i < k->raster->count; i++)
        if (k->raster->workers[i].failed)
            return dp_fail(diag, DP_ERR_MEMORY, "out of memory while drawing");
    return result;
}

dp_sink dp_raster_sink(dp_inking *inking) {
    return (dp_sink){.user = inking, .begin = begin, .end = end};
}
