/* fit: cameras that show what is drawn of a source, and what is up in it. */
#include "drawing.h"
#include "temporary.h"

#include <math.h>
#include <stdint.h>
#include <string.h>
#include <unistd.h>

enum { CORNERS = 600, TRIANGLES = CORNERS / 3 };

static const double MARGIN = 0.04;

/* What of a picture is used, from -1 to 1 on both axes; depths from -1 (near) to 1. */
typedef struct used {
    double min[3], max[3];
} used;

static void take(used *u, const dp_camera *camera, const double p[3]) {
    double v[4], clip[4];
    for (int r = 0; r < 4; r++)
        v[r] = camera->view[r] * p[0] + camera->view[4 + r] * p[1] + camera->view[8 + r] * p[2] +
               camera->view[12 + r];
    for (int r = 0; r < 4; r++)
        clip[r] = camera->projection[r] * v[0] + camera->projection[4 + r] * v[1] +
                  camera->projection[8 + r] * v[2] + camera->projection[12 + r] * v[3];
    assert_true(clip[3] > 0);
    for (int k = 0; k < 3; k++) {
        u->min[k] = fmin(u->min[k], clip[k] / clip[3]);
        u->max[k] = fmax(u->max[k], clip[k] / clip[3]);
    }
}

static used used_by(dp_source *source, const dp_camera *camera) {
    used u = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    for (;;) {
        dp_batch b;
        assert_int_equal(dp_source_next(source, &b, NULL), DP_OK);
        if (!b.polygon_count) break;
        for (size_t c = 0; c < 3 * b.polygon_count; c++) {
            const float *const p = b.positions + 3 * (b.indices ? b.indices[c] : c);
            const double at[3] = {b.origin[0] + (double)p[0], b.origin[1] + (double)p[1],
                                  b.origin[2] + (double)p[2]};
            take(&u, camera, at);
        }
    }
    assert_int_equal(dp_source_rewind(source, NULL), DP_OK);
    return u;
}

/* One axis has exactly the margin, and the model is in the middle of the other one. */
static void assert_fits(const used *u, double accuracy) {
    const double x = fmax(u->max[0], -u->min[0]), y = fmax(u->max[1], -u->min[1]);
    const double middle_x = u->min[0] + u->max[0], middle_y = u->min[1] + u->max[1];
    if (!(fabs(fmax(x, y) - (1 - MARGIN)) < 1e-9) || !(fabs(middle_x) < accuracy) ||
        !(fabs(middle_y) < accuracy) || u->min[2] < -1 || u->max[2] > 1)
        fail_msg("x %g to %g, y %g to %g, z %g to %g", u->min[0], u->max[0], u->min[1], u->max[1],
                 u->min[2], u->max[2]);
}

/* ---- pictures ---- */

/* The rows and columns with ink in a picture of white paper. */
static void find_ink(const uint8_t *rgba, int width, int height, int span[4]) {
    span[0] = width, span[1] = -1, span[2] = height, span[3] = -1;
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++)
            if (rgba[4 * (y * width + x)] < 128) {
                span[0] = x < span[0] ? x : span[0], span[1] = x > span[1] ? x : span[1];
                span[2] = y < span[2] ? y : span[2], span[3] = y;
            }
}

static void a_sphere_is_in_the_middle(void **state) {
    static const int sizes[][2] = {{320, 240}, {240, 320}, {300, 300}, {480, 120}};
    static const double fovs[] = {5, 35, 90, 170, 0 /* orthographic */};
    dp_source *const sphere = new_shape("sphere", NULL);
    dp_context *context = NULL;
    (void)state;
    assert_int_equal(dp_context_create(NULL, &context, NULL), DP_OK);
    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++)
        for (size_t f = 0; f < sizeof fovs / sizeof *fovs; f++) {
            const int width = sizes[s][0], height = sizes[s][1];
            const dp_fit fit = {.aspect = (double)width / height,
                                .direction = {0, 0, 1},
                                .fov_y = fovs[f],
                                .orthographic = fovs[f] <= 0};
            uint8_t *const rgba = calloc((size_t)width * (size_t)height, 4);
            const dp_target target = {
                .width = (uint32_t)width, .height = (uint32_t)height, .rgba = rgba};
            dp_camera camera;
            int span[4];
            assert_int_equal(dp_camera_fit_source(&camera, &fit, sphere, NULL, NULL), DP_OK);
            assert_int_equal(dp_draw(context, sphere, &camera, NULL, &target, NULL), DP_OK);
            find_ink(rgba, width, height, span);
            const int right = width - 1 - span[1], below = height - 1 - span[3];
            if (abs(span[0] - right) > 1 || abs(span[2] - below) > 1)
                fail_msg("%d x %d, %g degrees: margins %d %d %d %d", width, height, fovs[f],
                         span[0], right, span[2], below);
            free(rgba);
        }
    dp_context_destroy(context);
    dp_source_destroy(sphere);
}

/* ---- random triangles ---- */

static uint32_t random_bits(uint32_t *seed) {
    *seed = *seed * 1664525 + 1013904223;
    return *seed >> 8;
}

static float between(uint32_t *seed, float low, float high) {
    return low + (high - low) * (float)random_bits(seed) / 16777216.0f;
}

/* Triangles in a box of its own size, which one cluster leaves. */
static void make_soup(uint32_t seed, float positions[CORNERS][3]) {
    const float size[3] = {between(&seed, 0.1f, 3), between(&seed, 0.1f, 3),
                           between(&seed, 0.1f, 3)};
    for (int c = 0; c < CORNERS; c++)
        for (int k = 0; k < 3; k++)
            positions[c][k] = between(&seed, -size[k], size[k]) + (c < 30 && k == 0 ? 2 : 0);
}

static dp_source *source_of(const dp_batch *batch) {
    dp_source *source = NULL;
    assert_int_equal(dp_source_from_arrays(batch, NULL, &source, NULL), DP_OK);
    return source;
}

static dp_batch soup_batch(float positions[CORNERS][3]) {
    return (dp_batch){.positions = positions[0],
                      .vertex_count = CORNERS,
                      .corner_count = CORNERS,
                      .polygon_count = TRIANGLES};
}

static void anything_is_seen_whole(void **state) {
    static const double fovs[] = {5, 35, 60, 0}, aspects[] = {0.4, 1, 4.0 / 3.0, 3};
    static const double directions[][3] = {{0}, {0, 0, 1}, {0, 1, 0}, {-3, 0.1, 2}, {1, -2, 0.5}};
    static float positions[CORNERS][3];
    (void)state;
    for (uint32_t seed = 1; seed <= 8; seed++)
        for (size_t f = 0; f < sizeof fovs / sizeof *fovs; f++)
            for (size_t a = 0; a < sizeof aspects / sizeof *aspects; a++) {
                dp_fit fit = {.fov_y = fovs[f], .aspect = aspects[a], .orthographic = fovs[f] <= 0};
                const size_t d = (seed + f + a) % (sizeof directions / sizeof *directions);
                memcpy(fit.direction, directions[d], sizeof fit.direction);
                make_soup(seed, positions);
                const dp_batch batch = soup_batch(positions);
                dp_source *const source = source_of(&batch);
                dp_camera camera;
                assert_int_equal(dp_camera_fit_source(&camera, &fit, source, NULL, NULL), DP_OK);
                const used u = used_by(source, &camera);
                assert_fits(&u, 1e-4); /* a tenth of a pixel of 2000 */
                dp_source_destroy(source);
            }
}

/* Where no eye outside fills the picture, it comes as near as the near plane allows. */
static void wide_angles_are_not_cut(void **state) {
    static float positions[CORNERS][3];
    (void)state;
    for (uint32_t seed = 1; seed <= 16; seed++) {
        make_soup(seed, positions);
        const dp_batch batch = soup_batch(positions);
        dp_source *const source = source_of(&batch);
        const dp_fit fit = {.fov_y = seed % 2 ? 170 : 100};
        dp_camera camera;
        assert_int_equal(dp_camera_fit_source(&camera, &fit, source, NULL, NULL), DP_OK);
        const used u = used_by(source, &camera);
        for (int k = 0; k < 3; k++) assert_true(u.min[k] >= -1 && u.max[k] <= 1);
        assert_true(fabs(u.min[0] + u.max[0]) < 1e-4 && fabs(u.min[1] + u.max[1]) < 1e-4);
        dp_source_destroy(source);
    }
}

/* Neither order nor batches nor threads change a bit: a file of records, the same in one batch, and
 * backwards. */
static void order_changes_nothing(void **state) {
    enum { MANY = 30000 };
    static float positions[3 * MANY][3], backwards[3 * MANY][3];
    uint8_t header[84] = {0};
    char path[256];
    dp_source *file = NULL;
    dp_camera camera[3];
    uint32_t seed = 5;
    (void)state;
    for (int c = 0; c < 3 * MANY; c++)
        for (int k = 0; k < 3; k++) positions[c][k] = between(&seed, -1, 1);
    for (int c = 0; c < 3 * MANY; c++)
        memcpy(backwards[3 * MANY - 1 - c], positions[c], sizeof *positions);
    temporary_name(path, sizeof path, "fit");
    FILE *const out = fdopen(mkstemp(path), "wb");
    header[80] = MANY & 255, header[81] = MANY >> 8;
    fwrite(header, sizeof header, 1, out);
    for (int i = 0; i < MANY; i++) {
        const uint8_t rest[12] = {0};
        fwrite(rest, 12, 1, out);
        fwrite(positions[3 * i], 36, 1, out);
        fwrite(rest, 2, 1, out);
    }
    fclose(out);
    assert_int_equal(dp_source_open(path, NULL, &file, NULL), DP_OK);
    dp_batch batch = {.vertex_count = 3 * MANY, .corner_count = 3 * MANY, .polygon_count = MANY};
    batch.positions = positions[0];
    dp_source *const forth = source_of(&batch);
    batch.positions = backwards[0];
    dp_source *const back = source_of(&batch);
    const dp_fit fit = {.up = {0, 0, 1}, .direction = {2, -3, 1}};
    assert_int_equal(dp_camera_fit_source(&camera[0], &fit, file, NULL, NULL), DP_OK);
    assert_int_equal(dp_camera_fit_source(&camera[1], &fit, forth, NULL, NULL), DP_OK);
    assert_int_equal(dp_camera_fit_source(&camera[2], &fit, back, NULL, NULL), DP_OK);
    assert_memory_equal(&camera[0], &camera[1], sizeof *camera);
    assert_memory_equal(&camera[0], &camera[2], sizeof *camera);
    dp_source_destroy(file);
    dp_source_destroy(forth);
    dp_source_destroy(back);
    unlink(path);
}

/* ---- what counts ---- */

static const float house[][3] = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}, {1, 2, -1}};
static const uint32_t walls[] = {0, 1, 2, 0, 2, 3, 3, 2, 4};

static dp_camera fitted(const dp_batch *batch, dp_extent *extent) {
    dp_source *const source = source_of(batch);
    dp_camera camera;
    assert_int_equal(dp_camera_fit_source(&camera, NULL, source, extent, NULL), DP_OK);
    dp_source_destroy(source);
    return camera;
}

static void only_what_is_drawn_counts(void **state) {
    float more[10][3] = {{0}};
    uint32_t indices[21] = {0};
    dp_extent extent;
    (void)state;
    dp_batch batch = {.positions = house[0],
                      .vertex_count = 5,
                      .indices = walls,
                      .corner_count = 9,
                      .polygon_count = 3};
    const dp_camera camera = fitted(&batch, NULL);
    memcpy(more, house, sizeof house);
    memcpy(indices, walls, sizeof walls);
    more[5][0] = 50; /* no polygon uses it */
    more[6][1] = NAN, more[7][2] = -70, more[8][2] = INFINITY, more[9][1] = 90;
    memcpy(indices + 9, (const uint32_t[]){0, 6, 7, 8, 7, 0, 0, 7, 99, 9, 9, 9}, 48);
    batch.positions = more[0], batch.vertex_count = 10, batch.indices = indices;
    batch.corner_count = 21, batch.polygon_count = 7;
    const dp_camera same = fitted(&batch, &extent);
    assert_memory_equal(&camera, &same, sizeof camera);
    assert_int_equal(extent.polygons, 7);
    assert_int_equal(extent.not_finite, 2);
    assert_int_equal(extent.bad_index, 1);
    assert_true(extent.exact_max[1] >= 90); /* the extent counts what has no area */
}

/* Beside a model far from 0, positions count from an origin. */
static void far_from_zero_nothing_is_lost(void **state) {
    const double origin[3] = {692345, 5334567, 512};
    dp_batch batch = {.positions = house[0],
                      .vertex_count = 5,
                      .indices = walls,
                      .corner_count = 9,
                      .polygon_count = 3};
    dp_source *const near_source = source_of(&batch);
    memcpy(batch.origin, origin, sizeof origin);
    dp_source *const far_source = source_of(&batch);
    dp_camera near_camera, far_camera;
    (void)state;
    assert_int_equal(dp_camera_fit_source(&near_camera, NULL, near_source, NULL, NULL), DP_OK);
    assert_int_equal(dp_camera_fit_source(&far_camera, NULL, far_source, NULL, NULL), DP_OK);
    const used here = used_by(near_source, &near_camera), there = used_by(far_source, &far_camera);
    for (int k = 0; k < 3; k++) {
        assert_true(fabs(here.min[k] - there.min[k]) < 1e-7);
        assert_true(fabs(here.max[k] - there.max[k]) < 1e-7);
    }
    dp_source_destroy(near_source);
    dp_source_destroy(far_source);
}

static void a_box_is_seen_as_well(void **state) {
    const dp_batch batch = {.positions = house[0],
                            .vertex_count = 5,
                            .indices = walls,
                            .corner_count = 9,
                            .polygon_count = 3};
    dp_source *const source = source_of(&batch);
    const dp_fit fit = {.min = {-4, 0, -4}, .max = {4, 0, 4}};
    dp_camera camera;
    (void)state;
    assert_int_equal(dp_camera_fit_source(&camera, &fit, source, NULL, NULL), DP_OK);
    used u = used_by(source, &camera);
    for (int i = 0; i < 4; i++)
        take(&u, &camera, (const double[3]){i & 1 ? 4 : -4, 0, i & 2 ? 4 : -4});
    assert_fits(&u, 1.0 / 2000);
    dp_source_destroy(source);
}

static void what_cannot_be_fitted_is_refused(void **state) {
    const float lost[3][3] = {{NAN, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const dp_batch batch = {
        .positions = lost[0], .vertex_count = 3, .corner_count = 3, .polygon_count = 1};
    dp_source *const source = source_of(&batch);
    dp_extent extent = {0};
    dp_camera camera;
    dp_diag diag;
    (void)state;
    assert_int_equal(dp_camera_fit_source(&camera, NULL, source, &extent, &diag), DP_ERR_ARGUMENT);
    assert_int_equal(extent.not_finite, 1);
    assert_true(strlen(diag.message) > 0);
    assert_int_equal(dp_camera_fit_source(&camera, &(dp_fit){.fov_y = 180}, source, NULL, NULL),
                     DP_ERR_ARGUMENT);
    assert_int_equal(dp_camera_fit_source(&camera, NULL, NULL, NULL, NULL), DP_ERR_ARGUMENT);
    dp_source_destroy(source);
}

static void steady_is_of_the_box(void **state) {
    dp_source *const source = new_shape("torus", NULL);
    dp_camera camera, boxed;
    dp_extent extent;
    (void)state;
    dp_fit fit = {.steady = true, .direction = {1, 2, 3}, .up = {0, 1, 0}};
    assert_int_equal(dp_camera_fit_source(&camera, &fit, source, &extent, NULL), DP_OK);
    memcpy(fit.min, extent.min, sizeof fit.min);
    memcpy(fit.max, extent.max, sizeof fit.max);
    assert_int_equal(dp_camera_fit(&boxed, &fit), DP_OK);
    for (int i = 0; i < 16; i++) {
        assert_true(fabs(camera.view[i] - boxed.view[i]) < 1e-6);
        assert_true(fabs(camera.projection[i] - boxed.projection[i]) < 1e-6);
    }
    dp_source_destroy(source);
}

/* ---- what is up ---- */

static void sides_turn_with_what_is_up(void **state) {
    static const double sides[][3][3] = {
        /* up, right, front */
        {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}},   {{0, 2, 0}, {1, 0, 0}, {0, 0, 1}},
        {{0, -1, 0}, {1, 0, 0}, {0, 0, -1}}, {{0, 0, 1}, {1, 0, 0}, {0, -1, 0}},
        {{0, 0, -3}, {1, 0, 0}, {0, 1, 0}},  {{1, 0, 0}, {0, -1, 0}, {0, 0, 1}},
        {{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    double right[3], front[3];
    (void)state;
    for (size_t i = 0; i < sizeof sides / sizeof *sides; i++) {
        assert_int_equal(dp_camera_sides(sides[i][0], right, front), DP_OK);
        for (int k = 0; k < 3; k++) {
            assert_true(right[k] == sides[i][1][k]);
            assert_true(front[k] == sides[i][2][k]);
        }
    }
    const double aslant[3] = {1, 2, 3}, lost[3] = {NAN, 0, 0};
    assert_int_equal(dp_camera_sides(aslant, right, front), DP_OK);
    double along[3] = {0};
    for (int k = 0; k < 3; k++) {
        along[0] += right[k] * front[k];
        along[1] += right[k] * aslant[k];
        along[2] += front[k] * aslant[k];
    }
    for (int k = 0; k < 3; k++) assert_true(fabs(along[k]) < 1e-12);
    assert_int_equal(dp_camera_sides(lost, right, front), DP_ERR_ARGUMENT);
}

static dp_result no_more(void *user, dp_batch *batch, dp_diag *diag) {
    (void)user, (void)batch, (void)diag;
    return DP_OK;
}

static void assert_up(const dp_source *source, const double up[3], bool said) {
    double found[3];
    assert_int_equal(dp_source_up(source, found), said);
    for (int k = 0; k < 3; k++) assert_true(found[k] == up[k]);
}

static void sources_say_what_is_up(void **state) {
    static const char stl[] = "solid a\nendsolid a\n",
                      obj[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    static const double x[3] = {1, 0, 0}, y[3] = {0, 1, 0}, z[3] = {0, 0, 1};
    dp_source_callbacks callbacks = {.next = no_more};
    const dp_memory_file files[] = {{.data = stl, .size = sizeof stl - 1, .name = "a.stl"},
                                    {.data = obj, .size = sizeof obj - 1, .name = "a.obj"}};
    dp_source *source = new_shape("gear", NULL);
    (void)state;
    assert_up(source, y, true);
    dp_source_destroy(source);
    assert_up(NULL, y, false);
    for (int k = 0; k < 2; k++) {
        assert_int_equal(dp_source_open_memory(&files[k], NULL, &source, NULL), DP_OK);
        assert_up(source, k ? y : z, false);
        dp_source_destroy(source);
    }
    for (int k = 0; k < 2; k++) {
        callbacks.up[0] = 0.5 * k;
        assert_int_equal(dp_source_from_callbacks(&callbacks, NULL, &source, NULL), DP_OK);
        assert_up(source, k ? x : y, k);
        dp_source_destroy(source);
    }
    callbacks.up_assumed = true;
    assert_int_equal(dp_source_from_callbacks(&callbacks, NULL, &source, NULL), DP_OK);
    assert_up(source, x, false);
    dp_source_destroy(source);
}

/* A source that stands on z is seen as one on y that is turned. */
static void the_usual_view_turns_with_what_is_up(void **state) {
    static const char stl[] =
        "solid a\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
        "vertex 0 -1 2\nendloop\nendfacet\nendsolid a\n";
    static const float turned[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 2, 1}};
    const dp_memory_file file = {.data = stl, .size = sizeof stl - 1, .name = "a.stl"};
    const dp_batch batch = {
        .positions = turned[0], .vertex_count = 3, .corner_count = 3, .polygon_count = 1};
    dp_source *const on_y = source_of(&batch), *on_z = NULL;
    dp_camera y_camera, z_camera;
    (void)state;
    assert_int_equal(dp_source_open_memory(&file, NULL, &on_z, NULL), DP_OK);
    assert_int_equal(dp_camera_fit_source(&y_camera, NULL, on_y, NULL, NULL), DP_OK);
    assert_int_equal(dp_camera_fit_source(&z_camera, NULL, on_z, NULL, NULL), DP_OK);
    const used y = used_by(on_y, &y_camera), z = used_by(on_z, &z_camera);
    for (int k = 0; k < 3; k++)
        assert_true(fabs(y.min[k] - z.min[k]) < 1e-9 && fabs(y.max[k] - z.max[k]) < 1e-9);
    dp_source_destroy(on_y);
    dp_source_destroy(on_z);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_sphere_is_in_the_middle),
        cmocka_unit_test(anything_is_seen_whole),
        cmocka_unit_test(wide_angles_are_not_cut),
        cmocka_unit_test(order_changes_nothing),
        cmocka_unit_test(only_what_is_drawn_counts),
        cmocka_unit_test(far_from_zero_nothing_is_lost),
        cmocka_unit_test(a_box_is_seen_as_well),
        cmocka_unit_test(what_cannot_be_fitted_is_refused),
        cmocka_unit_test(steady_is_of_the_box),
        cmocka_unit_test(sides_turn_with_what_is_up),
        cmocka_unit_test(sources_say_what_is_up),
        cmocka_unit_test(the_usual_view_turns_with_what_is_up),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
