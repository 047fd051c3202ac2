/* shade: composition in the paper's order (Nienhaus and Döllner 2003, 5), shared pixels, the
 * mirror, bad input. */
#include "base/vec.h"
#include "base/kernels.h"
#include "scene.h"
#include "shade/shade.h"

#include <drypoint/io.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* ------- pictures ------- */

enum { W = SCENE_WIDTH, H = SCENE_HEIGHT };
typedef uint8_t pixels[H][W][4];

static dp_result draw_batch(const dp_batch *batch, const dp_camera *camera, const dp_style *style,
                            pixels out, uint16_t *ids, dp_diag *diag) {
    dp_context *context = NULL;
    dp_source *source = NULL;
    assert_int_equal(dp_context_create(NULL, &context, NULL), DP_OK);
    assert_int_equal(dp_source_from_arrays(batch, NULL, &source, NULL), DP_OK);
    const dp_target target = {.width = W, .height = H, .rgba = out[0][0], .id = ids};
    const dp_result result = dp_draw(context, source, camera, style, &target, diag);
    dp_source_destroy(source);
    dp_context_destroy(context);
    return result;
}

/* Nienhaus and Döllner 2003, 5: inner edges first, then profile edges over them, each in its own
 * colour. */
static void profile_edges_lie_over_inner_ones(void **state) {
    (void)state;
    static scene s;
    static pixels p;
    memset(&s, 0, sizeof s);
    scene_roof(&s, 80, 30);
    const dp_batch batch = scene_batch(&s);
    const dp_camera camera = scene_flat_camera();
    const dp_style style = {.lines = DP_NO_LINES,
                            .surface = DP_RGB(10, 200, 30),
                            .shade = {.normals = DP_NORMALS_FACET},
                            .edge_map = {.detector = DP_EDGE_MAP_DIAGONAL,
                                         .inner = DP_RGB(255, 0, 0),
                                         .profile = DP_RGB(0, 0, 255)}};
    assert_int_equal(draw_batch(&batch, &camera, &style, p, NULL, NULL), DP_OK);
    if (p[H / 2][W / 2][0] != 255 || p[H / 2][W / 2][2])
        fail_msg("%d %d %d", p[H / 2][W / 2][0], p[H / 2][W / 2][1], p[H / 2][W / 2][2]);
    int top = 0;
    while (p[top][W / 2][2] == 255 && p[top][W / 2][0] == 255) top++; /* paper */
    assert_true(p[top][W / 2][0] == 0 &&
                p[top][W / 2][2] == 255); /* the fold's end: profile over inner */
    assert_true(p[H / 2][W / 2 + 8][1] == 200);
}

/* A pixel that two surfaces share has a colour between theirs, whichever it is mostly of. */
static void shared_pixels_are_mixed(void **state) {
    (void)state;
    static scene s;
    static pixels p;
    memset(&s, 0, sizeof s);
    const float wall[4][3] = {{-90, -50, -20}, {90, -50, -20}, {90, 50, -20}, {-90, 50, -20}};
    const float tilted[4][3] = {
        {-40, -21.3f, 10}, {40.5f, -9, 10}, {40.5f, 21, 10}, {-40, 8.7f, 10}};
    scene_polygon(&s, 4, wall);
    scene_polygon(&s, 4, tilted);
    dp_batch batch = scene_batch(&s);
    static const float normals[8][3] = {{0, 0, 1},    {0, 0, 1},    {0, 0, 1},    {0, 0, 1},
                                        {0, 1, 0.2f}, {0, 1, 0.2f}, {0, 1, 0.2f}, {0, 1, 0.2f}};
    batch.normals = (dp_attribute){.values = normals[0], .count = 8};
    const dp_camera camera = scene_flat_camera();
    const dp_style style = {.lines = DP_NO_LINES,
                            .shade = {.shading = DP_SHADING_LAMBERT, .light = {0, 0, 1}}};
    assert_int_equal(draw_batch(&batch, &camera, &style, p, NULL, NULL), DP_OK);
    const int far = 255, near = p[H / 2][W / 2][0];
    int mixed = 0;
    assert_true(near < 130);
    for (int x = W / 2 - 30; x < W / 2 + 30; x++) {
        int between = 0;
        for (int y = 1; y < H - 1; y++) {
            const int c = p[y][x][0];
            if (p[y][x][0] == 255) continue;
            assert_true(c >= near - 1 && c <= far);
            between += c > near + 4 && c < far - 4;
        }
        mixed += between;
        assert_true(between <= 4);
    }
    assert_true(mixed > 40); /* about three of four columns, at both borders */
}

/* Added polygons ink while tiles are found, before these are shaded: their lines lie over the
 * shades all the same. */
static void quads_lie_over_shades(void **state) {
    (void)state;
    static scene s;
    static pixels flat, shaded;
    memset(&s, 0, sizeof s);
    scene_roof(&s, 80, 30);
    const dp_batch batch = scene_batch(&s);
    const dp_camera camera = scene_flat_camera();
    for (int shading = DP_SHADING_FLAT; shading < DP_SHADING_COUNT; shading++) {
        const dp_style style = {.ink = DP_INK_QUADS,
                                .line[DP_LINE_RIDGE] = {.width = 4, .color = DP_RGB(0, 90, 0)},
                                .shade = {.shading = (dp_shading)shading, .light = {0, 0, 1}}};
        assert_int_equal(draw_batch(&batch, &camera, &style, shading ? shaded : flat, NULL, NULL),
                         DP_OK);
        int inked = 0;
        for (int y = 1; shading && y < H - 1; y++)
            for (int x = 1; x < W - 1; x++) {
                const bool whole = flat[y][x][0] == 0 && flat[y][x][1] == 90;
                if (whole && memcmp(flat[y][x], shaded[y][x], 4) != 0)
                    fail_msg("%s: (%d, %d)", dp_shading_name((dp_shading)shading), x, y);
                inked += whole;
            }
        if (shading) assert_true(inked > 100);
    }
}

/* ------- the mirror ------- */

/* A ball of triangles. */
static void add_ball(scene *s, double x, double y, double z, double radius) {
    enum { U = 18, V = 10 };
    float p[V + 1][U + 1][3];
    for (int v = 0; v <= V; v++)
        for (int u = 0; u <= U; u++) {
            const double a = 2 * 3.14159265358979 * (u % U) / U, b = 3.14159265358979 * v / V;
            p[v][u][0] = (float)(x + radius * sin(b) * cos(a)),
            p[v][u][1] = (float)(y + radius * cos(b));
            p[v][u][2] = (float)(z - radius * sin(b) * sin(a));
        }
    for (int v = 0; v < V; v++)
        for (int u = 0; u < U; u++) {
            float t[3][3];
            memcpy(t[0], p[v][u], sizeof *t), memcpy(t[1], p[v + 1][u], sizeof *t),
                memcpy(t[2], p[v + 1][u + 1], sizeof *t);
            if (v < V - 1) scene_polygon(s, 3, (const float(*)[3])t);
            memcpy(t[1], p[v + 1][u + 1], sizeof *t), memcpy(t[2], p[v][u + 1], sizeof *t);
            if (v) scene_polygon(s, 3, (const float(*)[3])t);
        }
}

/* A small scene before planes through about x = -20. */
static void make_rooms(scene *s) {
    const float box[2][3] = {{-10, -25, -10}, {25, 5, 20}};
    memset(s, 0, sizeof *s);
    scene_box(s, box[0], box[1]);
    const float sheet[4][3] = {{30, -30, 25}, {60, -30, -20}, {60, 20, -20}, {30, 20, 25}};
    scene_polygon(s, 4, sheet);
}

/* The scene's mirror image, of the same coordinates as the library's: rounded once. Fronts stay
 * fronts. */
static void mirror_scene(scene *s, dp_vec3 n, double offset) {
    for (size_t c = 0; c < s->corners; c++) {
        float *const p = s->positions[c];
        const double twice = 2 * (n.x * p[0] + n.y * p[1] + n.z * p[2] - offset),
                     m[3] = {n.x, n.y, n.z};
        for (int k = 0; k < 3; k++) p[k] = (float)(p[k] - twice * m[k]);
    }
    for (size_t f = 0; f < s->polygons; f++)
        for (uint32_t i = s->firsts[f], k = s->firsts[f + 1] - 1; i < k; i++, k--) {
            float swap[3];
            memcpy(swap, s->positions[i], sizeof swap);
            memcpy(s->positions[i], s->positions[k], sizeof swap);
            memcpy(s->positions[k], swap, sizeof swap);
        }
}

/* The light's image, in the camera's axes. */
static void mirror_light(float light[3], const dp_camera *camera, dp_vec3 n) {
    const double *const v = camera->view,
                        l[3] = {(double)light[0], (double)light[1], (double)light[2]};
    dp_vec3 world =
        dp_v3(v[0] * l[0] + v[1] * l[1] + v[2] * l[2], v[4] * l[0] + v[5] * l[1] + v[6] * l[2],
              v[8] * l[0] + v[9] * l[1] + v[10] * l[2]);
    world = dp_mad(world, n, -2 * dp_dot(n, world));
    for (int k = 0; k < 3; k++)
        light[k] = (float)(v[k] * world.x + v[4 + k] * world.y + v[8 + k] * world.z);
}

/* Inside the mirror, where lines of what stands before it do not reach. */
static void compare_image(const pixels seen, const pixels expected, uint16_t ids[H][W],
                          const char *what, int *drawn) {
    int compared = 0;
    for (int y = 3; y < H - 3; y++)
        for (int x = 3; x < W - 3; x++) {
            bool inside = true;
            for (int i = -3; i <= 3; i++)
                for (int k = -3; k <= 3; k++) inside &= ids[y + i][x + k] == 1 + DP_MIRROR_GROUP;
            if (!inside) continue;
            compared++;
            *drawn += expected[y][x][0] != 255;
            for (int k = 0; k < 4; k++)
                if (abs(seen[y][x][k] - expected[y][x][k]) > 1)
                    fail_msg("%s, (%d, %d): %d instead of %d", what, x, y, seen[y][x][k],
                             expected[y][x][k]);
        }
    assert_true(compared > W * H / 20);
}

/* One style, with lines or the edge map, in a mirror and as the rendering of the mirrored scene. */
static void check_mirror(dp_shading shading, bool edges, const float normal[3],
                         const dp_camera *camera, int *drawn) {
    static scene s, image;
    static pixels seen, expected;
    static uint16_t ids[H][W];
    const double offset = -22;
    const dp_style wanted = {
        .surface = DP_RGB(200, 150, 90),
        .lines = edges ? DP_NO_LINES : DP_ALL_LINES,
        .shade = {.shading = shading, .light = {0, 0.6f, 0.8f}, .highlight = 0.4f},
        .edge_map = {.detector = edges ? DP_EDGE_MAP_DIAGONAL : DP_EDGE_MAP_OFF},
        .mirror = {.normal = {normal[0], normal[1], normal[2]},
                   .offset = (float)offset,
                   .center = {0, -5, 0},
                   .size = 300}};
    dp_style style;
    assert_int_equal(dp_style_resolve(&wanted, &style, NULL), DP_OK);
    const double *const along = style.mirror.normal;
    const dp_vec3 n = dp_v3(along[0], along[1], along[2]);
    make_rooms(&s);
    add_ball(&s, 10, 20, -20, 18);
    add_ball(&s, 5, -20, 32, 13);
    image = s;
    mirror_scene(&image, n, offset);
    const dp_batch batch = scene_batch(&s), image_batch = scene_batch(&image);
    assert_int_equal(draw_batch(&batch, camera, &style, seen, ids[0], NULL), DP_OK);
    style.mirror = (dp_mirror){0};
    mirror_light(style.shade.light, camera, n);
    assert_int_equal(draw_batch(&image_batch, camera, &style, expected, NULL, NULL), DP_OK);
    compare_image((const uint8_t(*)[W][4])seen, (const uint8_t(*)[W][4])expected, ids,
                  dp_shading_name(shading), drawn);
}

/* Within a grey level, in every pixel, where shades jump as well. */
static void a_mirror_shows_the_mirrored_scene(void **state) {
    static const float normals[2][3] = {{2, 0, 0}, {1, 0.2f, -0.15f}};
    (void)state;
    for (int shading = 0; shading < DP_SHADING_COUNT; shading++)
        for (int edges = 0; edges < 2; edges++) {
            int drawn = 0;
            if (shading == DP_SHADING_PENCIL)
                continue; /* strokes are not mirrored: they lie on the screen */
            for (int k = 0; k < 8; k++) {
                const dp_camera camera =
                    scene_camera(70 + 6.85 * k, 20 - 5.5 * k, 90 - 11.5 * k, -15, -5, 0);
                check_mirror((dp_shading)shading, edges, normals[k % 2], &camera, &drawn);
            }
            assert_true(drawn > 400);
        }
}

/* What stands behind the mirror is not in it, and what crosses it is cut. */
static void mirrors_cut_what_they_cross(void **state) {
    (void)state;
    static scene s;
    static pixels seen;
    static uint16_t ids[H][W];
    memset(&s, 0, sizeof s);
    const float box[2][3] = {{-10, -10, -30}, {10, 10, 30}},
                behind[2][3] = {{-40, -20, -80}, {40, 20, -60}};
    scene_box(&s, box[0], box[1]);
    scene_box(&s, behind[0], behind[1]);
    const dp_batch batch = scene_batch(&s);
    const dp_camera camera = scene_camera(60, 40, 120, 0, 0, 0);
    const dp_style style = {
        .surface = DP_RGB(90, 90, 90),
        .lines = DP_NO_LINES,
        .mirror = {
            .normal = {0, 0, 1}, .size = 200, .tint = DP_RGB(0, 0, 255), .tint_share = 0.5f}};
    assert_int_equal(draw_batch(&batch, &camera, &style, seen, ids[0], NULL), DP_OK);
    int box_px = 0, image_px = 0, paper_px = 0;
    for (int y = 0; y < H; y++)
        for (int x = 0; x < W; x++) {
            box_px += ids[y][x] == 1;
            image_px += ids[y][x] == 1 + DP_MIRROR_GROUP && seen[y][x][0] < 80;
            paper_px += seen[y][x][0] >= 127 && seen[y][x][0] <= 128 && seen[y][x][2] == 255;
        }
    assert_true(box_px > 300 && image_px > 100 &&
                image_px < box_px); /* the image of 30 units, seen from further away */
    assert_true(paper_px > 1000);   /* half tinted */
}

static void bad_mirrors_are_refused(void **state) {
    (void)state;
    static const dp_mirror bad[] = {{.size = 1},
                                    {.normal = {NAN, 0, 1}, .size = 1},
                                    {.normal = {0, 1, 0}, .size = -1},
                                    {.normal = {0, 1, 0}, .size = 1, .fade = -1},
                                    {.normal = {0, 1, 0}, .size = 1, .offset = INFINITY},
                                    {.normal = {0, 1, 0}, .size = 1, .tint_share = 2}};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        const dp_style style = {.mirror = bad[i]};
        dp_style resolved;
        assert_int_equal(dp_style_resolve(&style, &resolved, NULL), DP_ERR_ARGUMENT);
    }
}

/* Textures of one texel, of odd sizes; strokes on surfaces with and without texture coordinates. */
static void any_texture_will_do(void **state) {
    (void)state;
    static scene s;
    static pixels p;
    make_rooms(&s);
    dp_batch batch = scene_batch(&s);
    static float uv[SCENE_CORNERS][2];
    static uint8_t values[7 * 3] = {255, 0, 128, 3, 77, 200, 1, 90},
                              shades[5][4] = {{0}, {0, 0, 0, 255}, {9, 9, 9, 9}};
    for (size_t c = 0; c < s.corners; c++)
        uv[c][0] = c % 7 ? (float)c * 1e3f : NAN, uv[c][1] = -(float)c;
    const dp_camera camera = scene_camera(70, 20, 90, 0, 0, 0);
    for (int with_uv = 0; with_uv < 2; with_uv++)
        for (uint32_t size = 1; size <= 7; size += 6) {
            if (with_uv) batch.texcoords = (dp_attribute){.values = uv[0], .count = s.corners};
            dp_style style = {.shade = {.shading = DP_SHADING_HATCH,
                                        .object_space = true,
                                        .strokes = {values, size, size == 1 ? 1 : 3}}};
            assert_int_equal(draw_batch(&batch, &camera, &style, p, NULL, NULL), DP_OK);
            style = (dp_style){
                .shade = {.shading = DP_SHADING_TOON, .shades = {shades[0], size == 1 ? 1 : 5, 1}}};
            assert_int_equal(draw_batch(&batch, &camera, &style, p, NULL, NULL), DP_OK);
        }
    static pixels plain_picture;
    dp_width list[DP_WIDTHS_MOST];
    for (uint32_t k = 0, kinds = dp_widths_list(list); k < kinds;
         k++) { /* with texture coordinates, by any kernels */
        const dp_style style = {.shade = {.shading = DP_SHADING_HATCH, .object_space = true}};
        assert_int_equal(setenv("DRYPOINT_CPU", list[k].name, 1), 0);
        assert_int_equal(draw_batch(&batch, &camera, &style, k ? p : plain_picture, NULL, NULL),
                         DP_OK);
        if (k) assert_memory_equal(p, plain_picture, sizeof p);
    }
    unsetenv("DRYPOINT_CPU");
    const dp_style empty = {.shade = {.shading = DP_SHADING_HATCH, .strokes = {values, 0, 3}}};
    assert_int_equal(draw_batch(&batch, &camera, &empty, p, NULL, NULL), DP_ERR_ARGUMENT);
}

/* ------- memory ------- */

static int allocations_left;
static void *failing_realloc(void *block, size_t size, void *user) {
    (void)user;
    return allocations_left-- > 0 ? realloc(block, size) : NULL;
}
static void *failing_alloc(size_t size, void *user) { return failing_realloc(NULL, size, user); }
static void failing_free(void *block, void *user) {
    (void)user;
    free(block);
}

/* Whichever allocation fails, the call says so, nothing is lost, and the context can be used
 * again. */
static void every_allocation_may_fail(void **state) {
    (void)state;
    static scene s;
    static pixels p, whole;
    make_rooms(&s);
    const dp_batch batch = scene_batch(&s);
    const dp_camera camera = scene_camera(70, 20, 90, -15, -5, 0);
    const dp_allocator memory = {failing_alloc, failing_realloc, failing_free, NULL};
    const dp_context_desc desc = {.allocator = &memory, .threads = 1};
    const int few_steps = DP_TEST_PATIENCE > 1 ? 5 : 1; /* the first ones differ most */
    for (int shading = DP_SHADING_TOON; shading <= DP_SHADING_HATCH; shading++) {
        const dp_style style = {
            .shade = {.shading = (dp_shading)shading, .object_space = true},
            .edge_map = {.detector = DP_EDGE_MAP_C1, .eight_bits = true},
            .mirror = {.normal = {1, 0, 0}, .offset = -20, .size = 300, .fade = 200}};
        const dp_target target = {.width = W, .height = H, .rgba = p[0][0]};
        int refused = 0;
        assert_int_equal(draw_batch(&batch, &camera, &style, whole, NULL, NULL), DP_OK);
        for (int left = 0; left < 400; left += left < 30 ? 1 : few_steps) {
            dp_context *context = NULL;
            dp_source *source = NULL;
            allocations_left = 1000000;
            assert_int_equal(dp_context_create(&desc, &context, NULL), DP_OK);
            assert_int_equal(dp_source_from_arrays(&batch, NULL, &source, NULL), DP_OK);
            allocations_left = left;
            const dp_result result = dp_draw(context, source, &camera, &style, &target, NULL);
            if (result) {
                refused++;
                assert_int_equal(result, DP_ERR_MEMORY);
                allocations_left = 1000000;
                assert_int_equal(dp_draw(context, source, &camera, &style, &target, NULL), DP_OK);
            }
            assert_memory_equal(p, whole, sizeof p);
            dp_source_destroy(source);
            dp_context_destroy(context);
            if (!result) break;
        }
        assert_true(refused > 20 && refused < 399);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(profile_edges_lie_over_inner_ones),
        cmocka_unit_test(shared_pixels_are_mixed),
        cmocka_unit_test(quads_lie_over_shades),
        cmocka_unit_test(a_mirror_shows_the_mirrored_scene),
        cmocka_unit_test(mirrors_cut_what_they_cross),
        cmocka_unit_test(bad_mirrors_are_refused),
        cmocka_unit_test(any_texture_will_do),
        cmocka_unit_test(every_allocation_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
