/* Generated models, smooth and rough, and their segments, for tests of dp_style.detail. Include after cmocka's
 * headers. */
#ifndef TESTS_UNIT_ROUGH_H
#define TESTS_UNIT_ROUGH_H

#include <drypoint/drypoint.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A model whose corners are all its own. */
typedef struct rough_model {
    float *positions; /* [3 * triangles][3] */
    size_t triangles;
    dp_source *source; /* of these */
} rough_model;

/* From -1 to 1, and the same for the same position. */
static inline float noise_at(const float p[3]) {
    uint32_t h = 1;
    for (int k = 0; k < 3; k++) {
        const float x = p[k] + 0.0f; /* -0 is 0 */
        uint32_t bits;
        memcpy(&bits, &x, sizeof bits);
        h = (h ^ bits) * 0x9E3779B1u, h ^= h >> 15, h *= 0x85EBCA77u, h ^= h >> 13;
    }
    return (float)(h >> 8) / 8388608 - 1;
}

/* The generated shape, each vertex moved by up to `noise` along a direction from 0, or upwards. */
static inline rough_model make_rough(const char *name, uint64_t triangles, float noise,
                                     bool upwards) {
    dp_source *shape = NULL;
    dp_batch b;
    rough_model m = {0};
    const dp_shape of = {.name = name, .triangles = triangles};
    assert_int_equal(dp_source_from_shape(&of, &shape, NULL), DP_OK);
    for (;;) {
        assert_int_equal(dp_source_next(shape, &b, NULL), DP_OK);
        if (!b.polygon_count) break;
        m.positions = realloc(m.positions, (m.triangles + b.polygon_count) * 9 * sizeof(float));
        assert_non_null(m.positions);
        for (size_t c = 0; c < 3 * b.polygon_count; c++) {
            const size_t v = b.indices ? b.indices[c] : c;
            const float *const p =
                (const float *)(const void *)((const char *)b.positions + v * b.position_stride);
            float *const to = m.positions + 9 * m.triangles + 3 * c;
            const float by = noise * noise_at(p),
                        far = sqrtf(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
            for (int k = 0; k < 3; k++)
                to[k] = p[k] + by * (upwards ? (k == 1) : far > 0 ? p[k] / far : 0);
        }
        m.triangles += b.polygon_count;
    }
    dp_source_destroy(shape);
    const dp_batch all = {.positions = m.positions,
                          .vertex_count = 3 * m.triangles,
                          .corner_count = 3 * m.triangles,
                          .polygon_count = m.triangles};
    assert_int_equal(dp_source_from_arrays(&all, NULL, &m.source, NULL), DP_OK);
    return m;
}

static inline void free_rough(rough_model *m) {
    dp_source_destroy(m->source);
    free(m->positions);
    *m = (rough_model){0};
}

/* A view of a source, from a direction, in the middle of a picture. */
static inline dp_camera view_of(dp_source *source, const double from[3], bool orthographic,
                                double aspect) {
    dp_fit fit = {.aspect = aspect, .orthographic = orthographic, .up = {0, 1, 0}};
    dp_camera camera;
    memcpy(fit.direction, from, sizeof fit.direction);
    if (!fit.direction[0] && !fit.direction[2]) fit.up[1] = 0, fit.up[2] = 1;
    assert_int_equal(dp_camera_fit_source(&camera, &fit, source, NULL, NULL), DP_OK);
    return camera;
}

/* Copies what a context has found. */
typedef struct found_lines {
    dp_segment *segments;
    size_t count;
} found_lines;

static inline found_lines lines_of(dp_context *context) {
    found_lines f;
    const dp_segment *const s = dp_segments(context, &f.count);
    f.segments = malloc((f.count + 1) * sizeof *s);
    assert_non_null(f.segments);
    if (f.count) memcpy(f.segments, s, f.count * sizeof *s);
    return f;
}

static inline void free_lines(found_lines *f) {
    free(f->segments);
    *f = (found_lines){0};
}

static inline double length_of(const dp_segment *s) {
    return hypot((double)s->b[0] - (double)s->a[0], (double)s->b[1] - (double)s->a[1]);
}

/* px of the lines of some classes at one level, 0: visible. */
static inline double length_at(const found_lines *f, uint32_t classes, uint32_t level) {
    double sum = 0;
    for (size_t i = 0; i < f->count; i++)
        if (classes & 1u << f->segments[i].line && f->segments[i].level == level)
            sum += length_of(&f->segments[i]);
    return sum;
}

/* Member by member: what lies between members may be anything. */
static inline bool same_segment(const dp_segment *a, const dp_segment *b) {
    return a->line == b->line && !memcmp(a->a, b->a, sizeof a->a) &&
           !memcmp(a->b, b->b, sizeof a->b) && !memcmp(a->world_a, b->world_a, sizeof a->world_a) &&
           !memcmp(a->world_b, b->world_b, sizeof a->world_b) && a->polygon == b->polygon &&
           a->other == b->other && a->edge == b->edge && a->color == b->color &&
           a->level == b->level && a->end[0] == b->end[0] && a->end[1] == b->end[1] &&
           a->hider[0] == b->hider[0] && a->hider[1] == b->hider[1] &&
           !memcmp(&a->width, &b->width, sizeof a->width);
}

static inline void expect_same_lines(const found_lines *a, const found_lines *b, const char *what) {
    if (a->count != b->count) fail_msg("%s: %zu segments, not %zu", what, b->count, a->count);
    for (size_t i = 0; i < a->count; i++)
        if (!same_segment(&a->segments[i], &b->segments[i]))
            fail_msg("%s: segment %zu differs", what, i);
}

#endif
