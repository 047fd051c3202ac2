/* What each group of a source holds: its polygons, and the box around them. */
#include "base/diag.h"
#include "base/vec.h"

#include <drypoint/objects.h>

static const float *position_of(const dp_batch *batch, size_t corner) {
    const size_t vertex = batch->indices ? batch->indices[corner] : corner;
    if (vertex >= batch->vertex_count) return NULL;
    return (const float *)(const void *)((const char *)batch->positions +
                                         vertex * batch->position_stride);
}

static void add_corner(const dp_batch *batch, size_t corner, dp_group *group) {
    const float *const p = position_of(batch, corner);
    if (!p || !isfinite(p[0]) || !isfinite(p[1]) || !isfinite(p[2])) return;
    for (int k = 0; k < 3; k++) {
        const double at = batch->origin[k] + (double)p[k];
        group->min[k] = dp_min(group->min[k], at);
        group->max[k] = dp_max(group->max[k], at);
    }
}

static void add_batch(const dp_batch *batch, dp_group *groups, uint32_t most, uint32_t *count) {
    for (size_t i = 0; i < batch->polygon_count; i++) {
        const uint32_t g = batch->groups ? batch->groups[i] : 0;
        const size_t first = batch->firsts ? batch->firsts[i] : 3 * i,
                     last = batch->firsts ? batch->firsts[i + 1] : 3 * i + 3;
        if (g >= *count) *count = g + 1;
        if (g >= most) continue;
        groups[g].polygons++;
        for (size_t c = first; c < last; c++) add_corner(batch, c, &groups[g]);
    }
}

dp_result dp_source_groups(dp_source *source, dp_group *groups, uint32_t most, uint32_t *count,
                           dp_diag *diag) {
    if (!source || !count || (most && !groups))
        return dp_fail(diag, DP_ERR_ARGUMENT, "dp_source_groups: source, groups or count is NULL");
    for (uint32_t g = 0; g < most; g++)
        groups[g] = (dp_group){.min = {INFINITY, INFINITY, INFINITY},
                               .max = {-INFINITY, -INFINITY, -INFINITY}};
    *count = 0;
    dp_result result = dp_source_rewindable(source) ? dp_source_rewind(source, diag) : DP_OK;
    while (!result) {
        dp_batch batch;
        result = dp_source_next(source, &batch, diag);
        if (!result && !batch.polygon_count)
            return dp_source_rewindable(source) ? dp_source_rewind(source, diag) : DP_OK;
        if (!result) add_batch(&batch, groups, most, count);
    }
    return result;
}
