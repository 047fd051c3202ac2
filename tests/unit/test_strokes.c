/* Chains, stroke textures and stylized strokes. */
#include "temporary.h"

#include <drypoint/drypoint.h>
#include <drypoint/io.h>

#include "strokes/chain.h"
#include "texture/texture.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

/* ------- chains ------- */

static dp_stroke stroke(float ax, float ay, float bx, float by) {
    return (dp_stroke){
        .a = {ax, ay, 1}, .b = {bx, by, 1}, .half_width = 1, .color = DP_RGB(0, 0, 0)};
}

static dp_chain_store chains;

static void chain(const dp_stroke *strokes, uint32_t count, float sharpest, float gap) {
    const dp_allocator memory = {.alloc = NULL};
    (void)memory;
    const dp_chain_rule rule = {.sharpest = sharpest, .gap = gap, .step = 0.1f};
    static dp_allocator plain;
    plain = dp_allocator_resolve(NULL);
    assert_true(dp_make_chains(strokes, count, &rule, &plain, &chains));
}

static void free_chains(void) {
    const dp_allocator plain = dp_allocator_resolve(NULL);
    dp_chain_store_free(&chains, &plain);
}

static void test_segments_are_chained_whatever_way_they_run(void **state) {
    (void)state;
    const dp_stroke s[] = {stroke(1, 0, 2, 0), stroke(1, 0, 0, 0), stroke(3, 0, 2, 0),
                           stroke(9, 9, 8, 8)};
    chain(s, 4, -2, 0);
    assert_int_equal(chains.chain_count, 2);
    assert_int_equal(chains.chains[0].count, 3);
    const dp_link expected[] = {{1, true}, {0, false}, {2, true}};
    for (int i = 0; i < 3; i++) {
        assert_int_equal(chains.links[i].segment, expected[i].segment);
        assert_int_equal(chains.links[i].reversed, expected[i].reversed);
    }
    free_chains();
}

static void test_rings_are_closed(void **state) {
    (void)state;
    const dp_stroke s[] = {stroke(0, 0, 1, 0), stroke(1, 1, 1, 0), stroke(1, 1, 0, 1),
                           stroke(0, 1, 0, 0)};
    chain(s, 4, -2, 0);
    assert_int_equal(chains.chain_count, 1);
    assert_true(chains.chains[0].closed && chains.chains[0].count == 4);
    chain(s, 4, 0.5f, 0); /* every corner is too sharp */
    assert_int_equal(chains.chain_count, 4);
    free_chains();
}

static void test_at_a_crossing_the_straightest_go_on(void **state) {
    (void)state;
    const dp_stroke s[] = {stroke(-1, 0, 0, 0), stroke(0, -1, 0, 0), stroke(0, 0, 1, 0),
                           stroke(0, 0, 0, 1)};
    chain(s, 4, -2, 0);
    assert_int_equal(chains.chain_count, 2);
    assert_int_equal(chains.links[0].segment, 0);
    assert_int_equal(chains.links[1].segment, 2);
    free_chains();
}

static void test_small_gaps_are_bridged(void **state) {
    (void)state;
    const dp_stroke s[] = {stroke(0, 0, 10, 0), stroke(12, 0, 20, 0), stroke(26, 0, 30, 0)};
    chain(s, 3, -2, 3);
    assert_int_equal(chains.chain_count, 2);
    assert_int_equal(chains.chains[0].count, 2);
    const dp_stroke alone[] = {stroke(0, 0, 1, 0)};
    chain(alone, 1, -2, 3); /* never to itself */
    assert_int_equal(chains.chain_count, 1);
    assert_false(chains.chains[0].closed);
    chain(alone, 0, -2, 3);
    assert_int_equal(chains.chain_count, 0);
    free_chains();
}

/* ------- textures ------- */

static dp_texture *texture_of(const uint8_t *pixels, uint32_t width, uint32_t height,
                              uint32_t channels) {
    const dp_texture_desc desc = {
        .pixels = pixels, .width = width, .height = height, .channels = channels};
    dp_texture *t = NULL;
    assert_int_equal(dp_texture_create(&desc, &t, NULL), DP_OK);
    return t;
}

static void test_any_number_of_channels_is_ink(void **state) {
    (void)state;
    static const uint8_t grey[2] = {0, 200}, grey_alpha[4] = {0, 77, 255, 255},
                         rgb[3] = {255, 55, 55}, rgba[8] = {9, 9, 9, 0, 0, 0, 255, 128};
    dp_texture *t = texture_of(grey, 2, 1, 1);
    const uint8_t *p = dp_texture_pixels(t, NULL, NULL);
    assert_true(p[3] == 255 && p[7] == 55 && !t->coloured);
    dp_texture_destroy(t);
    t = texture_of(grey_alpha, 2, 1, 2);
    assert_true(dp_texture_pixels(t, NULL, NULL)[3] == 77 && !t->coloured);
    dp_texture_destroy(t);
    t = texture_of(rgb, 1, 1, 3); /* 200 of pure red laid on white looks so */
    p = dp_texture_pixels(t, NULL, NULL);
    assert_true(p[0] == 255 && p[1] == 0 && p[3] == 200 && t->coloured);
    dp_texture_destroy(t);
    t = texture_of(rgba, 2, 1, 4);
    assert_true(dp_texture_pixels(t, NULL, NULL)[7] == 128 && t->coloured);
    dp_texture_destroy(t);
    dp_texture_destroy(NULL);
}

static void test_looking_up_repeats_along_and_holds_across(void **state) {
    (void)state;
    static const uint8_t ramp[4] = {255, 155, 55, 155};
    dp_texture *const t = texture_of(ramp, 2, 2, 1);
    const dp_texel a = dp_texture_sample(t, 0, 0.25f, 0.25f),
                   b = dp_texture_sample(t, 0, 5.25f, -3),
                   c = dp_texture_sample(t, 0, -0.75f, 0.75f);
    assert_true(a.ink == 0 && b.ink == 0 && c.ink > 0.78f);
    const dp_texel seam = dp_texture_sample(t, 0, 1, 0.25f);
    assert_true(seam.ink > 0.19f && seam.ink < 0.2f);
    dp_texture_destroy(t);
}

static void test_odd_sizes_have_pyramids(void **state) {
    (void)state;
    static uint8_t pixels[301 * 37];
    static const uint32_t sizes[][2] = {{1, 1}, {1, 37}, {301, 1}, {301, 37}, {2, 3}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        dp_texture *const t = texture_of(pixels, sizes[i][0], sizes[i][1], 1);
        assert_int_equal(t->height[t->levels - 1], 1);
        for (uint32_t level = 0; level < t->levels; level++)
            assert_true(dp_texture_sample(t, level, 0.3f, 0.9f).ink > 0.999f);
        dp_texture_destroy(t);
    }
}

static void test_textures_are_refused_with_a_reason(void **state) {
    (void)state;
    static const uint8_t pixels[4];
    dp_texture *t;
    dp_diag diag;
    const dp_texture_desc bad[] = {
        {.pixels = NULL, .width = 1, .height = 1, .channels = 1},
        {.pixels = pixels, .width = 0, .height = 1, .channels = 1},
        {.pixels = pixels, .width = 9000, .height = 1, .channels = 1},
        {.pixels = pixels, .width = 1, .height = 1, .channels = 5},
        {.pixels = pixels, .width = 4, .height = 1, .channels = 1, .stride = 3}};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        assert_int_equal(dp_texture_create(&bad[i], &t, &diag), DP_ERR_ARGUMENT);
        assert_true(strlen(diag.message) > 10);
    }
    assert_int_equal(dp_texture_named("pencl", 0, NULL, &t, &diag), DP_ERR_ARGUMENT);
    assert_non_null(strstr(diag.message, "pencil"));
}

static void test_every_named_texture_has_ink_and_none_is_solid(void **state) {
    (void)state;
    for (uint32_t i = 0; i < dp_texture_count(); i++) {
        dp_texture *t = NULL, *again = NULL;
        uint32_t w, h;
        double sum = 0;
        assert_int_equal(dp_texture_named(dp_texture_name(i), 5, NULL, &t, NULL), DP_OK);
        assert_int_equal(dp_texture_named(dp_texture_name(i), 5, NULL, &again, NULL), DP_OK);
        const uint8_t *const p = dp_texture_pixels(t, &w, &h);
        assert_memory_equal(p, dp_texture_pixels(again, NULL, NULL), (size_t)4 * w * h);
        for (size_t k = 0; k < (size_t)w * h; k++) sum += p[4 * k + 3];
        sum /= 255.0 * w * h;
        if (!(sum > 0.15 && sum < 0.95)) fail_msg("%s: %g of it is ink", dp_texture_name(i), sum);
        assert_non_null(dp_texture_about(i));
        dp_texture_destroy(t);
        dp_texture_destroy(again);
    }
}

static void test_png_files_become_textures(void **state) {
    (void)state;
    char path[300];
    static const uint8_t rgba[2][2][4] = {{{0, 0, 0, 255}, {255, 255, 255, 255}},
                                          {{128, 128, 128, 255}, {0, 0, 0, 255}}};
    dp_texture *t = NULL;
    dp_diag diag;
    temporary_name(path, sizeof path, "texture");
    const int file = mkstemp(path);
    assert_true(file >= 0 && write(file, "no picture", 10) == 10);
    close(file);
    assert_int_equal(dp_io_read_texture(path, NULL, &t, &diag), DP_ERR_FORMAT);
    assert_int_equal(dp_io_write_png(path, rgba[0][0], 2, 2, 0, NULL), DP_OK);
    assert_int_equal(dp_io_read_texture(path, NULL, &t, &diag), DP_OK);
    const uint8_t *const p = dp_texture_pixels(t, NULL, NULL);
    assert_true(p[3] == 255 && p[7] == 0 && p[11] == 127 && p[15] == 255);
    dp_texture_destroy(t);
    unlink(path);
    assert_int_equal(dp_io_read_texture(path, NULL, &t, &diag), DP_ERR_IO);
}

/* ------- pictures ------- */

enum { WIDTH = 320, HEIGHT = 240 };
static uint8_t pictures[2][HEIGHT][WIDTH][4];

static uint64_t triangles;

static dp_result draw_with(const dp_context_desc *desc, const char *shape, const dp_style *style,
                           uint8_t *rgba) {
    dp_context *context = NULL;
    dp_source *source = NULL;
    dp_camera camera;
    dp_result result = dp_context_create(desc, &context, NULL);
    assert_int_equal(
        dp_source_from_shape(&(dp_shape){.name = shape, .triangles = triangles}, &source, NULL),
        DP_OK);
    dp_camera_fit(&camera, &(dp_fit){.min = {-1, -1, -1}, .max = {1, 1, 1}});
    const dp_target target = {.width = WIDTH, .height = HEIGHT, .rgba = rgba};
    if (!result)
        result = dp_draw(context, source, &camera, style, &target, NULL);
    else
        context = NULL;
    dp_source_destroy(source);
    dp_context_destroy(context);
    return result;
}

static void draw(const char *shape, const dp_style *style, uint32_t threads, uint8_t *rgba) {
    assert_int_equal(draw_with(&(dp_context_desc){.threads = threads}, shape, style, rgba), DP_OK);
}

/* A texture whose colour encodes u: red falls and rises again by one from texel to texel. */
static dp_texture *ruler(void) {
    static uint8_t pixels[8][256][4];
    for (int y = 0; y < 8; y++)
        for (int x = 0; x < 256; x++)
            pixels[y][x][0] = (uint8_t)abs(x - 128), pixels[y][x][3] = 254;
    return texture_of(pixels[0][0], 256, 8, 4);
}

/* Two px of a stroke 16 px wide are one texel, a little less on the inner side of its curve. */
static void test_u_goes_on_along_a_stroke_in_arc_mode(void **state) {
    (void)state;
    dp_texture *const t = ruler();
    uint32_t compared = 0;
    const dp_style style = {
        .lines = DP_SILHOUETTE, .line = {{.width = 16}}, .stroke = {.texture = t}};
    triangles = 20000;
    draw("sphere", &style, 2, pictures[0][0][0]);
    triangles = 0;
    for (int y = 0; y + 1 < HEIGHT; y++)
        for (int x = 0; x + 1 < WIDTH; x++)
            for (int k = 0; k < 2; k++) {
                const uint8_t *const p = pictures[0][y][x], *const q =
                                                                pictures[0][y + k][x + 1 - k];
                if (p[1] > 1 || q[1] > 1) continue; /* not full ink, of which green would be 1 */
                if (abs(p[0] - q[0]) > 1) fail_msg("(%d, %d): from %d to %d", x, y, p[0], q[0]);
                compared++;
            }
    assert_true(compared > 8000);
    dp_texture_destroy(t);
}

static void test_the_same_seed_draws_the_same_picture(void **state) {
    (void)state;
    dp_texture *texture = NULL;
    assert_int_equal(dp_texture_named("pencil", 0, NULL, &texture, NULL), DP_OK);
    for (int edges = 0; edges < 2; edges++) {
        dp_style style = {.edges = (dp_edges)edges,
                          .line = {{.width = 6}},
                          .stroke = {.texture = texture,
                                     .taper = 20,
                                     .jitter = 1.5f,
                                     .overshoot = 6,
                                     .depth = 0.5f,
                                     .light = 0.7f,
                                     .repeats = 3,
                                     .seed = 11}};
        draw("gear", &style, 1, pictures[0][0][0]);
        draw("gear", &style, 7, pictures[1][0][0]);
        assert_memory_equal(pictures[0], pictures[1], sizeof pictures[0]);
        style.stroke.seed = 12;
        draw("gear", &style, 2, pictures[1][0][0]);
        assert_true(memcmp(pictures[0], pictures[1], sizeof pictures[0]) != 0);
    }
    dp_texture_destroy(texture);
}

static int pixels_of(const uint8_t p[HEIGHT][WIDTH][4], int channel) {
    int count = 0;
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++)
            count += p[y][x][channel] > 200 && p[y][x][(channel + 1) % 3] < 80 &&
                     p[y][x][(channel + 2) % 3] < 80;
    return count;
}

/* Outlines may be extruded, as printed or not: what has no outside is drawn as the same textured
 * strokes. */
static void test_creases_are_drawn_beside_extruded_outlines(void **state) {
    (void)state;
    dp_texture *texture = NULL;
    assert_int_equal(dp_texture_named("dashes", 0, NULL, &texture, NULL), DP_OK);
    const dp_style ways[] = {{.ink = DP_INK_STROKES},
                             {.ink = DP_INK_QUADS},
                             {.ink = DP_INK_QUADS, .method = DP_METHOD_PAPER},
                             {.ink = DP_INK_QUADS, .method = DP_METHOD_PAPER, .passes = 2}};
    int found[4][3];
    for (int i = 0; i < 4; i++)
        for (int textured = 0; textured < 2; textured++) {
            dp_style style = ways[i];
            style.edges = DP_EDGES_ADJACENCY;
            style.line[DP_LINE_SILHOUETTE] = (dp_line_style){3, DP_RGB(0, 0, 255)};
            style.line[DP_LINE_RIDGE] = (dp_line_style){3, DP_RGB(255, 0, 0)};
            style.line[DP_LINE_VALLEY] = (dp_line_style){3, DP_RGB(0, 255, 0)};
            style.stroke = (dp_stroke_style){.texture = textured ? texture : NULL};
            draw("gear", &style, 2, pictures[0][0][0]);
            int now[3];
            for (int k = 0; k < 3; k++)
                now[k] = pixels_of((const uint8_t(*)[WIDTH][4])pictures[0], k);
            if (!textured) memcpy(found[i], now, sizeof now);
            for (int k = 0; textured && k < 2; k++) /* dashes leave something out */
                assert_true(now[k] < 0.85 * found[i][k] && now[k] > 0.3 * found[i][k]);
        }
    assert_true(found[0][0] > 300 && found[0][1] > 50);
    for (int i = 1; i < 4; i++)
        for (int k = 0; k < 2; k++) /* outlines lie over fewer of them, or more */
            assert_true(found[i][k] > 0.8 * found[0][k] && found[i][k] < 1.6 * found[0][k] &&
                        found[i][2] > 300);
    dp_texture_destroy(texture);
}

/* Textures with gaps are not chained for the picture, but when segments are asked for after it. */
static void test_dashed_lines_are_chained_after_the_picture(void **state) {
    (void)state;
    dp_texture *texture = NULL;
    dp_context *context = NULL;
    dp_source *source = NULL;
    dp_camera camera;
    assert_int_equal(dp_texture_named("dashes", 0, NULL, &texture, NULL), DP_OK);
    assert_int_equal(dp_context_create(NULL, &context, NULL), DP_OK);
    assert_int_equal(dp_source_from_shape(&(dp_shape){.name = "gear"}, &source, NULL), DP_OK);
    dp_camera_fit(&camera, &(dp_fit){.min = {-1, -1, -1}, .max = {1, 1, 1}});
    const dp_target target = {.width = WIDTH, .height = HEIGHT};
    for (int k = 0; k < 2; k++) {
        size_t count = 0;
        const dp_style style = {.edges = k ? DP_EDGES_ADJACENCY : DP_EDGES_EMERGENT,
                                .stroke = {.texture = texture}};
        assert_int_equal(dp_draw(context, source, &camera, &style, &target, NULL), DP_OK);
        assert_non_null(dp_segments(context, &count));
        assert_true(count > 100);
    }
    dp_source_destroy(source);
    dp_context_destroy(context);
    dp_texture_destroy(texture);
}

/* Between two dashes or dots there is nothing: a pixel belongs to its nearest mark also where that
 * has no ink. Texels right of the middle are ink, the others none: along any line ink comes and
 * goes once a repeat. */
static void test_gaps_of_a_texture_stay_open(void **state) {
    (void)state;
    static uint8_t pixels[8][64][4];
    for (int y = 0; y < 8; y++)
        for (int x = 0; x < 64; x++) pixels[y][x][3] = x < 32 ? 0 : 255;
    dp_texture *const t = texture_of(pixels[0][0], 64, 8, 4);
    const dp_style style = {
        .lines = DP_SILHOUETTE, .line = {{.width = 8}}, .stroke = {.texture = t}};
    triangles = 20000;
    draw("sphere", &style, 2, pictures[0][0][0]);
    triangles = 0;
    uint32_t blots = 0, dashes = 0;
    for (int y = 2; y + 2 < HEIGHT;
         y++) /* spots of ink, or of paper within ink, of one or two px */
        for (int x = 2; x + 2 < WIDTH; x++) {
            const bool ink = pictures[0][y][x][0] < 128;
            uint32_t alike = 0;
            for (int k = 0; k < 25; k++)
                alike += (pictures[0][y + k / 5 - 2][x + k % 5 - 2][0] < 128) == ink;
            blots += alike < 6;
            dashes += ink;
        }
    assert_true(dashes > 1000);
    assert_int_equal(blots, 0);
    dp_texture_destroy(t);
}

/* No gaps at 24 px: around the outline of a convex shape, every pixel up to 23 px outside is
 * ink. */
static void test_extruded_silhouettes_have_no_gaps(void **state) {
    (void)state;
    static const char *const shapes[] = {"cube", "sphere", "cylinder"};
    for (size_t i = 0; i < 3; i++) {
        dp_style style = {.lines = DP_NO_LINES, .surface = DP_RGB(255, 0, 0)};
        draw(shapes[i], &style, 1, pictures[0][0][0]);
        style = (dp_style){.lines = DP_SILHOUETTE | DP_BORDER,
                           .edges = DP_EDGES_ADJACENCY,
                           .ink = DP_INK_QUADS,
                           .line = {{.width = 24}},
                           .surface = DP_RGB(255, 0, 0)};
        draw(shapes[i], &style, 2, pictures[1][0][0]);
        int white = 0;
        for (int y = 0; y < HEIGHT; y++)
            for (int x = 0; x < WIDTH; x++) {
                if (pictures[0][y][x][1] < 250) continue; /* the shape itself */
                bool close = false;
                for (int v = -22; v <= 22 && !close; v++)
                    for (int u = -22; u <= 22 && !close; u++)
                        close = u * u + v * v <= 22 * 22 && x + u >= 0 && x + u < WIDTH &&
                                y + v >= 0 && y + v < HEIGHT && pictures[0][y + v][x + u][1] == 0;
                white += close && pictures[1][y][x][0] > 40;
            }
        if (white) fail_msg("%s: %d pixels without ink", shapes[i], white);
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
    for (int edges = 0; edges < 2; edges++) {
        const dp_style style = {.edges = (dp_edges)edges,
                                .ink = edges ? DP_INK_QUADS : DP_INK_STROKES,
                                .line = {{.width = 9}},
                                .stroke = {.taper = 5, .jitter = 1, .light = 0.5f, .repeats = 2}};
        dp_result result = DP_ERR_MEMORY;
        for (int n = 0; result; n += n < 60 ? 1 : 1 + n / 16) {
            ration r = {n};
            const dp_allocator allocator = {give, give_again, take, &r};
            result = draw_with(&(dp_context_desc){.allocator = &allocator, .threads = 1}, "bolt",
                               &style, pictures[0][0][0]);
            assert_true(result == DP_OK || result == DP_ERR_MEMORY);
            assert_true(n < 1000000);
        }
    }
}

static void test_strokes_out_of_range_are_refused(void **state) {
    (void)state;
    const dp_stroke_style bad[] = {{.repeats = 9},       {.taper = -1},    {.jitter = 65},
                                   {.depth = 1.5f},      {.light = -0.1f}, {.scale = -1},
                                   {.u = (dp_stroke_u)3}};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        dp_style out;
        dp_diag diag;
        assert_int_equal(dp_style_resolve(&(dp_style){.stroke = bad[i]}, &out, &diag),
                         DP_ERR_ARGUMENT);
    }
}

/* A model that is a dot: thousands of ends lie within a gap of each other, and not all pairs are looked at. */
static void test_a_crowd_of_ends_takes_little(void **state) {
    (void)state;
    enum { MANY = 8000 };
    static dp_stroke strokes[MANY];
    for (uint32_t i = 0; i < MANY; i++) {
        const float x = 5 + (float)(i % 200) * 0.002f, y = 5 + (float)(i / 200) * 0.002f;
        strokes[i] = stroke(x, y, x + 0.001f, y);
    }
    chain(strokes, MANY, 0.5f, 1);
    assert_true(chains.bridges_cap < 200 * (size_t)MANY);
    uint32_t links = 0;
    for (uint32_t i = 0; i < chains.chain_count; i++) links += chains.chains[i].count;
    assert_int_equal(links, MANY);
    free_chains();
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_segments_are_chained_whatever_way_they_run),
        cmocka_unit_test(test_rings_are_closed),
        cmocka_unit_test(test_at_a_crossing_the_straightest_go_on),
        cmocka_unit_test(test_small_gaps_are_bridged),
        cmocka_unit_test(test_any_number_of_channels_is_ink),
        cmocka_unit_test(test_looking_up_repeats_along_and_holds_across),
        cmocka_unit_test(test_odd_sizes_have_pyramids),
        cmocka_unit_test(test_textures_are_refused_with_a_reason),
        cmocka_unit_test(test_every_named_texture_has_ink_and_none_is_solid),
        cmocka_unit_test(test_png_files_become_textures),
        cmocka_unit_test(test_u_goes_on_along_a_stroke_in_arc_mode),
        cmocka_unit_test(test_the_same_seed_draws_the_same_picture),
        cmocka_unit_test(test_creases_are_drawn_beside_extruded_outlines),
        cmocka_unit_test(test_dashed_lines_are_chained_after_the_picture),
        cmocka_unit_test(test_gaps_of_a_texture_stay_open),
        cmocka_unit_test(test_a_crowd_of_ends_takes_little),
        cmocka_unit_test(test_extruded_silhouettes_have_no_gaps),
        cmocka_unit_test(test_memory_may_run_out),
        cmocka_unit_test(test_strokes_out_of_range_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
