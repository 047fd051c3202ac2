/* Patterns and light on lines: a small picture of each way, compared with a stored one (golden.h). */
#include "golden.h"

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

enum { W = 200, H = 160 };

#define WIDE(w) .line = {{.width = w}, {.width = w}, {.width = w}, {.width = w}, {.width = w}}
#define QUADS   .ink = DP_INK_QUADS
#define FLAT    .camera = {.flat = true}

static const golden pictures[] = {
    {"quads-checks", "cube", .style = {QUADS, WIDE(12)}, .pattern = "checks"},
    {"quads-paper", "cube", .style = {QUADS, WIDE(10), .method = DP_METHOD_PAPER},
     .pattern = "meander"},
    {"quads-small-edges", "torus", .style = {QUADS, WIDE(10)}, .pattern = "lace", .fragile = true},
    {"quads-screen", "bracket", .style = {QUADS, WIDE(8), .pattern = {.screen = true}},
     .pattern = "dashes", .fragile = true},
    {"quads-valleys", .make = make_valleys, .style = {QUADS, WIDE(9)}, FLAT, .pattern = "chevrons"},
    {"quads-valleys-interval", .make = make_valleys,
     .style = {QUADS, WIDE(9), .between = DP_BETWEEN_INTERVAL}, FLAT, .pattern = "chevrons"},
    {"quads-valleys-stencil", .make = make_valleys,
     .style = {QUADS, WIDE(9), .between = DP_BETWEEN_STENCIL}, FLAT, .pattern = "chevrons"},
    {"quads-lit", "gear",
     .style = {QUADS, WIDE(6), .line_light = {.lighting = DP_LINE_LIGHT_LAMBERT}}, .fragile = true},
    {"quads-lit-toon", "bracket",
     .style = {QUADS, WIDE(8),
               .line_light = {.lighting = DP_LINE_LIGHT_TOON, .lit = DP_RGB(255, 160, 0)},
               .shade = {.shading = DP_SHADING_GOOCH}},
     .pattern = "rope", .fragile = true},
    {"strokes-rope", "bracket", .style = {WIDE(9)}, .pattern = "rope", .fragile = true},
    {"strokes-length", "cube", .style = {WIDE(9), .pattern = {.world_length = 0.5f}},
     .pattern = "checks"},
    {"strokes-screen", "cube", .style = {WIDE(9), .pattern = {.screen = true, .length = 20}},
     .pattern = "checks"},
    {"strokes-lit", "bolt", .style = {WIDE(5), .line_light = {.lighting = DP_LINE_LIGHT_GOOCH}},
     .fragile = true},
};

static void pictures_are_as_they_were(void **state) {
    (void)state;
    golden_check("patterns", pictures, sizeof pictures / sizeof *pictures, W, H);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(pictures_are_as_they_were)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
