/* A torus. */
#include "gl/figure.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

static const double PI = 3.14159265358979323846;

void figure_make(figure *out, float x) {
    for (uint32_t i = 0; i < FIGURE_ROUND; i++)
        for (uint32_t j = 0; j < FIGURE_TUBE; j++) {
            const double u = 2 * PI * i / FIGURE_ROUND, v = 2 * PI * j / FIGURE_TUBE,
                         r = 1 + 0.4 * cos(v);
            const uint32_t n = i * FIGURE_TUBE + j, i1 = (i + 1) % FIGURE_ROUND,
                           j1 = (j + 1) % FIGURE_TUBE, a = n, b = i1 * FIGURE_TUBE + j,
                           c = i1 * FIGURE_TUBE + j1, d = i * FIGURE_TUBE + j1;
            const float p[3] = {(float)(r * cos(u)) + x, (float)(r * sin(u)),
                                (float)(0.4 * sin(v))};
            const uint32_t t[6] = {a, b, c, a, c, d};
            memcpy(out->positions[n], p, sizeof p);
            memcpy(out->indices[2 * n], t, sizeof t);
        }
}

void figure_turn_matrix(double m[16], double degrees, double x) {
    const double c = cos(degrees * PI / 180), s = sin(degrees * PI / 180);
    const double turned[16] = {1, 0, 0, 0, 0, c, s, 0, 0, -s, c, 0, x, 0.125, 0, 1};
    memcpy(m, turned, sizeof turned);
}

void figure_place(figure *f, const double m[16]) {
    for (uint32_t i = 0; i < FIGURE_VERTICES; i++) {
        float *const p = f->positions[i];
        const double q[3] = {(double)p[0], (double)p[1], (double)p[2]};
        for (int r = 0; r < 3; r++)
            p[r] = (float)(m[r] * q[0] + m[4 + r] * q[1] + m[8 + r] * q[2] + m[12 + r]);
    }
}

dp_source *figure_source(const figure *f) {
    const dp_batch batch = {.positions = f->positions[0],
                            .vertex_count = FIGURE_VERTICES,
                            .indices = f->indices[0],
                            .corner_count = (size_t)3 * FIGURE_TRIANGLES,
                            .polygon_count = FIGURE_TRIANGLES};
    dp_source *source = NULL;
    assert_int_equal(dp_source_from_arrays(&batch, NULL, &source, NULL), DP_OK);
    return source;
}

dp_camera figure_camera(bool orthographic, double far_z) {
    static const double eye[3] = {1.5, 2, 4}, at[3] = {0, 0, 0}, up[3] = {0, 1, 0};
    dp_camera camera;
    assert_int_equal(dp_camera_look_at(&camera, eye, at, up), DP_OK);
    const dp_result result = orthographic ? dp_camera_orthographic(&camera, 3.4, 4.0 / 3, 1, far_z)
                                          : dp_camera_perspective(&camera, 40, 4.0 / 3, 1, far_z);
    assert_int_equal(result, DP_OK);
    return camera;
}
