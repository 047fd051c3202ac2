/* The extent of a source, and how far what is drawn of it reaches in a view.
 *
 * Corners are read in runs of polygons. A run has a box, and only where that leaves what is known of
 * the reach are its polygons looked at one by one: a few in a hundred, as neighbours in a file are
 * mostly neighbours in space. */
#include "base/diag.h"
#include "base/hostile.h"
#include "base/vec.h"
#include "mesh/source.h"
#include "mesh/wide.h"

#include <math.h>

enum { RUN = DP_TUNED(64, 2), SAMPLES = DP_TUNED(2048, 3) /* polygons */ };

static const float *corner(const dp_batch *batch, size_t c) {
    const uint32_t v = batch->indices ? batch->indices[c] : (uint32_t)c;
    if (v >= batch->vertex_count) return NULL;
    return (const float *)(const void *)((const char *)batch->positions +
                                         v * batch->position_stride);
}

/* ---- polygons one by one ---- */

static bool is_finite(const float p[3]) {
    return p[0] - p[0] + (p[1] - p[1]) + (p[2] - p[2]) == 0; /* else NaN */
}

/* Is that polygon drawn? As for dp_polygon_has_no_area, with corners that are there. */
static bool is_drawn(const dp_batch *batch, size_t first, size_t last) {
    if (last < first + 3) return false;
    for (size_t c = first; c < last; c++) {
        const float *const p = corner(batch, c);
        if (!p || !is_finite(p)) return false;
    }
    const dp_vec3 o = dp_v3f(corner(batch, first));
    dp_vec3 sum = {0, 0, 0}, a = dp_sub(dp_v3f(corner(batch, first + 1)), o);
    double size = dp_dot(a, a);
    for (size_t c = first + 2; c < last; c++) {
        const dp_vec3 b = dp_sub(dp_v3f(corner(batch, c)), o);
        sum = dp_add(sum, dp_cross(a, b));
        size = dp_max(size, dp_dot(b, b));
        a = b;
    }
    return dp_length(sum) > 1e-12 * size;
}

static void move(const float p[3], const double shift[3], double at[3]) {
    for (int k = 0; k < 3; k++) at[k] = (double)p[k] + shift[k];
}

/* Most polygons change nothing, which is quicker to see than whether they are drawn. */
void dp_reach_add_polygon(dp_reach *reach, const dp_batch *batch, size_t first, size_t last,
                          const double shift[3]) {
    double at[3];
    bool inside = true;
    for (size_t c = first; c < last && inside; c++) {
        const float *const p = corner(batch, c);
        if (!p) return;
        move(p, shift, at);
        inside = dp_reach_has(reach, at);
    }
    if (inside || !is_drawn(batch, first, last)) return;
    for (size_t c = first; c < last; c++) {
        move(corner(batch, c), shift, at);
        dp_reach_add(reach, at);
    }
}

/* ---- runs ---- */

/* A run's box, in its batch's positions. */
typedef struct box {
    float min[3], max[3];
} box;

static const box empty_box = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};

static void extend(const dp_batch *batch, size_t first, size_t last, box *b, dp_extent *extent) {
    extent->corners += last - first;
    for (size_t c = first; c < last; c++) {
        const float *const p = corner(batch, c);
        extent->bad_index += !p;
        extent->not_finite += p && !is_finite(p);
        if (!p || !is_finite(p)) return;
    }
    for (size_t c = first; c < last; c++) {
        const float *const p = corner(batch, c);
        for (int k = 0; k < 3; k++) {
            b->min[k] = dp_minf(p[k], b->min[k]);
            b->max[k] = dp_maxf(p[k], b->max[k]);
        }
    }
}

static void join(box *b, const box *other) {
    for (int k = 0; k < 3; k++) {
        b->min[k] = dp_minf(other->min[k], b->min[k]);
        b->max[k] = dp_maxf(other->max[k], b->max[k]);
    }
}

static bool may_grow(const dp_reach *reach, const box *b, const double shift[3]) {
    double min[3], max[3];
    if (!reach || b->min[0] > b->max[0]) return false;
    for (int k = 0; k < 3; k++)
        min[k] = (double)b->min[k] + shift[k], max[k] = (double)b->max[k] + shift[k];
    return dp_reach_may_grow(reach, min, max);
}

static size_t first_corner(const dp_batch *b, size_t i) { return b->firsts ? b->firsts[i] : 3 * i; }

/* Polygons from all over a large batch first: then few of the others reach farther. */
static void sample(dp_reach *reach, const dp_batch *batch, const double shift[3]) {
    const size_t step = batch->polygon_count / SAMPLES;
    if (!reach || step < DP_TUNED(16, 2)) return;
    for (size_t i = 0; i < batch->polygon_count; i += step)
        dp_reach_add_polygon(reach, batch, first_corner(batch, i), first_corner(batch, i + 1),
                             shift);
    dp_reach_set_limits(reach);
}

static void measure_batch(const dp_batch *batch, const double shift[3], box *whole, dp_reach *reach,
                          dp_extent *extent) {
    sample(reach, batch, shift);
    for (size_t first = 0; first < batch->polygon_count; first += RUN) {
        const size_t left = batch->polygon_count - first, last = first + (left < RUN ? left : RUN);
        box b = empty_box;
        for (size_t i = first; i < last; i++)
            extend(batch, first_corner(batch, i), first_corner(batch, i + 1), &b, extent);
        join(whole, &b);
        if (!may_grow(reach, &b, shift)) continue;
        for (size_t i = first; i < last; i++)
            dp_reach_add_polygon(reach, batch, first_corner(batch, i), first_corner(batch, i + 1),
                                 shift);
    }
}

/* ---- sources ---- */

static void add_box(const box *b, const double origin[3], dp_extent *extent) {
    if (b->min[0] > b->max[0]) return;
    for (int k = 0; k < 3; k++) {
        const double min = (double)b->min[k], max = (double)b->max[k];
        extent->exact_min[k] = dp_min(origin[k] + min, extent->exact_min[k]);
        extent->exact_max[k] = dp_max(origin[k] + max, extent->exact_max[k]);
        extent->spacing = dp_max(extent->spacing, dp_float_spacing(dp_max(fabs(min), fabs(max))));
    }
}

/* The float32 next to a value that is no larger; for the other side, negate both. */
static float below(double value) {
    const float near = (float)value;
    return (double)near > value ? nextafterf(near, -INFINITY) : near;
}

void dp_extent_round(dp_extent *extent) {
    for (int k = 0; k < 3; k++) {
        extent->min[k] = below(extent->exact_min[k]);
        extent->max[k] = -below(-extent->exact_max[k]);
    }
}

/* All of a source counts from its first batch's origin. */
static void place(dp_reach *reach, const dp_batch *batch, double shift[3]) {
    for (int k = 0; k < 3; k++) {
        if (reach && !reach->placed) reach->origin[k] = batch->origin[k];
        shift[k] = reach ? batch->origin[k] - reach->origin[k] : 0;
    }
    if (reach) reach->placed = true;
}

static void add_batch(const dp_batch *batch, dp_reach *reach, dp_extent *extent) {
    double shift[3];
    box whole = empty_box;
    place(reach, batch, shift);
    measure_batch(batch, shift, &whole, reach, extent);
    add_box(&whole, batch->origin, extent);
    extent->spacing = dp_max(extent->spacing, batch->spacing);
    extent->polygons += batch->polygon_count;
    extent->vertices += batch->vertex_count;
}

dp_result dp_source_measure(dp_source *source, dp_extent *extent, dp_reach *reach, dp_diag *diag) {
    if (source->records.read) return dp_records_measure(source, extent, reach, diag);
    if (dp_source_rewindable(source)) {
        const dp_result result = dp_source_rewind(source, diag);
        if (result) return result;
    }
    dp_extent sum = {.exact_min = {INFINITY, INFINITY, INFINITY},
                     .exact_max = {-INFINITY, -INFINITY, -INFINITY}};
    for (;;) {
        dp_batch batch;
        const dp_result result = dp_source_next(source, &batch, diag);
        if (result) return result;
        if (!batch.polygon_count) break;
        add_batch(&batch, reach, &sum);
    }
    dp_extent_round(&sum);
    *extent = sum;
    return dp_source_rewindable(source) ? dp_source_rewind(source, diag) : DP_OK;
}

dp_result dp_source_extent(dp_source *source, dp_extent *extent, dp_diag *diag) {
    if (!source || !extent)
        return dp_fail(diag, DP_ERR_ARGUMENT, "dp_source_extent: NULL argument");
    return dp_source_measure(source, extent, NULL, diag);
}
