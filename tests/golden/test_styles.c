/* One small picture per style, edge detector and mirror, compared with the one that is kept
 * (decoded pixels). DP_GOLDEN_WRITE=1 writes those that are not there; look at them before they are
 * kept. */
#include <drypoint/drypoint.h>
#include <drypoint/io.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { W = 160, H = 120 };

typedef struct golden {
    const char *name, *shape;
    dp_style style;
} golden;

#define QUIET .lines = DP_NO_LINES
#define TAN   DP_RGB(224, 196, 150)

static const golden pictures[] = {
    {"lambert",
     "bolt",
     {QUIET, .surface = TAN, .shade = {.shading = DP_SHADING_LAMBERT, .highlight = 0.5f}}},
    {"gooch", "bolt", {.surface = TAN, .shade = {.shading = DP_SHADING_GOOCH}}},
    {"toon", "torus", {QUIET, .surface = TAN, .shade = {.shading = DP_SHADING_TOON}}},
    {"toon-nearest",
     "torus",
     {QUIET, .surface = TAN, .shade = {.shading = DP_SHADING_TOON, .nearest = true}}},
    {"hatch", "torus", {QUIET, .shade = {.shading = DP_SHADING_HATCH}}},
    {"hatch-object",
     "torus",
     {QUIET, .shade = {.shading = DP_SHADING_HATCH, .object_space = true}}},
    {"halftone", "torus", {QUIET, .shade = {.shading = DP_SHADING_HALFTONE, .stroke_scale = 0.5f}}},
    {"paper", "bracket", {.paper = TAN, .shade = {.shading = DP_SHADING_PAPER}}},
    {"map-diagonal", "bracket", {QUIET, .edge_map = {.detector = DP_EDGE_MAP_DIAGONAL}}},
    {"map-c1", "bracket", {QUIET, .edge_map = {.detector = DP_EDGE_MAP_C1}}},
    {"map-printed",
     "bracket",
     {QUIET,
      .edge_map = {.detector = DP_EDGE_MAP_DIAGONAL, .as_printed = true, .eight_bits = true}}},
    {"map-both",
     "bolt",
     {.lines = DP_SILHOUETTE,
      .shade = {.shading = DP_SHADING_GOOCH},
      .edge_map = {.detector = DP_EDGE_MAP_DIAGONAL, .inner = DP_RGB(255, 255, 255), .radius = 2}}},
    {"mirror",
     "bolt",
     {.surface = TAN,
      .shade = {.shading = DP_SHADING_TOON},
      .edge_map = {.detector = DP_EDGE_MAP_DIAGONAL},
      .mirror = {.normal = {0, 1, 0},
                 .offset = -1,
                 .size = 3,
                 .tint = DP_RGB(120, 160, 200),
                 .tint_share = 0.2f,
                 .fade = 2}}},
};

static void draw(const golden *g, uint8_t *rgba) {
    dp_context *context = NULL;
    dp_source *source = NULL;
    dp_camera camera;
    const dp_fit fit = {.min = {-1, -1, -1}, .max = {1, 1, 1}};
    assert_int_equal(dp_context_create(NULL, &context, NULL), DP_OK);
    assert_int_equal(dp_source_from_shape(&(dp_shape){.name = g->shape}, &source, NULL), DP_OK);
    assert_int_equal(dp_camera_fit(&camera, &fit), DP_OK);
    const dp_target target = {.width = W, .height = H, .rgba = rgba};
    assert_int_equal(dp_draw(context, source, &camera, &g->style, &target, NULL), DP_OK);
    dp_source_destroy(source);
    dp_context_destroy(context);
}

/* Another machine's sines may round otherwise: a pixel in two thousand may be off, others by a grey
 * level. */
static void compare(const char *name, const uint8_t *rgba, const uint8_t *kept) {
    int off = 0;
    for (int i = 0; i < W * H; i++) {
        bool near = true;
        for (int k = 0; k < 4; k++) near &= abs(rgba[4 * i + k] - kept[4 * i + k]) <= 1;
        off += !near;
    }
    if (off > W * H / 2000) fail_msg("%s: %d of %d pixels differ", name, off, W * H);
}

static void pictures_are_as_they_were(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof pictures / sizeof *pictures; i++) {
        static uint8_t rgba[4 * W * H];
        char path[512];
        dp_io_pixels kept;
        draw(&pictures[i], rgba);
        snprintf(path, sizeof path, "%s/golden/styles/%s.png", DP_TESTS_DIR, pictures[i].name);
        if (dp_io_read_png(path, &kept, NULL)) {
            if (!getenv("DP_GOLDEN_WRITE")) fail_msg("%s is not there", path);
            assert_int_equal(dp_io_write_png(path, rgba, W, H, 0, NULL), DP_OK);
            continue;
        }
        assert_true(kept.width == W && kept.height == H);
        compare(pictures[i].name, rgba, kept.rgba);
        dp_io_free_pixels(&kept);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(pictures_are_as_they_were)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
