/* Deformed and blended sources: where vertices come to lie, in batches of any kind, with any number of
 * threads, and far from zero.
 *
 * Above 600 lines: deformers and morphs are asked the same of the same models, as one wrapper moves both
 * (mesh/moved.c). */
#include "mesh/source.h"

#include <drypoint/drypoint.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const double TURN = 6.283185307179586;

/* ------- a sheet of N x M quads, 4 long, 2 high, 1 thick at one place ------- */

enum { N = 40, M = 20, VERTICES = (N + 1) * (M + 1), QUADS = N * M };

typedef struct sheet {
    float positions[VERTICES][4]; /* with a gap after each */
    uint32_t corners[4 * QUADS], firsts[QUADS + 1];
    float normal[3];
    uint32_t normal_indices[4 * QUADS];
    dp_batch batch;
} sheet;

static sheet *new_sheet(const double origin[3]) {
    sheet *const s = calloc(1, sizeof *s);
    for (uint32_t v = 0; v < VERTICES; v++) {
        s->positions[v][0] = 4 * (float)(v % (N + 1)) / N - 1;
        s->positions[v][1] = 2 * (float)(v / (N + 1)) / M + 5;
        s->positions[v][2] = v == 0 ? 1 : 0;
    }
    for (uint32_t q = 0; q < QUADS; q++) {
        const uint32_t a = q / N * (N + 1) + q % N;
        const uint32_t corners[4] = {a, a + 1, a + N + 2, a + N + 1};
        memcpy(s->corners + 4 * q, corners, sizeof corners);
        s->firsts[q + 1] = 4 * (q + 1);
    }
    s->normal[2] = 1;
    s->batch = (dp_batch){.positions = s->positions[0],
                          .position_stride = sizeof *s->positions,
                          .vertex_count = VERTICES,
                          .indices = s->corners,
                          .corner_count = 4 * (size_t)QUADS,
                          .firsts = s->firsts,
                          .polygon_count = QUADS,
                          .normals = {s->normal, 0, 1, s->normal_indices}};
    if (origin) memcpy(s->batch.origin, origin, sizeof s->batch.origin);
    return s;
}

static dp_source *source_of(const dp_batch *batch) {
    dp_source *source = NULL;
    assert_int_equal(dp_source_from_arrays(batch, NULL, &source, NULL), DP_OK);
    return source;
}

static dp_source *deformed(dp_source *inner, const dp_deform *deform) {
    dp_source *source = NULL;
    dp_diag diag = {0};
    if (dp_source_deform(inner, deform, NULL, &source, &diag)) fail_msg("%s", diag.message);
    return source;
}

static dp_batch next_of(dp_source *source) {
    dp_batch batch;
    dp_diag diag = {0};
    if (dp_source_next(source, &batch, &diag)) fail_msg("%s", diag.message);
    return batch;
}

static dp_batch batch_at(dp_source *source, double time) {
    assert_int_equal(dp_source_set_time(source, time, NULL), DP_OK);
    assert_int_equal(dp_source_rewind(source, NULL), DP_OK);
    return next_of(source);
}

static const float *vertex(const dp_batch *batch, size_t v) {
    return (const float *)(const void *)((const char *)batch->positions +
                                         v * batch->position_stride);
}

/* Does each vertex lie where the formula has it? */
static void assert_at(const dp_batch *batch, const sheet *s,
                      void formula(const double p[3], double t, double to[3]), double t) {
    assert_int_equal(batch->vertex_count, VERTICES);
    for (size_t v = 0; v < VERTICES; v++) {
        const double p[3] = {(double)s->positions[v][0], (double)s->positions[v][1],
                             (double)s->positions[v][2]};
        double to[3];
        formula(p, t, to);
        for (int k = 0; k < 3; k++)
            if (fabs((double)vertex(batch, v)[k] - to[k]) > 1e-6)
                fail_msg("vertex %zu, %c: %g, not %g", v, "xyz"[k], (double)vertex(batch, v)[k],
                         to[k]);
    }
}

/* ------- the library's own: x is the longest side, z the shortest; the box's centre is 1, 6, 0.5 ------- */

static void usual_wave(const double p[3], double t, double to[3]) {
    const double u = (p[0] + 1) / 4;
    to[0] = p[0], to[1] = p[1];
    to[2] = p[2] + 0.08 * 4 * u * (2 - u) * sin(TURN * (u / 0.6 - t));
}

static void waves_run_along_the_longest_side(void **state) {
    (void)state;
    sheet *const s = new_sheet(NULL);
    dp_source *const source = deformed(source_of(&s->batch), NULL);
    static const double times[] = {0, 0.3, 7.25, -2.1};
    for (size_t k = 0; k < 4; k++) {
        const dp_batch batch = batch_at(source, times[k]);
        assert_at(&batch, s, usual_wave, times[k]);
        assert_memory_equal(vertex(&batch, N + 1), s->positions[N + 1], 3 * sizeof(float));
    }
    const dp_deform *const d = dp_deform_of(source);
    assert_non_null(d);
    assert_true(d->kind == DP_DEFORM_WAVE && d->amplitude == 0.08 && d->length == 0.6 &&
                d->speed == 1 && d->axis[0] == 1 && d->axis[1] == 0 && d->across[2] == 1);
    assert_null(dp_deform_of(NULL));
    dp_source_destroy(source);
    free(s);
}

/* Down y, towards +x and +y. */
static void other_wave(const double p[3], double t, double to[3]) {
    const double u = (7 - p[1]) / 2, w = u + 0.7 * (p[2] - 0.5) / 2;
    const double h = 0.25 * 2 * u * (2 - u) * sin(TURN * (w / 1.5 + 2 * t));
    to[0] = p[0] + 0.6 * h, to[1] = p[1] + 0.8 * h, to[2] = p[2];
}

static void waves_run_any_way(void **state) {
    (void)state;
    sheet *const s = new_sheet(NULL);
    const dp_deform deform = {.amplitude = 0.25,
                              .length = 1.5,
                              .speed = -2,
                              .axis = {0, -1e-200, 0},
                              .across = {3, 4, 0},
                              .slant = -0.7};
    dp_source *const source = deformed(source_of(&s->batch), &deform);
    const dp_batch batch = batch_at(source, 0.7);
    assert_at(&batch, s, other_wave, 0.7);
    dp_source_destroy(source);
    free(s);
}

static void usual_breath(const double p[3], double t, double to[3]) {
    const double h = ((p[0] + 1) / 4 - 0.5) / 0.5, bump = h * h < 1 ? (1 - h * h) * (1 - h * h) : 0;
    const double by = 1 + 0.08 * bump * sin(TURN * 0.25 * t);
    to[0] = p[0], to[1] = 6 + by * (p[1] - 6), to[2] = 0.5 + by * (p[2] - 0.5);
}

static void chests_swell_and_sink(void **state) {
    (void)state;
    sheet *const s = new_sheet(NULL);
    const dp_deform deform = {.kind = DP_DEFORM_BREATHE};
    dp_source *const source = deformed(source_of(&s->batch), &deform);
    dp_batch batch = next_of(source);
    assert_at(&batch, s, usual_breath, 0);
    batch = batch_at(source, 1);
    assert_at(&batch, s, usual_breath, 1);
    batch = batch_at(source, 2.9);
    assert_at(&batch, s, usual_breath, 2.9);
    dp_source_destroy(source);
    free(s);
}

static void usual_twist(const double p[3], double t, double to[3]) {
    const double angle = TURN / 4 * (p[0] + 1) / 4, y = p[1] - 6, z = p[2] - 0.5;
    (void)t;
    to[0] = p[0], to[1] = 6 + y * cos(angle) - z * sin(angle),
    to[2] = 0.5 + z * cos(angle) + y * sin(angle);
}
static void swinging_twist(const double p[3], double t, double to[3]) {
    const double u = (p[0] + 1) / 4 / 0.5, y = p[1] - 6, z = p[2] - 0.5;
    const double angle = -TURN / 8 * (u < 1 ? u : 1) * cos(TURN * 0.5 * t);
    to[0] = p[0], to[1] = 6 + y * cos(angle) - z * sin(angle),
    to[2] = 0.5 + z * cos(angle) + y * sin(angle);
}

static void twists_stand_or_swing(void **state) {
    (void)state;
    sheet *const s = new_sheet(NULL);
    dp_deform deform = {.kind = DP_DEFORM_TWIST};
    dp_source *source = deformed(source_of(&s->batch), &deform);
    dp_batch batch = batch_at(source, 3.3);
    assert_at(&batch, s, usual_twist, 3.3);
    dp_source_destroy(source);
    deform = (dp_deform){
        .kind = DP_DEFORM_TWIST, .amplitude = -45, .length = 0.5, .speed = 0.5, .axis = {2, 0, 0}};
    source = deformed(source_of(&s->batch), &deform);
    batch = batch_at(source, 0.4);
    assert_at(&batch, s, swinging_twist, 0.4);
    dp_source_destroy(source);
    free(s);
}

/* A model that is moved whole is deformed alike: to a millionth, though it lies 5400 km from zero. */
static void far_from_zero_is_as_near_to_it(void **state) {
    (void)state;
    static const double far[3] = {500000.25, 5400000.5, -300};
    sheet *const near_sheet = new_sheet(NULL), *const far_sheet = new_sheet(far);
    for (int kind = 0; kind < 3; kind++) {
        const dp_deform deform = {.kind = (dp_deform_kind)kind};
        dp_source *const a = deformed(source_of(&near_sheet->batch), &deform);
        dp_source *const b = deformed(source_of(&far_sheet->batch), &deform);
        const dp_batch one = batch_at(a, 0.6), other = batch_at(b, 0.6);
        assert_memory_equal(other.origin, far, sizeof far);
        for (size_t v = 0; v < VERTICES; v++)
            for (int k = 0; k < 3; k++)
                assert_true(fabs((double)vertex(&one, v)[k] - (double)vertex(&other, v)[k]) < 1e-6);
        dp_source_destroy(a);
        dp_source_destroy(b);
    }
    free(near_sheet);
    free(far_sheet);
}

/* ------- batches ------- */

static void one_stable_batch_stays_one(void **state) {
    (void)state;
    sheet *const s = new_sheet(NULL);
    dp_source *const source = deformed(source_of(&s->batch), NULL);
    const dp_batch first = batch_at(source, 0.1);
    assert_true(first.stable && first.position_stride == 12);
    assert_ptr_equal(first.indices, s->corners);
    assert_ptr_equal(first.firsts, s->firsts);
    assert_null(first.normals.values); /* those of the still model would be wrong */
    assert_int_equal(next_of(source).polygon_count, 0);
    assert_int_equal(next_of(source).polygon_count, 0);
    const dp_batch second = batch_at(source, 0.2);
    assert_true(second.stable);
    assert_ptr_equal(second.positions, first.positions);
    dp_source_destroy(source);
    free(s);
}

/* An application's source of several batches: triangles of a soup, about origins of their own. */
typedef struct soup {
    float positions[9];
    uint32_t count, at;
    bool stable;
    double time;
} soup;

static dp_result soup_next(void *user, dp_batch *batch, dp_diag *diag) {
    soup *const s = user;
    (void)diag;
    if (s->at == s->count) return DP_OK;
    s->at++;
    const float corner[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    memcpy(s->positions, corner, sizeof corner);
    *batch = (dp_batch){.positions = s->positions,
                        .vertex_count = 3,
                        .corner_count = 3,
                        .polygon_count = 1,
                        .stable = s->stable,
                        .origin = {s->at, s->time, 0}};
    return DP_OK;
}
static dp_result soup_rewind(void *user, dp_diag *diag) {
    (void)diag;
    ((soup *)user)->at = 0;
    return DP_OK;
}
static dp_result soup_set_time(void *user, double time, dp_diag *diag) {
    (void)diag;
    ((soup *)user)->time = time;
    return DP_OK;
}
static const char *soup_name(void *user, uint32_t group) {
    (void)user;
    return group == 3 ? "three" : NULL;
}
static double soup_duration(void *user) {
    (void)user;
    return 9;
}

static dp_source *soup_source(soup *s, bool rewindable) {
    const dp_source_callbacks callbacks = {.user = s,
                                           .next = soup_next,
                                           .rewind = rewindable ? soup_rewind : NULL,
                                           .group_name = soup_name,
                                           .up = {0, 0, 2},
                                           .set_time = soup_set_time,
                                           .duration = soup_duration};
    dp_source *source = NULL;
    assert_int_equal(dp_source_from_callbacks(&callbacks, NULL, &source, NULL), DP_OK);
    return source;
}

/* Notes what it is called with: position y becomes the vertex's number, z the time, normals point
 * along x. */
static void number_vertices(void *user, const dp_vertex_run *run) {
    (void)user;
    const char *at = (const char *)run->positions;
    for (size_t i = 0; i < run->count; i++, at += run->stride) {
        run->moved[i][0] = *(const float *)(const void *)at + (float)run->origin[0];
        run->moved[i][1] = (float)(run->first + i);
        run->moved[i][2] = (float)run->time;
        if (run->normals) memcpy(run->normals[i], (const float[3]){1, 0, 0}, 3 * sizeof(float));
    }
}

static void several_batches_are_moved_one_by_one(void **state) {
    (void)state;
    for (int stable = 0; stable < 2; stable++) {
        soup inner = {.count = 3, .stable = stable};
        const dp_deform deform = {.vertices = number_vertices, .normals = stable};
        dp_source *const source = deformed(soup_source(&inner, true), &deform);
        double up[3];
        assert_true(dp_source_up(source, up) && up[2] == 1);
        assert_string_equal(dp_source_group_name(source, 3), "three");
        assert_true(dp_source_duration(source) == 9);
        assert_int_equal(dp_source_set_time(source, 5, NULL), DP_OK);
        assert_true(inner.time == 5);
        for (int reading = 0; reading < 2; reading++) {
            assert_int_equal(dp_source_rewind(source, NULL), DP_OK);
            for (uint32_t k = 0; k < 3; k++) {
                const dp_batch b = next_of(source);
                assert_false(b.stable);
                assert_true(b.origin[0] == k + 1 && b.origin[1] == 5);
                for (uint32_t v = 0; v < 3; v++) {
                    assert_true(vertex(&b, v)[0] == (float)(v == 1) + (float)(k + 1));
                    assert_true(vertex(&b, v)[1] == (float)(3 * k + v));
                    assert_true(vertex(&b, v)[2] == 5);
                }
                assert_int_equal(b.normals.count, stable ? 3 : 0);
                if (stable) assert_true(b.normals.values[3] == 1);
            }
            assert_int_equal(next_of(source).polygon_count, 0);
        }
        dp_source_destroy(source);
    }
}

static void what_is_read_once_is_moved_once(void **state) {
    (void)state;
    soup inner = {.count = 2};
    const dp_deform own = {.vertices = number_vertices}, wave = {0};
    dp_source *source = NULL, *const once = soup_source(&inner, false);
    dp_diag diag = {0};
    assert_int_equal(dp_source_deform(once, &wave, NULL, &source, &diag), DP_ERR_UNSUPPORTED);
    assert_non_null(strstr(diag.message, "only once"));
    assert_null(source);
    source = deformed(once, &own);
    assert_false(dp_source_rewindable(source));
    assert_int_equal(next_of(source).polygon_count, 1);
    assert_int_equal(next_of(source).polygon_count, 1);
    assert_int_equal(next_of(source).polygon_count, 0);
    dp_source_destroy(source);
}

static void nothing_is_moved_to_nowhere(void **state) {
    (void)state;
    soup inner = {.count = 0};
    dp_source *source = deformed(soup_source(&inner, true), NULL);
    assert_int_equal(batch_at(source, 1).polygon_count, 0);
    dp_source_destroy(source);
    /* a point: no extent, so that there is no wave */
    const float corners[9] = {1, 2, 3, 1, 2, 3, 1, 2, 3};
    const dp_batch point = {
        .positions = corners, .vertex_count = 3, .corner_count = 3, .polygon_count = 1};
    for (int kind = 0; kind < 3; kind++) {
        const dp_deform deform = {.kind = (dp_deform_kind)kind};
        source = deformed(source_of(&point), &deform);
        const dp_batch batch = batch_at(source, 0.4);
        assert_memory_equal(batch.positions, corners, sizeof corners);
        dp_source_destroy(source);
    }
}

/* ------- wrong numbers ------- */

static void assert_refused(const dp_deform *deform, const char *message) {
    soup inner = {.count = 1};
    dp_source *const still = soup_source(&inner, true);
    dp_source *source = still;
    dp_diag diag = {0};
    assert_int_equal(dp_source_deform(still, deform, NULL, &source, &diag), DP_ERR_ARGUMENT);
    assert_null(source);
    if (!strstr(diag.message, message)) fail_msg("no \"%s\" in: %s", message, diag.message);
    dp_source_destroy(still);
}

static void wrong_numbers_are_named(void **state) {
    (void)state;
    dp_source *source;
    assert_refused(&(dp_deform){.amplitude = 11}, "wave: amplitude is 11");
    assert_refused(&(dp_deform){.amplitude = NAN}, "wave: amplitude is nan");
    assert_refused(&(dp_deform){.kind = DP_DEFORM_BREATHE, .amplitude = -1.5},
                   "breathe: amplitude");
    assert_refused(&(dp_deform){.kind = DP_DEFORM_TWIST, .amplitude = INFINITY},
                   "twist: amplitude");
    assert_refused(&(dp_deform){.length = -1}, "wave: length is -1; it must lie between 0.001 and");
    assert_refused(&(dp_deform){.speed = 1e7}, "wave: speed");
    assert_refused(&(dp_deform){.slant = -11}, "wave: slant is -11");
    assert_refused(&(dp_deform){.at = INFINITY}, "wave: at");
    assert_refused(&(dp_deform){.axis = {0, NAN, 0}}, "wave: axis is not finite");
    assert_refused(&(dp_deform){.across = {INFINITY, 0, 0}}, "wave: across");
    assert_refused(&(dp_deform){.kind = (dp_deform_kind)7}, "no kind 7");
    assert_int_equal(dp_source_deform(NULL, NULL, NULL, &source, NULL), DP_ERR_ARGUMENT);
    assert_int_equal(dp_source_deform(NULL, NULL, NULL, NULL, NULL), DP_ERR_ARGUMENT);
}

static void absurd_times_are_refused(void **state) {
    (void)state;
    sheet *const s = new_sheet(NULL);
    dp_source *const source = deformed(source_of(&s->batch), NULL);
    dp_diag diag = {0};
    assert_int_equal(dp_source_set_time(source, NAN, &diag), DP_ERR_ARGUMENT);
    assert_int_equal(dp_source_set_time(source, 1e300, &diag), DP_ERR_ARGUMENT);
    assert_non_null(strstr(diag.message, "at 1e+300 s"));
    const dp_batch batch = batch_at(source, -1e12);
    for (size_t v = 0; v < VERTICES; v++) assert_true(isfinite(vertex(&batch, v)[2]));
    dp_source_destroy(source);
    free(s);
}

/* ------- morphing ------- */

static void twice_as_high(void *user, const dp_vertex_run *run) {
    (void)user;
    for (size_t i = 0; i < run->count; i++) {
        const float *const p =
            (const float *)(const void *)((const char *)run->positions + i * run->stride);
        run->moved[i][0] = p[0], run->moved[i][1] = 2 * p[1], run->moved[i][2] = p[2] - 1;
    }
}

static dp_source *morphed(dp_source *a, dp_source *b, const dp_morph *morph) {
    dp_source *source = NULL;
    dp_diag diag = {0};
    if (dp_source_morph(a, b, morph, NULL, &source, &diag)) fail_msg("%s", diag.message);
    return source;
}

static void assert_blend(const dp_batch *batch, const sheet *s, double f) {
    for (size_t v = 0; v < VERTICES; v++) {
        const double x = (double)s->positions[v][0], y = (double)s->positions[v][1],
                     z = (double)s->positions[v][2];
        const double to[3] = {x, y * (1 + f), z - f};
        for (int k = 0; k < 3; k++)
            if (fabs((double)vertex(batch, v)[k] - to[k]) > 1e-5)
                fail_msg("blend %g, vertex %zu: %g, not %g", f, v, (double)vertex(batch, v)[k],
                         to[k]);
    }
}

static void models_are_blended(void **state) {
    (void)state;
    sheet *const s = new_sheet(NULL);
    const dp_deform high = {.vertices = twice_as_high};
    dp_source *const source =
        morphed(source_of(&s->batch), deformed(source_of(&s->batch), &high), NULL);
    dp_batch batch = next_of(source);
    assert_true(batch.stable);
    assert_blend(&batch, s, 0);
    for (size_t v = 0; v < VERTICES; v++)
        assert_memory_equal(vertex(&batch, v), s->positions[v], 3 * sizeof(float));
    static const double blends[] = {0.25, 1, 1.5, -0.5};
    for (size_t k = 0; k < 4; k++) {
        assert_int_equal(dp_morph_set(source, &(dp_morph){.blend = blends[k]}, NULL), DP_OK);
        batch = batch_at(source, 77);
        assert_blend(&batch, s, blends[k]);
    }
    assert_true(dp_source_duration(source) == 0);
    assert_int_equal(dp_morph_set(source, &(dp_morph){.blend = 0.5, .seconds = 4}, NULL), DP_OK);
    assert_true(dp_source_duration(source) == 2);
    static const double times[] = {-9, 0, 1, 2, 100}, then[] = {0, 0.5, 0.75, 1, 1};
    for (size_t k = 0; k < 5; k++) {
        batch = batch_at(source, times[k]);
        assert_blend(&batch, s, then[k]);
    }
    assert_null(dp_deform_of(source));
    dp_source_destroy(source);
    free(s);
}

/* The second model counts from elsewhere: the result counts from where the first does. */
static void origins_may_differ(void **state) {
    (void)state;
    static const double far[3] = {1e7, -3e6, 0.125}, farther[3] = {1e7 + 64, -3e6, 0.125};
    sheet *const a = new_sheet(far), *const b = new_sheet(farther);
    dp_source *const source =
        morphed(source_of(&a->batch), source_of(&b->batch), &(dp_morph){.blend = 0.5});
    const dp_batch batch = next_of(source);
    assert_memory_equal(batch.origin, far, sizeof far);
    for (size_t v = 0; v < VERTICES; v++)
        assert_true(fabs((double)vertex(&batch, v)[0] - (double)a->positions[v][0] - 32) < 1e-5);
    dp_source_destroy(source);
    free(a);
    free(b);
}

static void assert_other_topology(const dp_batch *a, const dp_batch *b, const char *message) {
    dp_source *const one = source_of(a), *const other = source_of(b);
    dp_source *source = one;
    dp_diag diag = {0};
    assert_int_equal(dp_source_morph(one, other, NULL, NULL, &source, &diag), DP_ERR_FORMAT);
    assert_null(source);
    if (!strstr(diag.message, message)) fail_msg("no \"%s\" in: %s", message, diag.message);
    dp_source_destroy(one);
    dp_source_destroy(other);
}

static void other_topologies_are_refused(void **state) {
    (void)state;
    sheet *const s = new_sheet(NULL), *const t = new_sheet(NULL);
    t->batch.polygon_count--;
    assert_other_topology(&s->batch, &t->batch, "the first has 800 polygons, the second 799");
    t->batch.polygon_count++;
    t->batch.vertex_count--;
    assert_other_topology(&s->batch, &t->batch, "the first has 861 vertices, the second 860");
    t->batch.vertex_count++;
    t->corners[7] = 3;
    assert_other_topology(&s->batch, &t->batch, "the corners of polygon 2 are not");
    t->corners[7] = s->corners[7];
    t->firsts[3]--; /* a triangle, and a pentagon */
    assert_other_topology(&s->batch, &t->batch, "the corners of polygon 3 are not");
    const dp_batch none = {.positions = s->positions[0]};
    assert_other_topology(&none, &s->batch, "the first has 0 polygons, the second 800");
    free(s);
    free(t);
}

static void morphs_check_their_numbers(void **state) {
    (void)state;
    sheet *const s = new_sheet(NULL);
    dp_source *const a = source_of(&s->batch), *const b = source_of(&s->batch), *source;
    soup once = {.count = 1};
    dp_source *const piped = soup_source(&once, false);
    dp_diag diag = {0};
    const dp_morph far = {.blend = 1e4}, none = {.blend = NAN}, back = {.seconds = -1};
    assert_int_equal(dp_source_morph(a, b, &far, NULL, &source, &diag), DP_ERR_ARGUMENT);
    assert_non_null(strstr(diag.message, "a blend of 10000"));
    assert_int_equal(dp_source_morph(a, b, &none, NULL, &source, &diag), DP_ERR_ARGUMENT);
    assert_int_equal(dp_source_morph(a, b, &back, NULL, &source, &diag), DP_ERR_ARGUMENT);
    assert_int_equal(dp_source_morph(a, a, NULL, NULL, &source, &diag), DP_ERR_ARGUMENT);
    assert_int_equal(dp_source_morph(a, NULL, NULL, NULL, &source, &diag), DP_ERR_ARGUMENT);
    assert_int_equal(dp_source_morph(a, b, NULL, NULL, NULL, &diag), DP_ERR_ARGUMENT);
    assert_int_equal(dp_source_morph(a, piped, NULL, NULL, &source, &diag), DP_ERR_UNSUPPORTED);
    assert_int_equal(dp_morph_set(a, &(dp_morph){0}, &diag), DP_ERR_ARGUMENT);
    source = morphed(a, b, NULL);
    assert_int_equal(dp_morph_set(source, NULL, &diag), DP_ERR_ARGUMENT);
    assert_int_equal(dp_morph_set(source, &none, &diag), DP_ERR_ARGUMENT);
    dp_source_destroy(source);
    dp_source_destroy(piped);
    free(s);
}

/* A partner that has changed since. */
static void a_partner_that_changes_is_refused(void **state) {
    (void)state;
    soup one = {.count = 2}, other = {.count = 2};
    dp_source *const source = morphed(soup_source(&one, true), soup_source(&other, true), NULL);
    dp_batch batch;
    dp_diag diag = {0};
    other.count = 1;
    assert_int_equal(dp_source_next(source, &batch, &diag), DP_OK);
    assert_int_equal(dp_source_next(source, &batch, &diag), DP_ERR_FORMAT);
    assert_non_null(strstr(diag.message, "one has 3 vertices the other has 0"));
    dp_source_destroy(source);
}

/* ------- memory ------- */

typedef struct rationed {
    long left; /* allocations that succeed */
} rationed;
static void *rationed_realloc(void *block, size_t size, void *user) {
    return ((rationed *)user)->left-- > 0 ? realloc(block, size) : NULL;
}
static void *rationed_alloc(size_t size, void *user) { return rationed_realloc(NULL, size, user); }
static void rationed_free(void *block, void *user) {
    (void)user;
    free(block);
}

static void memory_may_fail_anywhere(void **state) {
    (void)state;
    sheet *const s = new_sheet(NULL);
    dp_result result = DP_ERR_MEMORY;
    for (long allowed = 0; allowed < 20 && result; allowed++) {
        rationed rest = {allowed};
        const dp_allocator memory = {rationed_alloc, rationed_realloc, rationed_free, &rest};
        dp_source *a = source_of(&s->batch), *b = source_of(&s->batch), *source = NULL;
        dp_batch batch;
        dp_diag diag = {0};
        const dp_deform deform = {.vertices = number_vertices, .normals = true};
        result = dp_source_morph(a, b, NULL, &memory, &source, &diag);
        if (!result) a = source, b = NULL;
        if (!result && !(result = dp_source_deform(a, &deform, &memory, &source, &diag)))
            a = source;
        if (!result) result = dp_source_next(a, &batch, &diag);
        if (result) assert_int_equal(result, DP_ERR_MEMORY);
        if (result) assert_non_null(strstr(diag.message, "out of memory"));
        dp_source_destroy(a);
        dp_source_destroy(b);
    }
    assert_int_equal(result, DP_OK);
    free(s);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(waves_run_along_the_longest_side),
        cmocka_unit_test(waves_run_any_way),
        cmocka_unit_test(chests_swell_and_sink),
        cmocka_unit_test(twists_stand_or_swing),
        cmocka_unit_test(far_from_zero_is_as_near_to_it),
        cmocka_unit_test(one_stable_batch_stays_one),
        cmocka_unit_test(several_batches_are_moved_one_by_one),
        cmocka_unit_test(what_is_read_once_is_moved_once),
        cmocka_unit_test(nothing_is_moved_to_nowhere),
        cmocka_unit_test(wrong_numbers_are_named),
        cmocka_unit_test(absurd_times_are_refused),
        cmocka_unit_test(models_are_blended),
        cmocka_unit_test(origins_may_differ),
        cmocka_unit_test(other_topologies_are_refused),
        cmocka_unit_test(morphs_check_their_numbers),
        cmocka_unit_test(a_partner_that_changes_is_refused),
        cmocka_unit_test(memory_may_fail_anywhere),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
