/* gbuffer: the detectors on 5 x 5 pixels, worked out by hand, and the G-buffer and edge map of
 * whole pictures. */
#include "gbuffer/detect.h"
#include "gbuffer/gbuffer.h"
#include "base/kernels.h"
#include "scene.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* ------- operators, 5 x 5, by hand ------- */

enum { SIDE = 5 };

static const dp_detectors *detectors = &dp_detectors_plain;

static dp_rows rows_at(float (*plane)[SIDE], int x, int y, int r) {
    return (dp_rows){&plane[y - r][x], &plane[y][x], &plane[y + r][x]};
}

static void assert_near(float value, double expected) {
    if (!(fabs((double)value - expected) < 1e-6))
        fail_msg("%.9g is not %.9g", (double)value, expected);
}

static void diagonal_normals_are_the_mean_of_two_cosines(void **state) {
    (void)state;
    float nx[SIDE][SIDE] = {{0}}, ny[SIDE][SIDE] = {{0}}, nz[SIDE][SIDE], i_n[3];
    for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++) nz[y][x] = 1;
    detectors->diagonal_normals(rows_at(nx, 1, 2, 1), rows_at(ny, 1, 2, 1), rows_at(nz, 1, 2, 1), 1,
                                3, i_n);
    for (int i = 0; i < 3; i++) assert_near(i_n[i], 1); /* all agree */
    /* A of (2, 2) is (1, 1): turned by 60 degrees; F is (1, 3): turned right round */
    nx[1][1] = sqrtf(0.75f), nz[1][1] = 0.5f, nz[3][1] = -1;
    detectors->diagonal_normals(rows_at(nx, 2, 2, 1), rows_at(ny, 2, 2, 1), rows_at(nz, 2, 2, 1), 1,
                                1, i_n);
    assert_near(i_n[0], 0.5 * (0.5 - 1));
    /* two px away: A is (0, 0) */
    nz[0][0] = 0, ny[0][0] = 1;
    detectors->diagonal_normals(rows_at(nx, 2, 2, 2), rows_at(ny, 2, 2, 2), rows_at(nz, 2, 2, 2), 2,
                                1, i_n);
    assert_near(i_n[0], 0.5 * (0 + 1));
}

/* I_Z = (1 - |A - H| / 2)^2 (1 - |C - F| / 2)^2 */
static void diagonal_depth_is_the_papers_product(void **state) {
    (void)state;
    float z[SIDE][SIDE] = {{0}}, i_z[1];
    const dp_depth_measure m = {.scale = 0.5f, .both_sides = true};
    detectors->diagonal_depth_printed(rows_at(z, 2, 2, 1), &m, 1, 1, i_z);
    assert_near(i_z[0], 1);
    z[1][1] = 2; /* A: a whole step on one diagonal, 1/4 is left */
    detectors->diagonal_depth_printed(rows_at(z, 2, 2, 1), &m, 1, 1, i_z);
    assert_near(i_z[0], 0.25);
    z[3][1] = 1; /* F: half a step on the other, (3/4)^2 */
    detectors->diagonal_depth_printed(rows_at(z, 2, 2, 1), &m, 1, 1, i_z);
    assert_near(i_z[0], 0.25 * 0.5625);
    z[3][1] = 2; /* two whole steps: 1/16, the least there is */
    detectors->diagonal_depth_printed(rows_at(z, 2, 2, 1), &m, 1, 1, i_z);
    assert_near(i_z[0], 0.0625);
    z[1][1] = 1e9f;
    detectors->diagonal_depth_printed(rows_at(z, 2, 2, 1), &m, 1, 1, i_z);
    assert_near(i_z[0], 0.0625);
}

/* 1/8 (1 2 1, 2 . 2, 1 2 1), in three passes that add up. */
static void c1_adds_eight_differences_in_three_passes(void **state) {
    (void)state;
    float z[SIDE][SIDE] = {{0}}, i_z[1] = {0};
    const dp_depth_measure m = {.scale = 0.5f, .both_sides = true};
    static const float parts[3] = {0.5f, 0.5f,
                                   0.5f}; /* each pass, with all its neighbours a whole step away */
    z[2][2] = 2;
    for (int pass = 0; pass < 3; pass++) {
        const float before = i_z[0];
        detectors->c1_printed(rows_at(z, 2, 2, 1), &m, pass, 1, 1, i_z);
        assert_near(i_z[0] - before, (double)parts[pass]);
    }
    assert_near(i_z[0], 1.5);
    static const double weights[3][3] = {{1, 2, 1}, {2, 0, 2}, {1, 2, 1}}; /* eighths */
    for (int y = 0; y < 3; y++)
        for (int x = 0; x < 3; x++) {
            memset(z, 0, sizeof z);
            if (x != 1 || y != 1) z[1 + y][1 + x] = -0.5f; /* a quarter of a step */
            i_z[0] = 0;
            for (int pass = 0; pass < 3; pass++)
                detectors->c1_printed(rows_at(z, 2, 2, 1), &m, pass, 1, 1, i_z);
            assert_near(i_z[0], weights[y][x] / 8 / 4);
        }
}

static void slopes_are_no_steps(void **state) {
    (void)state;
    float z[SIDE][SIDE], zero[SIDE][SIDE] = {{0}}, i_n[1], i_z[1];
    const dp_depth_measure m = {.scale = 1}; /* orthographic, 1 px per unit */
    for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++)
            z[y][x] = 100 * (float)x - 30 * (float)y; /* as steep as can be seen */
    const dp_rows n = rows_at(zero, 2, 2, 1);
    detectors->diagonal_scaled(n, n, n, rows_at(z, 2, 2, 1), &m, 1, 1, i_n, i_z);
    assert_near(i_z[0], 1);
    /* a step of half a unit back from the middle to its right: the nearer side has it */
    for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++) z[y][x] = x > 2 ? -0.5f : 0;
    detectors->diagonal_scaled(n, n, n, rows_at(z, 2, 2, 1), &m, 1, 1, i_n, i_z);
    assert_near(i_z[0], 0.875 * 0.875 * 0.875 * 0.875); /* 3/2 of a half, less 1/2: a quarter */
    detectors->diagonal_scaled(n, n, n, rows_at(z, 3, 2, 1), &m, 1, 1, i_n,
                               i_z); /* the further one has not */
    assert_near(i_z[0], 1);
    const dp_depth_measure both = {.scale = 1, .both_sides = true};
    detectors->diagonal_scaled(n, n, n, rows_at(z, 3, 2, 1), &both, 1, 1, i_n, i_z);
    assert_near(i_z[0], 0.875 * 0.875 * 0.875 * 0.875); /* 3/2 of a half, less 1/2: a quarter */
    /* a quarter of a step: normals (here 0: at right angles) count three quarters */
    assert_near(i_n[0], 1 - 0.5 * (0.75 + 0.75));
    float slope[1] = {0}, sum[1] = {0};
    for (int pass = 0; pass < 3; pass++)
        detectors->c1_scaled(rows_at(z, 2, 2, 1), slope, &m, pass, 1, 1, sum);
    assert_near(sum[0], 0.5 * 4 / 8);
    slope[0] = 0.25f, sum[0] = 0;
    for (int pass = 0; pass < 3; pass++)
        detectors->c1_scaled(rows_at(z, 2, 2, 1), slope, &m, pass, 1, 1, sum);
    assert_near(sum[0], 0.25 * 4 / 8);
}

/* Every processor's detectors give the bits of the plain ones. */
static void wider_vectors_give_the_same_bits(void **state) {
    (void)state;
    enum { LENGTH = 61, ROW = LENGTH + 8 };
    static float planes[4][9][ROW], slope[LENGTH];
    dp_width list[DP_WIDTHS_MOST];
    uint32_t seed = 7;
    for (int p = 0; p < 4; p++)
        for (int y = 0; y < 9; y++)
            for (int x = 0; x < ROW; x++) {
                seed = seed * 1664525u + 1013904223u;
                planes[p][y][x] =
                    (float)(seed >> 8) / (1 << 24) * (p < 3 ? 2 : 9) - (p < 3 ? 1 : 0);
                if (p == 3 && seed % 13 == 0) planes[p][y][x] = DP_FAR;
            }
    for (uint32_t k = 0, n = dp_widths_list(list); k < n; k++) {
        const dp_detectors *const wide = dp_detectors_for(list[k].lanes), *const base =
                                                                              &dp_detectors_plain;
        for (int r = 1; r <= 4; r++)
            for (int mode = 0; mode < 4; mode++) {
                const dp_depth_measure m = {
                    .scale = 0.7f, .perspective = mode & 1, .both_sides = mode & 2};
                const dp_rays rays = {mode & 1, 20, 30, 40, 50};
                dp_rows rows[4];
                float a[2][LENGTH] = {{0}}, b[2][LENGTH] = {{0}};
                for (int p = 0; p < 4; p++)
                    rows[p] =
                        (dp_rows){&planes[p][4 - r][4], &planes[p][4][4], &planes[p][4 + r][4]};
                base->diagonal_scaled(rows[0], rows[1], rows[2], rows[3], &m, r, LENGTH, a[0],
                                      a[1]);
                wide->diagonal_scaled(rows[0], rows[1], rows[2], rows[3], &m, r, LENGTH, b[0],
                                      b[1]);
                assert_memory_equal(a, b, sizeof a);
                base->diagonal_normals(rows[0], rows[1], rows[2], r, LENGTH, a[0]);
                wide->diagonal_normals(rows[0], rows[1], rows[2], r, LENGTH, b[0]);
                base->diagonal_depth_printed(rows[3], &m, r, LENGTH, a[1]);
                wide->diagonal_depth_printed(rows[3], &m, r, LENGTH, b[1]);
                base->c1_slope(&rays, rows[0].at, rows[1].at, rows[2].at, 3, 5, LENGTH, slope);
                for (int pass = 0; pass < 3; pass++) {
                    base->c1_scaled(rows[3], slope, &m, pass, r, LENGTH, a[0]);
                    wide->c1_scaled(rows[3], slope, &m, pass, r, LENGTH, b[0]);
                    base->c1_printed(rows[3], &m, pass, r, LENGTH, a[1]);
                    wide->c1_printed(rows[3], &m, pass, r, LENGTH, b[1]);
                }
                wide->c1_slope(&rays, rows[0].at, rows[1].at, rows[2].at, 3, 5, LENGTH, b[0]);
                assert_memory_equal(slope, b[0], sizeof slope);
                assert_memory_equal(a[1], b[1], sizeof a[1]);
            }
    }
}

/* ------- whole pictures ------- */

enum { W = SCENE_WIDTH, H = SCENE_HEIGHT };

typedef struct planes {
    uint8_t rgba[H][W][4], map[H][W][4];
    float normal[H][W][3], distance[H][W];
    uint16_t id[H][W];
} planes;

static dp_result draw_planes(uint32_t threads, const dp_batch *batch, const dp_camera *camera,
                             const dp_style *style, planes *out, dp_diag *diag) {
    const dp_context_desc desc = {.threads = threads};
    dp_context *context = NULL;
    dp_source *source = NULL;
    assert_int_equal(dp_context_create(&desc, &context, NULL), DP_OK);
    assert_int_equal(dp_source_from_arrays(batch, NULL, &source, NULL), DP_OK);
    const dp_target target = {.width = W,
                              .height = H,
                              .rgba = out->rgba[0][0],
                              .eye_normal = out->normal[0][0],
                              .distance = out->distance[0],
                              .id = out->id[0],
                              .edge_map = out->map[0][0]};
    memset(out, 0xcd, sizeof *out);
    dp_result result = dp_draw(context, source, camera, style, &target, diag);
    if (!result) { /* again: what stays from frame to frame makes no difference */
        static planes again;
        memcpy(&again, out, sizeof again);
        result = dp_draw(context, source, camera, style, &target, diag);
        assert_memory_equal(&again, out, sizeof again);
    }
    dp_source_destroy(source);
    dp_context_destroy(context);
    return result;
}

static const dp_style with_map = {.lines = DP_NO_LINES,
                                  .edge_map = {.detector = DP_EDGE_MAP_DIAGONAL}};

/* A box before a wall, both face on; (0, 0) is the picture's middle. */
static void make_box(scene *s) {
    const float near[3] = {-30, -20, 10}, far[3] = {30, 20, 40};
    memset(s, 0, sizeof *s);
    scene_box(s, near, far);
}

static void a_box_face_on(void **state) {
    (void)state;
    static scene s;
    static planes p;
    make_box(&s);
    const dp_batch batch = scene_batch(&s);
    const dp_camera camera = scene_flat_camera();
    assert_int_equal(draw_planes(2, &batch, &camera, &with_map, &p, NULL), DP_OK);
    const int left = W / 2 - 30, right = W / 2 + 30, top = H / 2 - 20, bottom = H / 2 + 20;
    const float z = p.distance[H / 2][W / 2];
    for (int y = 0; y < H; y++)
        for (int x = 0; x < W; x++) {
            const bool in = x >= left && x < right && y >= top && y < bottom;
            const bool border = in && (x == left || x == right - 1 || y == top || y == bottom - 1);
            assert_int_equal(p.id[y][x], in);
            assert_true(in ? p.distance[y][x] == z : isinf(p.distance[y][x]));
            assert_true(p.normal[y][x][0] == 0 && p.normal[y][x][1] == 0 &&
                        p.normal[y][x][2] == (in ? 1.0f : 0));
            assert_int_equal(p.map[y][x][0], 255); /* no inner edges */
            assert_int_equal(p.map[y][x][3], border ? 0 : 255);
            assert_int_equal(p.rgba[y][x][0], border ? 0 : 255);
        }
}

/* "the linear distance from the camera position" (Nienhaus and Döllner 2003, 4.1.1) */
static void distance_is_linear_whatever_near_and_far_are(void **state) {
    (void)state;
    static scene s;
    static planes p, q;
    memset(&s, 0, sizeof s);
    const float floor[4][3] = {{-40, -6, 20}, {40, -6, 20}, {40, -6, -70}, {-40, -6, -70}};
    scene_polygon(&s, 4, floor);
    const dp_batch batch = scene_batch(&s);
    const double eye[3] = {0, 0, 30}, at[3] = {0, 0, 0}, up[3] = {0, 1, 0};
    dp_camera near, far;
    assert_int_equal(dp_camera_look_at(&near, eye, at, up), DP_OK);
    far = near;
    assert_int_equal(dp_camera_perspective(&near, 50, (double)W / H, 1, 120), DP_OK);
    assert_int_equal(dp_camera_perspective(&far, 50, (double)W / H, 0.01, 1e5), DP_OK);
    assert_int_equal(draw_planes(1, &batch, &near, &with_map, &p, NULL), DP_OK);
    assert_int_equal(draw_planes(3, &batch, &far, &with_map, &q, NULL), DP_OK);
    const double focal = H / 2 / tan(25 * 3.14159265358979323846 / 180);
    int seen = 0;
    for (int y = 0; y < H; y++) {
        const double exact = 6 * focal / (y + 0.5 - H / 2);
        if (!p.id[y][W / 2] || !p.id[y][W / 2 + 20] || exact > 95) continue;
        seen++;
        assert_true(fabs((double)p.distance[y][W / 2] - exact) < 1e-4 * exact);
        assert_true(fabs((double)q.distance[y][W / 2] - exact) < 1e-4 * exact);
        assert_true(p.map[y][W / 2][3] == 255 || p.map[y][W / 2][3] == q.map[y][W / 2][3]);
        assert_true(fabsf(p.normal[y][W / 2][1] - 1) < 1e-5f);
    }
    assert_true(seen > 30);
}

/* Grazing surfaces and far ones: no edges but the outline. As printed the floor's far end has
 * some. */
static void slopes_make_no_false_edges(void **state) {
    (void)state;
    static scene s;
    static planes p;
    memset(&s, 0, sizeof s);
    const float floor[4][3] = {{-900, -2, 39}, {900, -2, 39}, {900, -2, -900}, {-900, -2, -900}};
    scene_polygon(&s, 4, floor);
    const dp_batch batch = scene_batch(&s);
    const dp_camera camera = scene_camera(0, 0, 40, 0, -0.5, 0);
    for (int detector = DP_EDGE_MAP_DIAGONAL; detector <= DP_EDGE_MAP_C1; detector++) {
        dp_style style = with_map;
        style.edge_map.detector = (dp_edge_detector)detector;
        assert_int_equal(draw_planes(1, &batch, &camera, &style, &p, NULL), DP_OK);
        for (int y = 2; y < H - 2; y++)
            for (int x = 0; x < W; x++)
                if (p.id[y - 2][x] && p.id[y + 2][x] &&
                    (p.map[y][x][0] != 255 || p.map[y][x][3] != 255))
                    fail_msg("detector %d, (%d, %d): %d %d, distance %g", detector, x, y,
                             p.map[y][x][0], p.map[y][x][3], (double)p.distance[y][x]);
        style.edge_map.as_printed = true;
        assert_int_equal(draw_planes(1, &batch, &camera, &style, &p, NULL), DP_OK);
        int false_edges = 0;
        for (int y = 2; y < H - 2; y++)
            for (int x = 0; x < W; x++)
                false_edges += p.id[y - 2][x] && p.id[y + 2][x] && p.map[y][x][3] < 250;
        assert_true(false_edges > 100);
    }
}

static void creases_are_inner_edges(void **state) {
    (void)state;
    static scene s;
    static planes p;
    for (int dihedral = 60; dihedral <= 170; dihedral += 10) {
        memset(&s, 0, sizeof s);
        scene_roof(&s, dihedral, 40);
        const dp_batch batch = scene_batch(&s);
        const dp_camera camera = scene_flat_camera();
        dp_style style = with_map;
        style.shade.normals = DP_NORMALS_FACET;
        assert_int_equal(draw_planes(1, &batch, &camera, &style, &p, NULL), DP_OK);
        int inner = 0;
        for (int x = W / 2 - 2; x < W / 2 + 2; x++) inner += p.map[H / 2][x][0] < 128;
        assert_int_equal(
            inner, dihedral <= 140 ? 2 : 0); /* folds of 40 degrees are past half their strength */
        for (int x = W / 2 + 4; x < W / 2 + 9; x++) assert_int_equal(p.map[H / 2][x][0], 255);
    }
}

static void eight_bits_are_coarse(void **state) {
    (void)state;
    static scene s;
    static planes p;
    memset(&s, 0, sizeof s);
    const float slope[4][3] = {{-90, -50, 0}, {90, -50, 180}, {90, 50, 180}, {-90, 50, 0}};
    scene_polygon(&s, 4, slope);
    const dp_batch batch = scene_batch(&s);
    const dp_camera camera = scene_flat_camera();
    dp_style style = with_map;
    style.edge_map.eight_bits = true;
    assert_int_equal(draw_planes(2, &batch, &camera, &style, &p, NULL), DP_OK);
    int steps = 0;
    for (int x = W / 2 - 80; x < W / 2 + 80; x++)
        steps += p.distance[H / 2][x] != p.distance[H / 2][x + 1];
    assert_true(steps > 100 &&
                steps <= 160); /* 255 steps over 180 px: not every px has a new one … */
    const float step = 180.0f / 255, first = p.distance[H / 2][W / 2];
    for (int x = W / 2 - 80; x < W / 2 + 80;
         x++) { /* … and all lie on the lattice of near and far */
        const float off = (p.distance[H / 2][x] - first) / step;
        assert_true(fabsf(off - roundf(off)) < 1e-3f);
    }
    assert_true(fabsf(p.normal[H / 2][W / 2][0] * 127.5f + 127.5f -
                      roundf(p.normal[H / 2][W / 2][0] * 127.5f + 127.5f)) < 1e-3f);
}

/* Two squares in one plane, of two groups: only their border is an edge; of one that is not
 * enhanced, none. */
static void groups_meet_in_profile_edges(void **state) {
    (void)state;
    static scene s;
    static planes p;
    static const uint16_t groups[2] = {4, 7};
    memset(&s, 0, sizeof s);
    const float left[4][3] = {{-40, -20, 0}, {0, -20, 0}, {0, 20, 0}, {-40, 20, 0}};
    const float right[4][3] = {{0, -20, 0}, {40, -20, 0}, {40, 20, 0}, {0, 20, 0}};
    scene_polygon(&s, 4, left);
    scene_polygon(&s, 4, right);
    dp_batch batch = scene_batch(&s);
    batch.groups = groups;
    const dp_camera camera = scene_flat_camera();
    dp_style style = with_map;
    assert_int_equal(draw_planes(1, &batch, &camera, &style, &p, NULL), DP_OK);
    assert_true(p.id[H / 2][W / 2 - 1] == 5 && p.id[H / 2][W / 2] == 8);
    assert_true(p.map[H / 2][W / 2 - 1][3] == 255 &&
                p.map[H / 2][W / 2][3] == 0); /* the larger number's side */
    style.edge_map.no_groups = true;
    assert_int_equal(draw_planes(1, &batch, &camera, &style, &p, NULL), DP_OK);
    assert_int_equal(p.map[H / 2][W / 2][3], 255);
    static const uint8_t enhanced[5] = {0, 0, 0, 0, 1};
    style.edge_map.enhanced = enhanced, style.edge_map.enhanced_count = 5;
    assert_int_equal(draw_planes(1, &batch, &camera, &style, &p, NULL), DP_OK);
    assert_true(p.map[H / 2][W / 2 - 40][3] == 0 && p.map[H / 2][W / 2 + 39][3] == 255);
}

/* ------- bad input ------- */

static void assert_finite(const planes *p) {
    for (int y = 0; y < H; y++)
        for (int x = 0; x < W; x++) {
            const float *const n = p->normal[y][x];
            const float length2 = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
            assert_true(p->id[y][x] ? fabsf(length2 - 1) < 1e-3f : length2 == 0);
            assert_true(p->id[y][x] ? isfinite(p->distance[y][x]) : p->distance[y][x] == INFINITY);
        }
}

static void bad_normals_make_sound_pictures(void **state) {
    (void)state;
    static scene s;
    static planes p, sound;
    make_box(&s);
    dp_batch batch = scene_batch(&s);
    const dp_camera camera = scene_camera(40, 60, 90, 0, 0, 0);
    static float normals[SCENE_CORNERS][3], turned[SCENE_CORNERS][3];
    for (size_t c = 0; c < s.corners; c++) {
        static const float bad[5][3] = {
            {NAN, 0, 0}, {0, 0, 0}, {INFINITY, 1, 0}, {1e30f, -1e30f, 1e30f}, {1e-30f, 0, 1e-38f}};
        memcpy(normals[c], bad[c % 5], sizeof *normals);
    }
    batch.normals = (dp_attribute){.values = normals[0], .count = s.corners};
    for (int shading = 0; shading < DP_SHADING_COUNT; shading++)
        for (int normal = 0; normal < 3; normal++) {
            dp_style style = with_map;
            style.shade.shading = (dp_shading)shading, style.shade.normals = (dp_normals)normal;
            style.shade.highlight = 0.5f, style.shade.object_space = true;
            assert_int_equal(draw_planes(2, &batch, &camera, &style, &p, NULL), DP_OK);
            assert_finite(&p);
        }
    /* normals that contradict the winding, of any length: as if they did not */
    for (size_t f = 0; f < s.polygons; f++)
        for (uint32_t c = s.firsts[f]; c < s.firsts[f + 1]; c++) {
            const float *const a = s.positions[s.firsts[f]],
                               *const b = s.positions[s.firsts[f] + 1],
                               *const d = s.positions[s.firsts[f] + 2];
            float n[3];
            for (int k = 0; k < 3; k++) {
                const int i = (k + 1) % 3, j = (k + 2) % 3;
                n[k] = (b[i] - a[i]) * (d[j] - a[j]) - (b[j] - a[j]) * (d[i] - a[i]);
                normals[c][k] = n[k], turned[c][k] = -3 * n[k];
            }
        }
    assert_int_equal(draw_planes(2, &batch, &camera, &with_map, &sound, NULL), DP_OK);
    batch.normals.values = turned[0];
    assert_int_equal(draw_planes(2, &batch, &camera, &with_map, &p, NULL), DP_OK);
    for (int y = 0; y < H; y++)
        for (int x = 0; x < W; x++)
            for (int k = 0; k < 3; k++)
                assert_true(fabsf(p.normal[y][x][k] - sound.normal[y][x][k]) < 1e-5f);
    assert_finite(&p);
}

static void clipped_polygons_have_their_normals(void **state) {
    (void)state;
    static scene s;
    static planes p;
    memset(&s, 0, sizeof s);
    const float floor[4][3] = {
        {-1e4f, -6, 1e4f}, {1e4f, -6, 1e4f}, {1e4f, -6, -1e4f}, {-1e4f, -6, -1e4f}};
    scene_polygon(&s, 4, floor);
    dp_batch batch = scene_batch(&s);
    static const float normals[4][3] = {{0, 1, 0}, {0, 1, 0}, {0, 1, 0}, {0, 1, 0}};
    batch.normals = (dp_attribute){.values = normals[0], .count = 4};
    const dp_camera camera = scene_camera(0, 0, 30, 0, -8, 0);
    assert_int_equal(draw_planes(1, &batch, &camera, &with_map, &p, NULL), DP_OK);
    assert_finite(&p);
    int seen = 0;
    for (int y = 0; y < H; y++) {
        if (!p.id[y][10]) continue;
        for (int x = 1; x < W; x++)
            for (int k = 0; k < 3; k++)
                assert_true(fabsf(p.normal[y][x][k] - p.normal[y][0][k]) < 1e-4f);
        seen++;
    }
    assert_true(seen > H / 2);
}

static void absurd_numbers_are_refused(void **state) {
    (void)state;
    static const struct {
        size_t at;
        float value;
    } bad[] = {{offsetof(dp_style, edge_map.inner_angle), -1},
               {offsetof(dp_style, edge_map.inner_angle), NAN},
               {offsetof(dp_style, edge_map.inner_angle), 200},
               {offsetof(dp_style, edge_map.profile_depth), INFINITY},
               {offsetof(dp_style, edge_map.profile_softness), -1},
               {offsetof(dp_style, edge_map.inner_softness), 3},
               {offsetof(dp_style, shade.crease_angle), 181},
               {offsetof(dp_style, shade.highlight), 2},
               {offsetof(dp_style, shade.stroke_scale), -1},
               {offsetof(dp_style, shade.light), NAN},
               {offsetof(dp_style, shade.gooch_alpha), -0.1f}};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        dp_style style = {0}, resolved;
        dp_diag diag = {0};
        memcpy((char *)&style + bad[i].at, &bad[i].value, sizeof(float));
        assert_int_equal(dp_style_resolve(&style, &resolved, &diag), DP_ERR_ARGUMENT);
        assert_true(strlen(diag.message) > 10);
    }
    dp_style style = {.edge_map = {.radius = 5}}, resolved;
    assert_int_equal(dp_style_resolve(&style, &resolved, NULL), DP_ERR_ARGUMENT);
    const dp_style fine = {0};
    assert_int_equal(dp_style_resolve(&fine, &resolved, NULL), DP_OK);
    assert_int_equal(dp_style_resolve(&resolved, &style, NULL),
                     DP_OK); /* stays so when resolved twice */
    assert_true(style.edge_map.inner_angle == resolved.edge_map.inner_angle &&
                style.shade.crease_angle == 40);
}

static void threads_make_no_difference(void **state) {
    (void)state;
    static scene s;
    static planes one, many;
    make_box(&s);
    const float near[3] = {-10, -50, -20}, far[3] = {55, 10, 20};
    scene_box(&s, near, far);
    const dp_batch batch = scene_batch(&s);
    const dp_camera camera = scene_camera(50, 40, 90, 0, 0, 0);
    for (int shading = 0; shading < DP_SHADING_COUNT; shading++) {
        dp_style style = {
            .shade = {.shading = (dp_shading)shading,
                      .highlight = 0.5f,
                      .object_space = shading % 2},
            .edge_map = {.detector = shading % 2 ? DP_EDGE_MAP_C1 : DP_EDGE_MAP_DIAGONAL,
                         .radius = 1 + (uint32_t)shading % 4}};
        assert_int_equal(draw_planes(1, &batch, &camera, &style, &one, NULL), DP_OK);
        assert_int_equal(draw_planes(7, &batch, &camera, &style, &many, NULL), DP_OK);
        assert_memory_equal(&one, &many, sizeof one);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(diagonal_normals_are_the_mean_of_two_cosines),
        cmocka_unit_test(diagonal_depth_is_the_papers_product),
        cmocka_unit_test(c1_adds_eight_differences_in_three_passes),
        cmocka_unit_test(slopes_are_no_steps),
        cmocka_unit_test(wider_vectors_give_the_same_bits),
        cmocka_unit_test(a_box_face_on),
        cmocka_unit_test(distance_is_linear_whatever_near_and_far_are),
        cmocka_unit_test(slopes_make_no_false_edges),
        cmocka_unit_test(creases_are_inner_edges),
        cmocka_unit_test(eight_bits_are_coarse),
        cmocka_unit_test(groups_meet_in_profile_edges),
        cmocka_unit_test(bad_normals_make_sound_pictures),
        cmocka_unit_test(clipped_polygons_have_their_normals),
        cmocka_unit_test(absurd_numbers_are_refused),
        cmocka_unit_test(threads_make_no_difference),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
