/* Sections of models, drawn and compared with the exact cut of each of their triangles: every drawn
 * segment lies on the plane, and outline and drawing cover each other. */
#include "vec.h"

#include <drypoint/drypoint.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

enum { SIDE = 1400 /* px */ };

/* Shares of the length, and of the model's size. */
static const double LEAST = 0.999, OFF_PLANE = 1e-5;

typedef struct line {
    v3 a, b;
} line;

typedef struct lines {
    line *of;
    size_t count, room;
} lines;

static void add(lines *to, v3 a, v3 b) {
    if (to->count == to->room) {
        to->room = 2 * to->room + 64;
        to->of = realloc(to->of, to->room * sizeof *to->of);
        assert_non_null(to->of);
    }
    to->of[to->count++] = (line){a, b};
}

/* ------- the exact outline ------- */

static v3 corner_at(const dp_batch *b, size_t corner) {
    const uint32_t v = b->indices ? b->indices[corner] : (uint32_t)corner;
    const float *const p =
        (const float *)(const void *)((const char *)b->positions + v * b->position_stride);
    return (v3){b->origin[0] + (double)p[0], b->origin[1] + (double)p[1],
                b->origin[2] + (double)p[2]};
}

/* No vertex lies on the plane. */
static void cut(const v3 t[3], v3 n, double offset, lines *to) {
    v3 end[2];
    int count = 0;
    for (int i = 0; i < 3; i++) {
        const v3 a = t[i], b = t[(i + 1) % 3];
        const double p = v3_dot(n, a) - offset, q = v3_dot(n, b) - offset;
        if ((p < 0) == (q < 0)) continue;
        end[count++ & 1] = v3_add(a, v3_mul(v3_sub(b, a), p / (p - q)));
    }
    if (count == 2) add(to, end[0], end[1]);
}

static void find_outline(dp_source *source, v3 n, double offset, lines *to) {
    dp_batch b;
    to->count = 0;
    assert_int_equal(dp_source_rewind(source, NULL), DP_OK);
    while (!dp_source_next(source, &b, NULL) && b.polygon_count)
        for (size_t i = 0; i < b.polygon_count; i++) {
            const size_t first = b.firsts ? b.firsts[i] : 3 * i,
                         end = b.firsts ? b.firsts[i + 1] : 3 * i + 3;
            for (size_t k = first + 1; k + 1 < end; k++) {
                const v3 t[3] = {corner_at(&b, first), corner_at(&b, k), corner_at(&b, k + 1)};
                cut(t, n, offset, to);
            }
        }
    assert_int_equal(dp_source_rewind(source, NULL), DP_OK);
}

/* ------- what is drawn ------- */

/* Looks straight at the section. */
static dp_camera camera_at(v3 n, const dp_extent *e) {
    const v3 centre = {(e->exact_min[0] + e->exact_max[0]) / 2,
                       (e->exact_min[1] + e->exact_max[1]) / 2,
                       (e->exact_min[2] + e->exact_max[2]) / 2};
    const v3 half = {(e->exact_max[0] - e->exact_min[0]) / 2,
                     (e->exact_max[1] - e->exact_min[1]) / 2,
                     (e->exact_max[2] - e->exact_min[2]) / 2};
    const double size = 2 * v3_len(half);
    const v3 eye = v3_add(centre, v3_mul(n, 2 * size));
    const double up[3] = {fabs(n.y) > 0.9, fabs(n.y) <= 0.9, 0};
    dp_camera camera;
    dp_camera_look_at(&camera, (const double[3]){eye.x, eye.y, eye.z},
                      (const double[3]){centre.x, centre.y, centre.z}, up);
    dp_camera_orthographic(&camera, size, 1, 0.1 * size, 5 * size);
    return camera;
}

static void find_drawn(dp_context *context, lines *to) {
    size_t count;
    const dp_segment *const s = dp_segments(context, &count);
    to->count = 0;
    for (size_t i = 0; i < count; i++)
        if (s[i].line == DP_LINE_SECTION)
            add(to, (v3){s[i].world_a[0], s[i].world_a[1], s[i].world_a[2]},
                (v3){s[i].world_b[0], s[i].world_b[1], s[i].world_b[2]});
}

/* ------- gaps ------- */

/* Is there an end of the exact outline where no other one is? Scans have holes. */
static bool is_loose(const lines *exact, v3 p, double reach) {
    for (size_t i = 0; i < exact->count; i++)
        for (int k = 0; k < 2; k++) {
            const v3 end = k ? exact->of[i].b : exact->of[i].a;
            size_t there = 0;
            if (v3_len(v3_sub(end, p)) > reach) continue;
            for (size_t j = 0; j < exact->count; j++)
                there += (size_t)(v3_len(v3_sub(exact->of[j].a, end)) < 1e-6 * reach) +
                         (size_t)(v3_len(v3_sub(exact->of[j].b, end)) < 1e-6 * reach);
            if (there == 1) return true;
        }
    return false;
}

/* Takes out what closes a gap of the outline: it leads from one loose end to another. */
static void drop_gaps(lines *drawn, const lines *exact, double reach) {
    size_t kept = 0;
    for (size_t i = 0; i < drawn->count; i++)
        if (!is_loose(exact, drawn->of[i].a, reach) || !is_loose(exact, drawn->of[i].b, reach))
            drawn->of[kept++] = drawn->of[i];
    drawn->count = kept;
}

/* ------- comparing ------- */

static double distance(v3 p, const line *l) {
    const v3 along = v3_sub(l->b, l->a), on = v3_sub(p, l->a);
    const double square = v3_dot(along, along);
    const double t = square > 0 ? fmin(fmax(v3_dot(on, along) / square, 0), 1) : 0;
    return v3_len(v3_sub(on, v3_mul(along, t)));
}

/* The share of the length of `from` that has something of `to` within reach. */
static double covered(const lines *from, const lines *to, double reach) {
    double sum = 0, met = 0;
    for (size_t i = 0; i < from->count; i++) {
        const v3 a = from->of[i].a, along = v3_sub(from->of[i].b, a);
        const double length = v3_len(along);
        const int steps = 1 + (int)(length / (2 * reach));
        for (int k = 0; k < steps; k++) {
            const v3 p = v3_add(a, v3_mul(along, (k + 0.5) / steps));
            bool there = false;
            for (size_t j = 0; j < to->count && !there; j++)
                there = distance(p, &to->of[j]) <= reach;
            sum += length / steps, met += there ? length / steps : 0;
        }
    }
    return sum > 0 ? met / sum : 0;
}

static void compare(const char *name, dp_source *source, v3 normal, double share) {
    static lines exact, drawn;
    const v3 n = v3_mul(normal, 1 / v3_len(normal));
    dp_extent e;
    dp_diag diag = {0};
    assert_int_equal(dp_source_extent(source, &e, &diag), DP_OK);
    const double size =
        sqrt(pow(e.exact_max[0] - e.exact_min[0], 2) + pow(e.exact_max[1] - e.exact_min[1], 2) +
             pow(e.exact_max[2] - e.exact_min[2], 2));
    const v3 at = {e.exact_min[0] + share * (e.exact_max[0] - e.exact_min[0]),
                   e.exact_min[1] + share * (e.exact_max[1] - e.exact_min[1]),
                   e.exact_min[2] + share * (e.exact_max[2] - e.exact_min[2])};
    const double offset = v3_dot(n, at);
    find_outline(source, n, offset, &exact);
    const dp_clip clip = {.planes = {{{n.x, n.y, n.z}, offset}}, .plane_count = 1};
    dp_source *cut_open;
    dp_context *context;
    assert_int_equal(dp_source_clip(source, &clip, NULL, &cut_open, &diag), DP_OK);
    assert_int_equal(dp_context_create(NULL, &context, &diag), DP_OK);
    const dp_camera camera = camera_at(n, &e);
    const dp_style style = {.lines = DP_SECTION};
    const dp_target target = {.width = SIDE, .height = SIDE};
    if (dp_draw(context, cut_open, &camera, &style, &target, &diag)) fail_msg("%s", diag.message);
    find_drawn(context, &drawn);
    double off = 0;
    for (size_t i = 0; i < drawn.count; i++)
        off = fmax(off, fmax(fabs(v3_dot(n, drawn.of[i].a) - offset),
                             fabs(v3_dot(n, drawn.of[i].b) - offset)));
    const double reach = 0.25 * size / SIDE, recall = covered(&exact, &drawn, reach);
    const size_t count = drawn.count;
    drop_gaps(&drawn, &exact, reach);
    const double precision = covered(&drawn, &exact, reach);
    printf("%-14s (%5.2f %5.2f %5.2f) at %.3f: %5zu segments, %.1e off the plane, recall %.4f, "
           "precision %.4f\n",
           name, n.x, n.y, n.z, share, count, off / size, recall, precision);
    assert_true(drawn.count > 0);
    assert_true(off <= OFF_PLANE * size);
    assert_true(recall >= LEAST);
    assert_true(precision >= LEAST);
    dp_context_destroy(context);
    dp_source_destroy(cut_open);
}

static const struct plane {
    v3 normal;
    double share; /* of the model's box */
} planes[] = {
    {{1, 0, 0}, 0.5137}, {{0, 0, 1}, 0.4711}, {{-1, 2, 0.5}, 0.3313}, {{0.3, -0.2, -1}, 0.6171}};

enum { PLANES = sizeof planes / sizeof *planes };

static void shapes(void **state) {
    static const char *const names[] = {"gear", "bracket", "torus", "bolt"};
    (void)state;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        for (size_t k = 0; k < PLANES; k++) {
            dp_source *source;
            assert_int_equal(dp_source_from_shape(&(dp_shape){.name = names[i]}, &source, NULL),
                             DP_OK);
            compare(names[i], source, planes[k].normal, planes[k].share);
        }
}

static void files(void **state) {
    static const char *const names[] = {"fandisk", "stanford-bunny"};
    (void)state;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        for (size_t k = 0; k < PLANES; k++) {
            char path[200];
            dp_source *source;
            snprintf(path, sizeof path, "%s/../../shared/models/%s.obj", DP_TESTS_DIR, names[i]);
            if (dp_source_open(path, NULL, &source, NULL)) {
                printf("skipped: there is no %s\n", path);
                continue;
            }
            compare(names[i], source, planes[k].normal, planes[k].share);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(shapes), cmocka_unit_test(files)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
