/* What tests of kernels share: numbers, a view, a clock. Include after the headers of cmocka. */
#ifndef TESTS_UNIT_KERNEL_TESTS_H
#define TESTS_UNIT_KERNEL_TESTS_H

#include "core/view.h"

#include <time.h>

static inline uint32_t next_random(uint32_t *state) {
    *state = *state * 1664525u + 1013904223u;
    return *state >> 8;
}

static inline dp_view make_view(bool orthographic) {
    const double eye[3] = {0.3, 0.7, 4}, target[3] = {-0.5, 0, 0}, up[3] = {0, 1, 0};
    dp_camera camera;
    dp_view view;
    assert_int_equal(dp_camera_look_at(&camera, eye, target, up), DP_OK);
    if (orthographic)
        assert_int_equal(dp_camera_orthographic(&camera, 3, 1.5, 0.1, 10), DP_OK);
    else
        assert_int_equal(dp_camera_perspective(&camera, 40, 1.5, 0.1, 10), DP_OK);
    assert_int_equal(dp_view_init(&view, &camera, 1200, 800, NULL), DP_OK);
    return view;
}

static inline double now_ns(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec * 1e9 + (double)t.tv_nsec;
}

#endif
