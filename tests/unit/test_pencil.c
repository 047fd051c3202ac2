/* Pencil rendering: Hermosilla and Vázquez 2010, 2.4. */
#include <drypoint/drypoint.h>

#include "base/kernels.h"
#include "shade/pencil.h"
#include "shade/pencil_rows.h"
#include "texture/graphite.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 320, HEIGHT = 240, SIZE = DP_GRAPHITE_SIZE };
static uint8_t pictures[2][HEIGHT][WIDTH][4];

static dp_result draw_with(const dp_context_desc *desc, const char *shape, const dp_style *style,
                           double up, uint8_t *rgba) {
    dp_context *context = NULL;
    dp_source *source = NULL;
    dp_camera camera;
    dp_result result = dp_context_create(desc, &context, NULL);
    if (result) return result;
    assert_int_equal(
        dp_source_from_shape(&(dp_shape){.name = shape, .triangles = 3000}, &source, NULL), DP_OK);
    dp_camera_fit(&camera,
                  &(dp_fit){.min = {-1, -1, -1}, .max = {1, 1, 1}, .direction = {0, up, 1}});
    const dp_target target = {.width = WIDTH, .height = HEIGHT, .rgba = rgba};
    result = dp_draw(context, source, &camera, style, &target, NULL);
    dp_source_destroy(source);
    dp_context_destroy(context);
    return result;
}

static void draw(const char *shape, const dp_shade *shade, uint32_t threads, uint8_t *rgba) {
    const dp_style style = {.lines = DP_NO_LINES, .shade = *shade};
    assert_int_equal(draw_with(&(dp_context_desc){.threads = threads}, shape, &style, 0.05, rgba),
                     DP_OK);
}

/* Mean darkness of the model's pixels, and mean differences to the right and down. */
typedef struct looks {
    double dark, across, down;
} looks;

static looks look_at(const uint8_t p[HEIGHT][WIDTH][4], uint32_t x0, uint32_t y0, uint32_t x1,
                     uint32_t y1) {
    looks l = {0, 0, 0};
    const double n = (double)(x1 - x0) * (y1 - y0);
    for (uint32_t y = y0; y < y1; y++)
        for (uint32_t x = x0; x < x1; x++) {
            l.dark += (255 - p[y][x][0]) / n;
            l.across += abs(p[y][x][0] - p[y][x + 1][0]) / n;
            l.down += abs(p[y][x][0] - p[y + 1][x][0]) / n;
        }
    return l;
}

static void test_the_texture_repeats_and_has_no_sign(void **state) {
    (void)state;
    static uint8_t values[2 * SIZE * SIZE];
    static float scratch[SIZE * SIZE];
    dp_make_graphite(values, 1, scratch);
    double sum = 0;
    for (int y = 0; y < SIZE; y++)
        for (int x = 0; x < SIZE; x++) {
            assert_int_equal(values[y * SIZE + x], values[(SIZE - 1 - y) * SIZE + SIZE - 1 - x]);
            sum += values[y * SIZE + x];
        }
    sum /= SIZE * SIZE;
    assert_true(sum > 90 && sum < 200);
    dp_make_graphite(values, 2, scratch); /* from empty paper to dark */
    for (int i = 0; i < SIZE * SIZE; i++)
        assert_true(values[i] == 255 && values[SIZE * SIZE + i] <= 255);
}

static void test_strokes_run_along_a_cylinder(void **state) {
    (void)state;
    const dp_shade shade = {.shading = DP_SHADING_PENCIL};
    draw("cylinder", &shade, 2, pictures[0][0][0]);
    const looks l = look_at((const uint8_t(*)[WIDTH][4])pictures[0], 120, 90, 200, 150);
    assert_true(l.dark > 10);
    assert_true(l.across >
                1.4 * l.down); /* strokes upright; the paper's tooth is the same both ways */
}

/* Brightness to the power of 0 is 1: white paper. */
static void test_s_and_o_are_the_paper_s(void **state) {
    (void)state;
    dp_shade shade = {.shading = DP_SHADING_PENCIL, .pencil_s = -1, .pencil_o = -1};
    draw("sphere", &shade, 1, pictures[0][0][0]);
    assert_true(look_at((const uint8_t(*)[WIDTH][4])pictures[0], 120, 80, 200, 160).dark < 0.01);
    double last = 0;
    for (int s = 1; s <= 4; s++) {
        shade.pencil_s = (float)s;
        draw("sphere", &shade, 1, pictures[0][0][0]);
        const double dark =
            look_at((const uint8_t(*)[WIDTH][4])pictures[0], 120, 80, 200, 160).dark;
        assert_true(dark > last + 2);
        last = dark;
    }
    /* with S = 0 light does not matter */
    shade = (dp_shade){
        .shading = DP_SHADING_PENCIL, .pencil_s = -1, .pencil_o = 1, .light = {-1, 0, 0}};
    draw("sphere", &shade, 1, pictures[0][0][0]);
    shade.light[0] = 1;
    draw("sphere", &shade, 1, pictures[1][0][0]);
    assert_memory_equal(pictures[0], pictures[1], sizeof pictures[0]);
}

static void test_pictures_do_not_depend_on_threads(void **state) {
    (void)state;
    for (int k = 0; k < 3; k++) {
        const dp_shade shade = {
            .shading = DP_SHADING_PENCIL, .pencil_tones = k == 1 ? 6 : 0, .pencil_printed = k == 2};
        draw("torus", &shade, 1, pictures[0][0][0]);
        draw("torus", &shade, 7, pictures[1][0][0]);
        assert_memory_equal(pictures[0], pictures[1], sizeof pictures[0]);
    }
}

/* Fine and coarse meshes, every way to look textures up: on any processor the same bits. */
static void test_every_kernel_draws_the_same(void **state) {
    static const uint8_t odd[3 * 5] = {0, 255, 0, 255, 0, 255, 0, 255, 0, 255, 0, 255, 0, 255, 0};
    const dp_shade ways[] = {{0},
                             {.pencil_printed = true},
                             {.pencil_tones = 6},
                             {.strokes = {odd, 3, 5}, .stroke_scale = 0.05f}};
    const char *const shapes[] = {"torus", "gear"};
    dp_width list[DP_WIDTHS_MOST];
    const uint32_t count = dp_widths_list(list);
    (void)state;
    for (size_t k = 0; k < 2 * sizeof ways / sizeof *ways; k++) {
        dp_shade shade = ways[k / 2];
        shade.shading = DP_SHADING_PENCIL;
        for (uint32_t i = 0; i < count; i++) {
            assert_int_equal(setenv("DRYPOINT_CPU", list[i].name, 1), 0);
            draw(shapes[k % 2], &shade, 1, pictures[i > 0][0][0]);
            if (i > 0) assert_memory_equal(pictures[0], pictures[1], sizeof pictures[0]);
        }
    }
    unsetenv("DRYPOINT_CPU");
}

/* Directions and turns of 10 degrees: what lies near the middle between two steps is in part
 * both. */
static void test_turns(void **state) {
    static const float right[3] = {1, 0, 0}, up[3] = {0, 1, 0};
    dp_width list[DP_WIDTHS_MOST];
    const uint32_t count = dp_widths_list(list);
    float along[64][3];
    dp_turn turns[64];
    (void)state;
    for (int i = 0; i < 64; i++) {
        const double angle = (i - 20) * 3.14159265358979 /
                             36; /* each 5 degrees, beyond half a turn on either side */
        along[i][0] = (float)cos(angle), along[i][1] = (float)sin(angle), along[i][2] = 7;
    }
    along[63][0] = along[63][1] = 0; /* towards the eye: none is as good as any */
    for (uint32_t k = 0; k < count; k++) {
        dp_pencil_rows_for(list[k].lanes)->turn((const float(*)[3])along, right, up, 64, turns);
        for (int i = 0; i < 63; i++) {
            const int step = (i - 20 + 72) % 36 / 2, part = turns[i] & 0xff;
            if (i % 2 == 0)
                assert_int_equal(turns[i], step << 8);
            else
                assert_true(turns[i] >> 8 == step && part > 126 && part < 129);
        }
        assert_int_equal(turns[63], 0);
        dp_pencil_rows_for(list[k].lanes)
            ->turn_exactly((const float(*)[3])along, right, up, 64, turns);
        for (int i = 0; i < 63; i++) {
            const int wanted = (i - 20 + 72) % 36 * 65536 / 36;
            assert_true((uint16_t)(turns[i] - wanted + 2) <= 4);
        }
    }
}

static void test_any_texture_will_do(void **state) {
    (void)state;
    static const uint8_t one = 128,
                         odd[3 * 5] = {0, 255, 0, 255, 0, 255, 0, 255, 0, 255, 0, 255, 0, 255, 0};
    const dp_image images[] = {{&one, 1, 1}, {odd, 3, 5}, {odd, 15, 1}};
    for (size_t i = 0; i < 3; i++) {
        const dp_shade shade = {
            .shading = DP_SHADING_PENCIL, .strokes = images[i], .pencil_s = -1, .pencil_o = 1};
        draw("gear", &shade, 2, pictures[0][0][0]); /* polygons of many corners, too */
    }
    const dp_shade shade = {
        .shading = DP_SHADING_PENCIL, .strokes = images[0], .pencil_s = -1, .pencil_o = 1};
    draw("sphere", &shade, 2, pictures[0][0][0]);
    const double dark = look_at((const uint8_t(*)[WIDTH][4])pictures[0], 120, 80, 200, 160).dark;
    assert_true(dark > 115 && dark < 139); /* half, but for the tooth */
}

static void test_wrong_values_are_refused(void **state) {
    (void)state;
    const dp_shade bad[] = {
        {.pencil_tones = 1}, {.pencil_tones = 9}, {.pencil_s = 101}, {.pencil_o = NAN}};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        dp_style out;
        dp_diag diag;
        assert_int_equal(dp_style_resolve(&(dp_style){.shade = bad[i]}, &out, &diag),
                         DP_ERR_ARGUMENT);
        assert_true(strlen(diag.message) > 10);
    }
}

typedef struct ration {
    int left;
} ration;

static void *give(size_t size, void *user) {
    ration *const r = user;
    return r->left-- > 0 ? malloc(size) : NULL;
}
static void *give_again(void *block, size_t size, void *user) {
    ration *const r = user;
    return r->left-- > 0 ? realloc(block, size) : NULL;
}
static void take(void *block, void *user) {
    (void)user;
    free(block);
}

static void test_memory_may_run_out(void **state) {
    (void)state;
    const dp_style style = {.lines = DP_NO_LINES,
                            .shade = {.shading = DP_SHADING_PENCIL, .pencil_tones = 2}};
    dp_result result = DP_ERR_MEMORY;
    for (int n = 0; result; n += n < 100 ? 1 : 1 + n / 16) {
        ration r = {n};
        const dp_allocator allocator = {give, give_again, take, &r};
        result = draw_with(&(dp_context_desc){.allocator = &allocator, .threads = 1}, "cube",
                           &style, 0.5, pictures[0][0][0]);
        assert_true((result == DP_OK || result == DP_ERR_MEMORY) && n < 1000000);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_texture_repeats_and_has_no_sign),
        cmocka_unit_test(test_strokes_run_along_a_cylinder),
        cmocka_unit_test(test_s_and_o_are_the_paper_s),
        cmocka_unit_test(test_pictures_do_not_depend_on_threads),
        cmocka_unit_test(test_every_kernel_draws_the_same),
        cmocka_unit_test(test_turns),
        cmocka_unit_test(test_any_texture_will_do),
        cmocka_unit_test(test_wrong_values_are_refused),
        cmocka_unit_test(test_memory_may_run_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
