/* drypoint/path.h: a camera's way between key views. */
#include <drypoint/path.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static dp_camera_path *make(const dp_key_view *views, size_t count) {
    dp_camera_path *path;
    dp_diag diag = {0};
    if (dp_camera_path_create(views, count, NULL, NULL, &path, &diag)) fail_msg("%s", diag.message);
    return path;
}

static dp_key_view view_at(const dp_camera_path *path, double time) {
    dp_key_view view;
    assert_int_equal(dp_camera_path_view(path, time, &view), DP_OK);
    return view;
}

static void assert_point(const double p[3], double x, double y, double z) {
    const double wanted[3] = {x, y, z};
    for (int k = 0; k < 3; k++)
        if (fabs(p[k] - wanted[k]) > 1e-12)
            fail_msg("(%g, %g, %g), not (%g, %g, %g)", p[0], p[1], p[2], x, y, z);
}

/* ---- interpolation ---- */

static void test_keys_are_met(void **state) {
    const dp_key_view keys[] = {{0, {0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 40, 0},
                                {1, {3, 1, 4}, {1, 0, 0}, {0, 2, 0}, 20, 0},
                                {4, {5, 0, 0}, {0, 1, 0}, {0, 0, 1}, 60, 0}};
    dp_camera_path *const path = make(keys, 3);
    (void)state;
    for (int k = 0; k < 3; k++) {
        const dp_key_view v = view_at(path, keys[k].time);
        assert_point(v.eye, keys[k].eye[0], keys[k].eye[1], keys[k].eye[2]);
        assert_point(v.target, keys[k].target[0], keys[k].target[1], keys[k].target[2]);
        assert_true(v.fov_y == keys[k].fov_y && v.height == 0);
    }
    assert_true(dp_camera_path_begin(path) == 0 && dp_camera_path_end(path) == 4);
    assert_false(dp_camera_path_closed(path));
    /* before and after it stands still */
    assert_point(view_at(path, -7).eye, 0, 0, 5);
    assert_point(view_at(path, 70).eye, 5, 0, 0);
    dp_camera_path_destroy(path);
}

/* Keys of a parabola, at uneven times, give that parabola between inner keys. */
static void test_parabola(void **state) {
    static const double times[] = {0, 1, 1.5, 4, 5};
    dp_key_view keys[5];
    (void)state;
    for (int k = 0; k < 5; k++) {
        const double t = times[k];
        keys[k] = (dp_key_view){.time = t, .eye = {t, t * t, 9 - t}, .target = {0, 0, -1}};
    }
    dp_camera_path *const path = make(keys, 5);
    for (double t = 1; t <= 4; t += 0.125) assert_point(view_at(path, t).eye, t, t * t, 9 - t);
    dp_camera_path_destroy(path);
}

/* The speed at a key is the same from both sides. */
static void test_smooth(void **state) {
    const dp_key_view keys[] = {{0, {0, 0, 5}, {0, 0, 0}, {0}, 40, 0},
                                {1, {3, 1, 4}, {1, 0, 0}, {0}, 20, 0},
                                {1.25, {5, 0, 0}, {0, 1, 0}, {0}, 15, 0},
                                {4, {0, 0, 5}, {0, 0, 0}, {0}, 40, 0}};
    dp_camera_path *const path = make(keys, 4);
    const double h = 1e-6;
    (void)state;
    assert_true(dp_camera_path_closed(path));
    for (int k = 0; k < 4; k++) {
        const double t = keys[k].time;
        const dp_key_view a = view_at(path, t - h), b = view_at(path, t), c = view_at(path, t + h);
        for (int i = 0; i < 3; i++)
            assert_true(fabs((b.eye[i] - a.eye[i]) - (c.eye[i] - b.eye[i])) < 1e-4 * h);
        assert_true(fabs((b.fov_y - a.fov_y) - (c.fov_y - b.fov_y)) < 1e-3 * h);
    }
    /* round and round */
    const dp_key_view once = view_at(path, 0.7), again = view_at(path, 0.7 + 3 * 4);
    for (int i = 0; i < 3; i++) assert_true(fabs(once.eye[i] - again.eye[i]) < 1e-12);
    dp_camera_path_destroy(path);
}

/* Angles stay between their keys, and what is the same at two keys stands still between them. */
static void test_no_swing(void **state) {
    const dp_key_view keys[] = {{0, {0, 0, 5}, {0, 0, 0}, {0}, 20, 0},
                                {1, {4, 0, 3}, {1, 2, 0}, {0}, 80, 0},
                                {2, {4, 0, 3}, {0, 0, 0}, {0}, 80, 0},
                                {3, {0, 0, -5}, {0, 0, 0}, {0}, 21, 0}};
    dp_camera_path *const path = make(keys, 4);
    double before = 0;
    (void)state;
    for (double t = 0; t <= 3; t += 1.0 / 64) {
        const dp_key_view v = view_at(path, t);
        assert_true(v.fov_y >= 20 && v.fov_y <= 80);
        if (t <= 1) assert_true(v.fov_y >= before), before = v.fov_y;
        if (t >= 1 && t <= 2) assert_point(v.eye, 4, 0, 3), assert_true(v.fov_y == 80);
        if (t >= 2) assert_point(v.target, 0, 0, 0);
        const double *const u = v.up;
        assert_true(fabs(u[0] * u[0] + u[1] * u[1] + u[2] * u[2] - 1) < 1e-12);
    }
    dp_camera_path_destroy(path);
}

/* ---- cameras ---- */

static void test_camera(void **state) {
    static const float min[3] = {-1, -1, -1}, max[3] = {1, 1, 1};
    const dp_key_view keys[] = {{0, {0, 0, 5}, {0, 0, 0}, {0, 1, 1}, 40, 0},
                                {2, {0, 0, 7}, {0, 0, 0}, {0, 1, 1}, 40, 0}};
    dp_camera_path *const path = make(keys, 2);
    dp_camera camera, wanted = {{0}, {0}};
    dp_diag diag = {0};
    double near_z, far_z;
    (void)state;
    assert_int_equal(dp_camera_path_at(path, 1, 1.5, min, max, &camera, &diag), DP_OK);
    dp_camera_look_at(&wanted, (const double[]){0, 0, 6}, (const double[]){0, 0, 0},
                      (const double[]){0, 1, 0});
    dp_camera_near_far(&wanted, min, max, &near_z, &far_z);
    dp_camera_perspective(&wanted, 40, 1.5, near_z, far_z);
    for (int k = 0; k < 16; k++) {
        assert_true(fabs(camera.view[k] - wanted.view[k]) < 1e-12);
        assert_true(fabs(camera.projection[k] - wanted.projection[k]) < 1e-12);
    }
    assert_int_equal(dp_camera_path_at(path, NAN, 1, min, max, &camera, &diag), DP_ERR_ARGUMENT);
    dp_camera_path_destroy(path);
}

/* A path that goes through its own target is refused there, not before. */
static void test_eye_meets_target(void **state) {
    static const float min[3] = {-1, -1, -1}, max[3] = {1, 1, 1};
    const dp_key_view keys[] = {{0, {0, 0, 1}, {0, 0, 0}, {0}, 0, 2},
                                {2, {0, 0, -1}, {0, 0, 0}, {0}, 0, 4}};
    dp_camera_path *const path = make(keys, 2);
    dp_camera camera;
    dp_diag diag = {0};
    (void)state;
    assert_int_equal(dp_camera_path_at(path, 0.5, 0, min, max, &camera, &diag), DP_OK);
    assert_true(camera.projection[11] == 0); /* orthographic */
    assert_int_equal(dp_camera_path_at(path, 1, 0, min, max, &camera, &diag), DP_ERR_ARGUMENT);
    assert_non_null(strstr(diag.message, "at 1 s the path's eye meets its target"));
    dp_camera_path_destroy(path);
}

static void test_wrong_views(void **state) {
    static const struct {
        dp_key_view second;
        const char *says;
    } cases[] = {{{0, {1, 0, 0}, {0, 0, 0}, {0}, 0, 0}, "is not later"},
                 {{NAN, {1, 0, 0}, {0, 0, 0}, {0}, 0, 0}, "time that is not finite"},
                 {{1, {INFINITY, 0, 0}, {0, 0, 0}, {0}, 0, 0}, "coordinate that is not finite"},
                 {{1, {1, 0, 0}, {1, 0, 0}, {0}, 0, 0}, "its eye where it looks at"},
                 {{1, {1, 0, 0}, {0, 0, 0}, {0}, 180, 0}, "field of view"},
                 {{1, {1, 0, 0}, {0, 0, 0}, {0}, 0, -1}, "height"},
                 {{1, {1, 0, 0}, {0, 0, 0}, {0}, 0, 1}, "another projection"}};
    (void)state;
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        const dp_key_view views[] = {{0, {0, 0, 5}, {0, 0, 0}, {0}, 0, 0}, cases[k].second};
        dp_camera_path *path;
        dp_diag diag = {0};
        assert_int_equal(dp_camera_path_create(views, 2, NULL, NULL, &path, &diag),
                         DP_ERR_ARGUMENT);
        assert_null(path);
        assert_int_equal(diag.item, 1);
        if (!strstr(diag.message, cases[k].says)) fail_msg("%s", diag.message);
    }
}

/* ---- JSON ---- */

static dp_result read_text(const char *text, dp_camera_path **path, dp_diag *diag) {
    static const double up[3] = {0, 0, 3};
    return dp_camera_path_read(text, strlen(text), up, NULL, path, diag);
}

static void test_read(void **state) {
    static const char text[] =
        "{\"views\": [\n"
        " {\"eye\": [3, 2, 4], \"target\": [0, 0, 0]},\n"
        " {\"eye\": [-3, 2.5, 4e0], \"target\": [0, 1, 0], \"fov\": 20},\n"
        " {\"eye\": [3, 2, 5], \"target\": [0, 0, 0], \"up\": [0, 2, 0]}]}\n";
    dp_camera_path *path;
    dp_diag diag = {0};
    (void)state;
    if (read_text(text, &path, &diag)) fail_msg("%s", diag.message);
    assert_true(dp_camera_path_end(path) == 2); /* a second apart */
    assert_false(dp_camera_path_closed(path));
    const dp_key_view first = view_at(path, 0), second = view_at(path, 1), third = view_at(path, 2);
    assert_true(first.fov_y == 35 && second.fov_y == 20);
    assert_point(first.up, 0, 0, 1);
    assert_point(third.up, 0, 1, 0);
    assert_point(second.eye, -3, 2.5, 4);
    dp_camera_path_destroy(path);

    if (read_text("[{\"time\": 2, \"eye\": [1,0,0], \"target\": [0,0,0], \"height\": 3}]", &path,
                  &diag))
        fail_msg("%s", diag.message);
    assert_true(view_at(path, 9).height == 3 && dp_camera_path_begin(path) == 2);
    dp_camera_path_destroy(path);
}

static void test_read_mistakes(void **state) {
#define GOOD "{\"time\": 0, \"eye\": [3, 2, 4], \"target\": [0, 0, 0]},\n"
    static const struct {
        const char *text;
        uint64_t line;
        const char *says;
    } cases[] = {
        {"", 1, ""},
        {"[\n" GOOD "{", 3, ""},
        {"{}", 1, "there are no views"},
        {"{\"views\": 3}", 1, "there are no views"},
        {"3", 1, "there are no views"},
        {"\n{\"views\": []}", 2, "has no view"},
        {"[\n" GOOD "7]", 0, "view 2 of the path is no object"},
        {"[\n" GOOD "{\"eye\": [1, 2, 3]}]", 3, "view 2 of the path needs an \"eye\" and"},
        {"[\n" GOOD "{\"time\": 1,\n\"eye\": [1, 2], \"target\": [0, 0, 0]}]", 4,
         "an eye that is not three numbers"},
        {"[\n" GOOD "{\"time\": 1, \"eye\": [1, 2, 3],\n\"target\": [0, \"0\", 0]}]", 4,
         "a target that is not three numbers"},
        {"[\n" GOOD "{\"time\": \"1\", \"eye\": [1, 2, 3], \"target\": [0, 0, 0]}]", 3,
         "a time that is no number"},
        {"[\n" GOOD "{\"time\": 0, \"eye\": [1, 2, 3], \"target\": [0, 0, 0]}]", 3, "is not later"},
        {"[\n" GOOD "{\"eye\": [1, 2, 3], \"target\": [0, 0, 0]}]", 3, "has no time"},
        {"[{\"eye\": [1, 2, 3], \"target\": [0, 0, 0]},\n"
         "{\"time\": 4, \"eye\": [1, 2, 3], \"target\": [0, 0, 0]}]",
         2, "has a time, and the first has none"},
        {"[\n" GOOD "{\"time\": 1, \"eye\": [1, 2, 3], \"target\": [0, 0, 0],\n\"fow\": 3}]", 4,
         "has a \"fow\"; known are"},
        {"[\n" GOOD "{\"time\": 1, \"eye\": [1, 2, 3], \"target\": [0, 0, 0], \"fov\": 0}]", 3,
         "between 0 and 180"},
        {"[\n" GOOD "{\"time\": 1, \"eye\": [1, 2, 3], \"target\": [0, 0, 0],\n\"height\": 2}]", 3,
         "another projection"},
        {"[{\"eye\": [1, 2, 3], \"target\": [0, 0, 0], \"fov\": 30,\n\"height\": 2}]", 2,
         "a fov and a height"},
        {"[{\"eye\": [1, 2, 3], \"target\": [1, 2, 3]}]", 1, "its eye where it looks at"},
    };
    (void)state;
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        dp_camera_path *path;
        dp_diag diag = {0};
        if (read_text(cases[k].text, &path, &diag) != DP_ERR_FORMAT)
            fail_msg("not refused as it should be: %s: %s", cases[k].text, diag.message);
        assert_null(path);
        if (!strstr(diag.message, cases[k].says) || diag.line != cases[k].line)
            fail_msg("%s: line %d: %s", cases[k].text, (int)diag.line, diag.message);
    }
}

/* ---- memory ---- */

static int blocks_left, blocks_held;

static void *take_block(size_t size, void *user) {
    (void)user;
    if (blocks_left-- <= 0) return NULL;
    blocks_held++;
    return malloc(size);
}
static void *grow_block(void *block, size_t size, void *user) {
    (void)user;
    if (blocks_left-- <= 0) return NULL;
    blocks_held += !block;
    return realloc(block, size);
}
static void free_block(void *block, void *user) {
    (void)user;
    blocks_held -= block != NULL;
    free(block);
}

/* Whichever block is not to be had, the reader says so and keeps none. */
static void test_memory(void **state) {
    static const char text[] = "[{\"eye\": [3, 2, 4], \"target\": [0, 0, 0]}]";
    const dp_allocator few = {take_block, grow_block, free_block, NULL};
    dp_result result = DP_ERR_MEMORY;
    (void)state;
    for (int n = 0; result == DP_ERR_MEMORY; n++) {
        dp_camera_path *path;
        dp_diag diag = {0};
        assert_true(n < 100);
        blocks_left = n;
        result = dp_camera_path_read(text, sizeof text - 1, NULL, &few, &path, &diag);
        assert_true(result ? !path && diag.result == result : n > 0 && path != NULL);
        dp_camera_path_destroy(path);
        assert_int_equal(blocks_held, 0);
    }
    assert_int_equal(result, DP_OK);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_keys_are_met),  cmocka_unit_test(test_parabola),
        cmocka_unit_test(test_smooth),        cmocka_unit_test(test_no_swing),
        cmocka_unit_test(test_camera),        cmocka_unit_test(test_eye_meets_target),
        cmocka_unit_test(test_wrong_views),   cmocka_unit_test(test_read),
        cmocka_unit_test(test_read_mistakes), cmocka_unit_test(test_memory)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
