/* Lines of x-rays between the surfaces, looks layer by layer, the same for all threads and vectors; errors. */
#include "base/kernels.h"
#include "raster/kernels.h"
#include "raster/tile.h"
#include "raster/xray.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "xray_scene.h"

/* ------- lines ------- */

static void ink_lies_between_surfaces(void **state) {
    const dp_camera flat = scene_flat_camera();
    const dp_color ink = DP_RGB(10, 60, 220);
    (void)state;
    for (int plates = 0; plates <= DP_LEVELS; plates++) {
        dp_style style = {.xray = 0.3f, .surface = surface, .paper = paper};
        style.line[DP_LINE_RIDGE] = (dp_line_style){7, ink};
        make_plates(plates);
        draw_on(&first, &flat, &style, 4);
        for (int k = 0; k < 3; k++) {
            double expected = ink >> (24 - 8 * k) & 0xff;
            for (int i = 0; i < plates; i++)
                expected = over(surface >> (24 - 8 * k) & 0xff, expected, 0.3);
            assert_true(fabs(expected - pixel_of(&first, W / 2, H / 2)[k]) <= 1);
        }
    }
}

/* What vectors are drawn in: the ink as the surfaces before it leave it. */
static void segments_fade_by_level(void **state) {
    const dp_camera flat = scene_flat_camera();
    (void)state;
    make_plates(5);
    const dp_style style = {.xray = 0.3f, .surface = surface};
    draw_on(&first, &flat, &style, 4);
    size_t count, ridges = 0;
    const dp_segment *const s = dp_segments(context, &count);
    for (size_t i = 0; i < count; i++) {
        for (int k = 0; k < 3; k++) {
            const double of = surface >> (24 - 8 * k) & 0xff, left = pow(0.7, s[i].level);
            const double expected = s[i].level ? of * (1 - left) : 0;
            assert_true(fabs(expected - (s[i].color >> (24 - 8 * k) & 0xff)) <= 1);
        }
        ridges += s[i].line == DP_LINE_RIDGE && s[i].level == 5;
    }
    assert_int_equal(ridges, 1);
}

static void visible_lines_stay(void **state) {
    const dp_camera near = scene_camera(120, 90, 160, 0, 0, 0);
    size_t count, opaque = 0, xray = 0;
    (void)state;
    for (int i = 0; i < 2; i++) {
        const dp_style style = {.xray = i ? 0.4f : 0};
        make_boxes();
        draw_on(&first, &near, &style, 4);
        const dp_segment *const s = dp_segments(context, &count);
        for (size_t k = 0; k < count; k++) *(i ? &xray : &opaque) += !s[k].level;
    }
    assert_int_equal(opaque, xray);
    assert_true(count > opaque);
}

/* Lines fade by the opacities before them; none are drawn behind what is opaque. */
static void lines_fade_by_the_groups_before_them(void **state) {
    const dp_camera flat = scene_flat_camera();
    const dp_style style = {.paper = paper};
    (void)state;
    for (int opaque = 0; opaque < 2; opaque++) {
        make_plates(3);
        one_look(0.3f, surface);
        opacities[2] = 0.5f, opacities[3] = opaque ? 1 : 0.1f, opacities[4] = 0.7f;
        dp_enable(context, DP_ALL_LINES);
        dp_line_width(context, DP_RIDGE, 7);
        draw_groups(&first, &flat, &style, 4);
        size_t count, ridges = 0;
        const dp_segment *const s = dp_segments(context, &count);
        for (size_t i = 0; i < count; i++)
            ridges += s[i].line == DP_LINE_RIDGE && s[i].level == 3 &&
                      fabs((s[i].color >> 24) - 200 * (1 - 0.5 * 0.9 * 0.3)) <= 1;
        assert_int_equal(ridges, !opaque);
        double expected = opaque ? 200 : 0;
        if (!opaque) expected = over(200, over(200, over(200, 0, 0.5), 0.1), 0.7);
        assert_true(fabs(expected - pixel_of(&first, W / 2, H / 2)[0]) <= 1);
    }
}

/* ------- looks ------- */

/* Two plates, so that each look's layer is what its plate looks like alone. */
static void every_look_is_drawn_layer_by_layer(void **state) {
    static canvas alone[2];
    const dp_camera flat = scene_flat_camera();
    const double opacity = 0.45;
    (void)state;
    for (int shading = 0; shading < DP_SHADING_COUNT; shading++) {
        dp_style style = {.lines = DP_NO_LINES, .surface = surface, .paper = paper};
        style.shade.shading = (dp_shading)shading;
        if (shading == DP_SHADING_GOOCH) style.edge_map.detector = DP_EDGE_MAP_DIAGONAL;
        for (int i = 0; i < 3; i++) {
            made.corners = made.polygons = 0;
            if (i != 1) scene_wall(&made, -60, 20, 30, 60, 50); /* slanted: layers differ */
            if (i != 0) scene_wall(&made, -30, 0, 80, -40, 40);
            style.xray = i == 2 ? (float)opacity : 0;
            draw_on(i == 2 ? &first : &alone[i], &flat, &style, 4);
        }
        for (int y = 0; y < H; y++)
            for (int x = 0; x < W; x++) {
                /* not at the plates' edges, where pixels are mixed */
                const int wx = x - W / 2, wy = abs(H / 2 - y);
                const bool a = wx > -58 && wx < 28 && wy<48, b = wx> - 28 && wx < 78 && wy < 38;
                if ((!a && wx > -62 && wx < 32 && wy < 52) ||
                    (!b && wx > -32 && wx < 82 && wy < 42))
                    continue;
                for (int k = 0; k < 3; k++) {
                    double expected = paper >> (24 - 8 * k) & 0xff;
                    if (b) expected = over(pixel_of(&alone[1], x, y)[k], expected, opacity);
                    if (a) expected = over(pixel_of(&alone[0], x, y)[k], expected, opacity);
                    if (fabs(expected - pixel_of(&first, x, y)[k]) > 1)
                        fail_msg("look %d, pixel %d %d: %d, not %.2f", shading, x, y,
                                 pixel_of(&first, x, y)[k], expected);
                }
            }
    }
}

/* Edges of a layer's edge map are ink on it: the layers above fade them, its own opacity does not. */
static void edge_maps_are_ink_on_their_layers(void **state) {
    static canvas alone;
    const dp_camera flat = scene_flat_camera();
    dp_style style = {.lines = DP_NO_LINES, .surface = surface, .paper = paper};
    size_t hidden = 0, shown_edges = 0;
    (void)state;
    style.edge_map.detector = DP_EDGE_MAP_DIAGONAL;
    style.edge_map.profile = DP_RGB(255, 0, 255);
    made.corners = made.polygons = 0;
    scene_wall(&made, -20, 0, 50, 0, 20);
    draw_on(&alone, &flat, &style, 4);
    scene_wall(&made, -60, 20, 30, 20, 50);
    style.xray = 0.45f;
    draw_on(&first, &flat, &style, 4);
    for (int y = 0; y < H; y++)
        for (int x = 0; x < W; x++) {
            const uint8_t *const p = pixel_of(&alone, x, y), *const q = pixel_of(&first, x, y);
            if (p[0] != 255 || p[1] || p[2] != 255) continue;
            if (x > W / 2 + 32) {
                assert_memory_equal(p, q, 4);
                shown_edges++;
            } else if (x < W / 2 + 28) {
                assert_true(fabs(over(200, 255, 0.45) - q[0]) <= 1);
                assert_true(fabs(over(120, 0, 0.45) - q[1]) <= 1);
                hidden++;
            }
        }
    assert_true(hidden > 50 && shown_edges > 30);
}

/* ------- the kernel ------- */

/* How many samples each pixel has, and where the next layer begins. */
static void layers_are_counted(void **state) {
    enum { MOST = DP_TILE * DP_TILE * 16, PIXELS = DP_TILE * DP_TILE };
    static float depth[MOST], bound[2][MOST];
    static uint8_t covered[2][PIXELS];
    static dp_tile tile;
    static dp_frame frame;
    static const uint32_t samples[] = {1, 4, 8, 16};
    dp_width list[DP_WIDTHS_MOST];
    const uint32_t count = dp_widths_list(list);
    uint32_t seed = 5;
    (void)state;
    frame.step_scale = 0.01f, frame.step_offset = 0.5f;
    tile.frame = &frame, tile.depth = depth;
    for (size_t i = 0; i < MOST; i++)
        depth[i] =
            random_number(&seed) < 0.4 ? DP_DEPTH_EMPTY : (float)(200 * random_number(&seed) - 100);
    for (int s = 0; s < 4; s++) {
        frame.tile_samples = (size_t)PIXELS * samples[s], tile.sampling.samples = samples[s];
        const float truth = dp_raster_kernels_plain.layer(&tile, covered[0], bound[0]);
        for (size_t i = 0; i < frame.tile_samples; i++)
            assert_true(bound[0][i] == (depth[i] > DP_DEPTH_EMPTY ? dp_layer_bound(&frame, depth[i])
                                                                  : DP_DEPTH_EMPTY) &&
                        bound[0][i] <= truth);
        for (size_t i = 0; i < PIXELS; i++) {
            uint32_t sum = 0;
            for (uint32_t k = 0; k < samples[s]; k++)
                sum += depth[i * samples[s] + k] > DP_DEPTH_EMPTY;
            assert_int_equal(covered[0][i], sum);
        }
        for (uint32_t k = 0; k < count; k++) {
            const dp_raster_kernels *const kernels = dp_raster_kernels_for(list[k].lanes);
            assert_true(kernels->layer(&tile, covered[1], bound[1]) == truth);
            assert_memory_equal(covered[0], covered[1], sizeof *covered);
            assert_memory_equal(bound[0], bound[1], frame.tile_samples * sizeof **bound);
            assert_true(kernels->layer(&tile, NULL, bound[1]) == truth);
            assert_true(kernels->layer(&tile, covered[1], NULL) == DP_DEPTH_EMPTY);
        }
    }
}

/* ------- memory ------- */

/* Counts calls that get memory; the one number `fail_at` gets none. */
typedef struct meter {
    long calls, fail_at;
} meter;

static bool fails(meter *m) { return ++m->calls == m->fail_at; }
static void *meter_alloc(size_t size, void *user) { return fails(user) ? NULL : malloc(size); }
static void *meter_realloc(void *old, size_t size, void *user) {
    return fails(user) ? NULL : realloc(old, size);
}
static void meter_free(void *block, void *user) {
    (void)user;
    free(block);
}

static dp_result draw_metered(dp_context *own, const dp_style *style) {
    const dp_camera camera = scene_camera(60, 50, 400, 0, 0, 0);
    dp_diag diag = {0};
    make_plates(3);
    return scene_draw(own, &made, &camera, style, &shown, &diag);
}

static void every_allocation_may_fail(void **state) {
    const dp_style styles[] = {
        {.xray = 0.4f},
        {.xray = 0.4f, .xray_layers = 2, .shade.shading = DP_SHADING_TOON, .stroke.taper = 3},
        {.xray = 0.4f, .edge_map.detector = DP_EDGE_MAP_DIAGONAL}};
    (void)state;
    for (size_t i = 0; i < sizeof styles / sizeof *styles; i++) {
        dp_result result = DP_ERR_MEMORY;
        for (long at = 1; result; at++) {
            meter m = {.fail_at = at};
            const dp_allocator allocator = {meter_alloc, meter_realloc, meter_free, &m};
            const dp_context_desc desc = {.allocator = &allocator, .threads = 1};
            dp_context *own = NULL;
            result = dp_context_create(&desc, &own, NULL);
            if (!result) result = draw_metered(own, &styles[i]);
            assert_true(!result || result == DP_ERR_MEMORY);
            dp_context_destroy(own);
        }
    }
}

/* ------- the same for all; errors ------- */

static void threads_and_vectors_make_no_difference(void **state) {
    static uint8_t pictures[2][4 * W * H];
    const dp_shape shape = {.name = "gear", .triangles = 6000};
    dp_width list[DP_WIDTHS_MOST];
    const uint32_t count = dp_widths_list(list);
    dp_extent extent;
    dp_camera camera;
    dp_source *source;
    dp_fit fit = {.aspect = (double)W / H};
    (void)state;
    assert_int_equal(dp_source_from_shape(&shape, &source, NULL), DP_OK);
    assert_int_equal(dp_source_extent(source, &extent, NULL), DP_OK);
    memcpy(fit.min, extent.min, sizeof fit.min);
    memcpy(fit.max, extent.max, sizeof fit.max);
    assert_int_equal(dp_camera_fit(&camera, &fit), DP_OK);
    for (int look = 0; look < 2; look++)
        for (uint32_t i = 0; i < count + 2; i++) {
            const dp_style style = {.xray = 0.3f, .shade.shading = look ? DP_SHADING_TOON : 0};
            const dp_context_desc desc = {.threads = i < count ? 2 : i == count ? 1 : 7};
            const dp_target target = {.width = W, .height = H, .rgba = pictures[i > 0]};
            dp_context *own;
            assert_int_equal(setenv("DRYPOINT_CPU", list[i < count ? i : 0].name, 1), 0);
            assert_int_equal(dp_context_create(&desc, &own, NULL), DP_OK);
            assert_int_equal(dp_draw(own, source, &camera, &style, &target, NULL), DP_OK);
            dp_context_destroy(own);
            if (i) assert_memory_equal(pictures[0], pictures[1], sizeof *pictures);
        }
    unsetenv("DRYPOINT_CPU");
    dp_source_destroy(source);
}

static void what_cannot_be_is_refused(void **state) {
    const dp_camera flat = scene_flat_camera();
    const dp_style wrong[] = {{.xray = -0.1f},
                              {.xray = 1.5f},
                              {.xray = NAN},
                              {.xray = 0.5f, .xray_layers = DP_LEVELS + 1},
                              {.xray = 0.5f, .ink = DP_INK_QUADS},
                              {.xray = 0.5f, .edges = DP_EDGES_ADJACENCY}};
    (void)state;
    make_boxes();
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
        assert_int_equal(try_draw(&flat, &wrong[i]), DP_ERR_ARGUMENT);
}

/* Only lines are asked for: there is no target to peel for. */
static void lines_need_no_pixels(void **state) {
    const dp_camera near = scene_camera(120, 90, 160, 0, 0, 0);
    const dp_style style = {.xray = 0.4f};
    const dp_target target = {.width = W, .height = H};
    size_t with, without;
    (void)state;
    make_boxes();
    draw_on(&first, &near, &style, 4);
    (void)dp_segments(context, &with);
    const dp_batch batch = scene_batch(&made);
    dp_source *source;
    assert_int_equal(dp_source_from_arrays(&batch, NULL, &source, NULL), DP_OK);
    assert_int_equal(dp_draw(context, source, &near, &style, &target, NULL), DP_OK);
    (void)dp_segments(context, &without);
    assert_int_equal(with, without);
    dp_source_destroy(source);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(ink_lies_between_surfaces),
                                       cmocka_unit_test(segments_fade_by_level),
                                       cmocka_unit_test(visible_lines_stay),
                                       cmocka_unit_test(lines_fade_by_the_groups_before_them),
                                       cmocka_unit_test(every_look_is_drawn_layer_by_layer),
                                       cmocka_unit_test(edge_maps_are_ink_on_their_layers),
                                       cmocka_unit_test(layers_are_counted),
                                       cmocka_unit_test(every_allocation_may_fail),
                                       cmocka_unit_test(threads_and_vectors_make_no_difference),
                                       cmocka_unit_test(what_cannot_be_is_refused),
                                       cmocka_unit_test(lines_need_no_pixels)};
    return cmocka_run_group_tests(tests, make_context, destroy_context);
}
