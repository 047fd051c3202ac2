/* The cases of the accuracy tests, and what each must reach. */
#include "suite.h"

#include "mesh.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const suite_view suite_views[SUITE_VIEWS] = {
    {"corner", {1, 0.6, 1}, 35, false, 0},
    {"left", {-1, 0.35, 0.45}, 50, false, 0},
    {"below", {0.3, -0.5, -1}, 20, false, 0},
    {"ortho", {0.8, 0.7, -0.6}, 0, true, 0},
};

const suite_view suite_close_views[SUITE_CLOSE_VIEWS] = {
    {"inside", {0.7, 0.55, 1}, 60, false, 0.3},
    {"skimming", {-1, 0.3, -0.2}, 80, false, 0.35},
};

const double suite_widths[SUITE_WIDTHS] = {2, 3, 12, 24};

const suite_class suite_classes[SUITE_CLASSES] = {
    {"silhouette", DP_SILHOUETTE, 0.998, 0.995, 1, 140, 220, SUITE_WIDTHS},
    {"ridge", DP_RIDGE | DP_BORDER, 0.998, 0.995, 0.005, 140, 220, SUITE_WIDTHS},
    {"valley", DP_VALLEY, 0.99, 0.98, 0.01, 140, 220, SUITE_WIDTHS},
    {"intersection", DP_INTERSECTION, 0.99, 0.98, 0.01, 140, 220, SUITE_WIDTHS},
    {"all", DP_ALL_LINES, 0.995, 0.995, 1, 120, 240, 1},
};

static const double width_tolerance = 0.03; /* of the median width */
static const double uniform = 0.05;         /* of the width of intersections, to either side */
static const double little = 1.0;           /* px of line, or of ink, that proves nothing */
enum { WIDTHS_NEEDED = 100 };               /* samples under which a median says nothing */

/* A source's polygons, on their way into arrays. */
typedef struct gathered {
    float *positions;
    uint32_t *firsts;
    size_t corners, corner_room, polygons, polygon_room;
} gathered;

static void gather_batch(gathered *all, const dp_batch *batch) {
    const size_t stride = batch->position_stride ? batch->position_stride : 3 * sizeof(float);
    for (size_t p = 0; p < batch->polygon_count; p++) {
        const size_t from = batch->firsts ? batch->firsts[p] : 3 * p;
        const size_t to = batch->firsts ? batch->firsts[p + 1] : 3 * p + 3;
        mesh_reserve(&all->positions, &all->corner_room, all->corners + to - from,
                     3 * sizeof(float));
        mesh_reserve(&all->firsts, &all->polygon_room, all->polygons + 2, sizeof(uint32_t));
        all->firsts[all->polygons++] = (uint32_t)all->corners;
        for (size_t c = from; c < to; c++, all->corners++) {
            const size_t vertex = batch->indices ? batch->indices[c] : c;
            memcpy(all->positions + 3 * all->corners,
                   (const char *)batch->positions + vertex * stride, 3 * sizeof(float));
        }
        all->firsts[all->polygons] = (uint32_t)all->corners;
    }
}

static dp_result gather(gathered *all, dp_source *source, dp_diag *diag) {
    for (;;) {
        dp_batch batch;
        const dp_result result = dp_source_next(source, &batch, diag);
        if (result != DP_OK || batch.polygon_count == 0) return result;
        gather_batch(all, &batch);
    }
}

/* Another order, by Fisher and Yates with a linear congruence. Every polygon is a triangle. */
static void shuffle_triangles(gathered *all, uint32_t seed) {
    uint64_t state = seed;
    for (size_t i = all->polygons; i > 1; i--) {
        float swap[9];
        state = state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
        float *const a = all->positions + 9 * (i - 1);
        float *const b = all->positions + 9 * (size_t)((state >> 33) % i);
        memcpy(swap, a, sizeof swap);
        memmove(a, b, sizeof swap);
        memcpy(b, swap, sizeof swap);
    }
}

/* Gives the corners indices again, so that what is drawn is a welded mesh. */
static void index_corners(suite_model *model, const gathered *all) {
    uint32_t *indices = malloc((all->corners + 1) * sizeof *indices);
    uint32_t *slots = NULL;
    size_t size = 1024, unique = 0;
    while (size < 2 * all->corners + 2) size *= 2;
    slots = calloc(size, sizeof *slots);
    if (indices == NULL || slots == NULL) abort();
    for (size_t c = 0; c < all->corners; c++) {
        uint32_t bits[3];
        memcpy(bits, all->positions + 3 * c, sizeof bits);
        uint64_t hash = bits[0] * UINT64_C(0x9E3779B97F4A7C15) + bits[1];
        hash = (hash ^ hash >> 31) * UINT64_C(0x9E3779B97F4A7C15) + bits[2];
        hash = (hash ^ hash >> 29) * UINT64_C(0x9E3779B97F4A7C15);
        size_t slot = (size_t)(hash >> 20) & (size - 1);
        for (; slots[slot] != 0; slot = (slot + 1) & (size - 1))
            if (!memcmp(all->positions + 3 * (slots[slot] - 1), bits, sizeof bits)) break;
        if (slots[slot] == 0) {
            memmove(all->positions + 3 * unique, bits, sizeof bits);
            slots[slot] = (uint32_t)++unique;
        }
        indices[c] = slots[slot] - 1;
    }
    free(slots);
    model->arrays.indices = indices;
    model->arrays.vertex_count = unique;
}

suite_model *suite_model_create(const char *name, dp_source *source, uint32_t shuffle,
                                size_t crossings, dp_diag *diag) {
    suite_model *model = calloc(1, sizeof *model);
    gathered all = {0};
    if (model == NULL) abort();
    snprintf(model->name, sizeof model->name, "%s", name);
    dp_result result = gather(&all, source, diag);
    model->arrays = (dp_batch){.positions = all.positions,
                               .vertex_count = all.corners,
                               .corner_count = all.corners,
                               .firsts = all.firsts,
                               .polygon_count = all.polygons,
                               .stable = true};
    if (result != DP_OK) goto fail;
    if (shuffle != 0 && all.corners == 3 * all.polygons) shuffle_triangles(&all, shuffle);
    if (shuffle == 0) index_corners(model, &all);
    result = dp_source_from_arrays(&model->arrays, NULL, &model->source, diag);
    if (result != DP_OK) goto fail;
    result = dp_source_extent(model->source, &model->extent, diag);
    if (result != DP_OK) goto fail;
    model->reference = ref_model_create(model->source, all.polygons <= crossings);
    if (model->reference == NULL) goto fail;
    return model;
fail:
    suite_model_destroy(model);
    return NULL;
}

void suite_model_destroy(suite_model *model) {
    if (model == NULL) return;
    ref_model_destroy(model->reference);
    dp_source_destroy(model->source);
    free((void *)model->arrays.positions);
    free((void *)model->arrays.indices);
    free((void *)model->arrays.firsts);
    free(model);
}

/* As close as the view asks, and everything in front of the eye within near and far. */
static void step_nearer(dp_camera *camera, const suite_model *model, const suite_view *view,
                        double aspect) {
    const float *const min = model->extent.min, *const max = model->extent.max;
    double centre[3], eye[3], square = 0, length = 0, near_z, far_z;
    for (int k = 0; k < 3; k++) {
        const double side = (double)max[k] - (double)min[k];
        centre[k] = (double)min[k] + side / 2;
        square += side * side;
        length += view->direction[k] * view->direction[k];
    }
    const double distance = view->nearer * sqrt(square) / 2 / sin(view->fov_y * 3.14159265 / 360);
    for (int k = 0; k < 3; k++) eye[k] = centre[k] + view->direction[k] / sqrt(length) * distance;
    dp_camera_look_at(camera, eye, centre, (const double[3]){0, 1, 0});
    dp_camera_near_far(camera, min, max, &near_z, &far_z);
    dp_camera_perspective(camera, view->fov_y, aspect, near_z, far_z);
}

dp_camera suite_camera(const suite_model *model, const suite_view *view, uint32_t width,
                       uint32_t height) {
    dp_camera camera = {{0}, {0}};
    dp_fit fit = {
        .fov_y = view->fov_y, .orthographic = view->orthographic, .aspect = (double)width / height};
    memcpy(fit.min, model->extent.min, sizeof fit.min);
    memcpy(fit.max, model->extent.max, sizeof fit.max);
    memcpy(fit.direction, view->direction, sizeof fit.direction);
    if (dp_camera_fit(&camera, &fit) != DP_OK) abort();
    if (view->nearer > 0) step_nearer(&camera, model, view, fit.aspect);
    return camera;
}

ref_truth *suite_truth(const suite_model *model, const suite_view *view, const suite_class *set,
                       uint32_t width, uint32_t height) {
    const dp_camera camera = suite_camera(model, view, width, height);
    return ref_truth_create(model->reference, &camera, width, height, set->ridge_angle,
                            set->valley_angle);
}

dp_style suite_style(const suite_class *set, double px, const dp_style *base) {
    dp_style style = *base;
    style.lines = set->lines;
    for (int k = 0; k < DP_LINE_COUNT; k++) style.line[k].width = (float)px;
    style.ridge_angle = (float)set->ridge_angle;
    style.valley_angle = (float)set->valley_angle;
    return style;
}

dp_result suite_draw(dp_context *context, const suite_model *model, const ref_truth *truth,
                     const suite_class *set, double px, const dp_style *base, uint8_t *rgba,
                     dp_diag *diag) {
    const dp_style style = suite_style(set, px, base);
    const dp_target target = {.width = truth->width, .height = truth->height, .rgba = rgba};
    return dp_draw(context, model->source, &truth->camera, &style, &target, diag);
}

/* Appends to a list of complaints. */
static void complain(char *text, size_t size, const char *what, double is, double limit) {
    const size_t used = strlen(text);
    snprintf(text + used, size - used, "%s%s %.4f for %.4f", used > 0 ? ", " : "", what, is, limit);
}

bool suite_missed(const suite_class *set, double px, const score *s, char *text, size_t size) {
    const double missing = (1 - s->recall) * (double)s->samples / 4;
    text[0] = 0;
    if (s->recall < set->recall && missing > little)
        complain(text, size, "recall", s->recall, set->recall);
    if (s->precision < set->precision && s->stray > little)
        complain(text, size, "precision", s->precision, set->precision);
    if (s->cracks > set->uncovered) complain(text, size, "cracks", s->cracks, set->uncovered);
    if (s->width_samples >= WIDTHS_NEEDED && fabs(s->width_median / px - 1) > width_tolerance)
        complain(text, size, "width", s->width_median, px);
    if (set->lines == DP_INTERSECTION && s->width_samples >= WIDTHS_NEEDED) {
        if (s->width_low < px * (1 - uniform)) complain(text, size, "narrowest", s->width_low, px);
        if (s->width_high > px * (1 + uniform)) complain(text, size, "widest", s->width_high, px);
    }
    return text[0] != 0;
}
