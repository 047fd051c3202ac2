/* camera: OpenGL's conventions, fitting, and bad arguments. */
#include <drypoint/camera.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

/* Clip coordinates of a world point. */
static void project(const dp_camera *camera, const double p[3], double clip[4]) {
    double v[4];
    for (int r = 0; r < 4; r++)
        v[r] = camera->view[r] * p[0] + camera->view[4 + r] * p[1] + camera->view[8 + r] * p[2] +
               camera->view[12 + r];
    for (int r = 0; r < 4; r++)
        clip[r] = camera->projection[r] * v[0] + camera->projection[4 + r] * v[1] +
                  camera->projection[8 + r] * v[2] + camera->projection[12 + r] * v[3];
}

static void assert_near(double a, double b) {
    if (!(fabs(a - b) <= 1e-9 * (1 + fabs(b)))) fail_msg("%.17g is not %.17g", a, b);
}

static void look_at_puts_target_on_the_axis(void **state) {
    (void)state;
    dp_camera camera;
    const double eye[3] = {3, 4, 5}, target[3] = {-1, 2, 0}, up[3] = {0, 1, 0};
    assert_int_equal(dp_camera_look_at(&camera, eye, target, up), DP_OK);
    assert_int_equal(dp_camera_orthographic(&camera, 2, 1, 0, 100), DP_OK);
    double clip[4];
    project(&camera, target, clip);
    assert_near(clip[0], 0);
    assert_near(clip[1], 0);
    const double above[3] = {target[0], target[1] + 0.5, target[2]};
    project(&camera, above, clip);
    assert_true(fabs(clip[0]) < 1e-12 && clip[1] > 0);
}

static void looking_along_up_still_works(void **state) {
    (void)state;
    const double eye[3] = {0, 5, 0}, target[3] = {0, 0, 0}, up[3] = {0, 1, 0};
    for (int sign = -1; sign <= 1; sign += 2) {
        dp_camera camera;
        const double from[3] = {0, sign * eye[1], 0};
        assert_int_equal(dp_camera_look_at(&camera, from, target, up), DP_OK);
        for (int i = 0; i < 16; i++) assert_true(isfinite(camera.view[i]));
    }
}

static void perspective_maps_near_and_far_to_minus_and_plus_one(void **state) {
    (void)state;
    dp_camera camera;
    const double eye[3] = {0, 0, 0}, target[3] = {0, 0, -1}, up[3] = {0, 1, 0};
    assert_int_equal(dp_camera_look_at(&camera, eye, target, up), DP_OK);
    assert_int_equal(dp_camera_perspective(&camera, 90, 2, 1, 10), DP_OK);
    double clip[4];
    project(&camera, (const double[3]){2, 1, -1}, clip); /* the near plane's upper right corner */
    for (int k = 0; k < 2; k++) assert_near(clip[k] / clip[3], 1);
    assert_near(clip[2] / clip[3], -1);
    project(&camera, (const double[3]){0, 0, -10}, clip);
    assert_near(clip[2] / clip[3], 1);
    assert_near(clip[3], 10); /* w is the distance along the line of sight */
}

static void wrong_cameras_are_refused(void **state) {
    (void)state;
    dp_camera camera;
    const double eye[3] = {1, 2, 3}, up[3] = {0, 1, 0};
    assert_int_equal(dp_camera_look_at(&camera, eye, eye, up), DP_ERR_ARGUMENT);
    const double lost[3] = {NAN, 0, 0};
    assert_int_equal(dp_camera_look_at(&camera, eye, lost, up), DP_ERR_ARGUMENT);
    static const double bad[][4] = {{0, 1, 1, 2},         {180, 1, 1, 2}, {40, 0, 1, 2},
                                    {40, 1, 0, 2},        {40, 1, -1, 2}, {40, 1, 2, 2},
                                    {40, 1, 1, INFINITY}, {NAN, 1, 1, 2}, {40, NAN, 1, 2}};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        assert_int_equal(dp_camera_perspective(&camera, bad[i][0], bad[i][1], bad[i][2], bad[i][3]),
                         DP_ERR_ARGUMENT);
    assert_int_equal(dp_camera_orthographic(&camera, 0, 1, 0, 1), DP_ERR_ARGUMENT);
    assert_int_equal(dp_camera_orthographic(&camera, 1, 1, 1, 1), DP_ERR_ARGUMENT);
    for (int k = 0; k < 3; k++) {
        dp_fit fit = {.min = {0, 0, 0}, .max = {1, 1, 1}};
        assert_int_equal(dp_camera_fit(&camera, &fit), DP_OK);
        fit.min[k] = 2;
        assert_int_equal(dp_camera_fit(&camera, &fit), DP_ERR_ARGUMENT);
    }
}

static void a_fitted_box_is_seen_whole(void **state) {
    (void)state;
    static const double directions[][3] = {
        {0, 0, 0}, {0, 0, 1}, {0, 1, 0}, {0, -1, 0}, {-3, 0.1, 2}};
    static const double aspects[] = {0, 0.3, 1, 3};
    for (int orthographic = 0; orthographic < 2; orthographic++)
        for (size_t d = 0; d < sizeof directions / sizeof *directions; d++)
            for (size_t a = 0; a < sizeof aspects / sizeof *aspects; a++) {
                dp_fit fit = {.min = {-1, 2, 100},
                              .max = {3, 2.5f, 107},
                              .aspect = aspects[a],
                              .orthographic = orthographic};
                memcpy(fit.direction, directions[d], sizeof fit.direction);
                dp_camera camera;
                assert_int_equal(dp_camera_fit(&camera, &fit), DP_OK);
                for (int i = 0; i < 8; i++) {
                    const double corner[3] = {i & 1 ? fit.max[0] : fit.min[0],
                                              i & 2 ? fit.max[1] : fit.min[1],
                                              i & 4 ? fit.max[2] : fit.min[2]};
                    double clip[4];
                    project(&camera, corner, clip);
                    for (int k = 0; k < 3; k++) assert_true(fabs(clip[k]) <= clip[3]);
                }
            }
}

static void fitting_a_point_is_no_error(void **state) {
    (void)state;
    const dp_fit fit = {.min = {1, 1, 1}, .max = {1, 1, 1}};
    dp_camera camera;
    assert_int_equal(dp_camera_fit(&camera, &fit), DP_OK);
    for (int i = 0; i < 16; i++)
        assert_true(isfinite(camera.view[i]) && isfinite(camera.projection[i]));
}

static void near_and_far_enclose_the_box(void **state) {
    (void)state;
    dp_camera camera;
    const double up[3] = {0, 1, 0}, target[3] = {0, 0, 0};
    const float min[3] = {-1, -1, -1}, max[3] = {1, 1, 1};
    double near_z, far_z;
    assert_int_equal(dp_camera_look_at(&camera, (const double[3]){0, 0, 5}, target, up), DP_OK);
    dp_camera_near_far(&camera, min, max, &near_z, &far_z);
    assert_true(near_z > 3 && near_z <= 4 && far_z >= 6 && far_z < 8);
    assert_int_equal(dp_camera_look_at(&camera, (const double[3]){0, 0, 0.5}, target, up), DP_OK);
    dp_camera_near_far(&camera, min, max, &near_z, &far_z); /* the eye is inside */
    assert_true(near_z > 0 && near_z >= 0.99e-4 * far_z && near_z < 0.1 && far_z >= 1.5);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(look_at_puts_target_on_the_axis),
        cmocka_unit_test(looking_along_up_still_works),
        cmocka_unit_test(perspective_maps_near_and_far_to_minus_and_plus_one),
        cmocka_unit_test(wrong_cameras_are_refused),
        cmocka_unit_test(a_fitted_box_is_seen_whole),
        cmocka_unit_test(fitting_a_point_is_no_error),
        cmocka_unit_test(near_and_far_enclose_the_box),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
