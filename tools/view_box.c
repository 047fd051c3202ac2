/* How far a model reaches in views: all its corners on the picture's plane, in double precision. */
#include "view_box.h"

#include <math.h>

static const view_box nothing = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};

static double row_of(const dp_camera *camera, int row, const double p[3]) {
    const double *const m = camera->view + row;
    return m[0] * p[0] + m[4] * p[1] + m[8] * p[2] + m[12];
}

static void take(view_box *box, const dp_camera *camera, const double p[3]) {
    const bool perspective = camera->projection[11] != 0;
    const double depth = perspective ? -row_of(camera, 2, p) : 1;
    if (!(depth > 0)) return; /* behind the eye */
    for (int k = 0; k < 2; k++) {
        const double at = row_of(camera, k, p) / depth;
        box->min[k] = fmin(box->min[k], at);
        box->max[k] = fmax(box->max[k], at);
    }
}

static void take_batch(const dp_batch *b, const dp_camera *cameras, int count, view_box *boxes) {
    const size_t stride = b->position_stride ? b->position_stride : 12;
    const size_t corners = b->firsts ? b->firsts[b->polygon_count] : 3 * b->polygon_count;
    for (size_t c = b->firsts ? b->firsts[0] : 0; c < corners; c++) {
        const size_t v = b->indices ? b->indices[c] : c;
        if (v >= b->vertex_count) continue;
        const float *const at =
            (const float *)(const void *)((const char *)b->positions + v * stride);
        const double p[3] = {b->origin[0] + (double)at[0], b->origin[1] + (double)at[1],
                             b->origin[2] + (double)at[2]};
        if (!isfinite(p[0] + p[1] + p[2])) continue;
        for (int k = 0; k < count; k++) take(&boxes[k], &cameras[k], p);
    }
}

dp_result view_boxes(dp_source *source, const dp_camera *cameras, int count, view_box *boxes,
                     dp_diag *diag) {
    for (int k = 0; k < count; k++) boxes[k] = nothing;
    dp_result result = dp_source_rewind(source, diag);
    for (dp_batch batch = {0}; !result; batch = (dp_batch){0}) {
        result = dp_source_next(source, &batch, diag);
        if (result || !batch.polygon_count) break;
        take_batch(&batch, cameras, count, boxes);
    }
    for (int k = 0; k < count; k++)
        if (!(boxes[k].min[0] <= boxes[k].max[0])) boxes[k] = (view_box){{0}, {0}};
    return result ? result : dp_source_rewind(source, diag);
}

void view_box_add(view_box *box, const dp_camera *camera, const dp_extent *extent) {
    for (int i = 0; i < 8; i++) {
        double p[3];
        for (int k = 0; k < 3; k++) p[k] = i >> k & 1 ? extent->exact_max[k] : extent->exact_min[k];
        take(box, camera, p);
    }
}

view_box view_box_of(const dp_camera *camera, const dp_extent *extent) {
    view_box box = nothing;
    view_box_add(&box, camera, extent);
    return box;
}

double view_box_width(const view_box *box) { return box->max[0] - box->min[0]; }
double view_box_height(const view_box *box) { return box->max[1] - box->min[1]; }
