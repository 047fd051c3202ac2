/* One small picture per style, edge detector and mirror, compared with a stored one (golden.h). */
#include "golden.h"

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

enum { W = 160, H = 120 };

#define QUIET .lines = DP_NO_LINES
#define TAN   DP_RGB(224, 196, 150)

static const golden pictures[] = {
    {"lambert", "bolt",
     .style = {QUIET, .surface = TAN, .shade = {.shading = DP_SHADING_LAMBERT, .highlight = 0.5f}}},
    {"gooch", "bolt", .style = {.surface = TAN, .shade = {.shading = DP_SHADING_GOOCH}}},
    {"toon", "torus", .style = {QUIET, .surface = TAN, .shade = {.shading = DP_SHADING_TOON}}},
    {"toon-nearest", "torus",
     .style = {QUIET, .surface = TAN, .shade = {.shading = DP_SHADING_TOON, .nearest = true}}},
    {"hatch", "torus", .style = {QUIET, .shade = {.shading = DP_SHADING_HATCH}}},
    {"hatch-object", "torus",
     .style = {QUIET, .shade = {.shading = DP_SHADING_HATCH, .object_space = true}}},
    {"halftone", "torus",
     .style = {QUIET, .shade = {.shading = DP_SHADING_HALFTONE, .stroke_scale = 0.5f}}},
    {"paper", "bracket", .style = {.paper = TAN, .shade = {.shading = DP_SHADING_PAPER}}},
    {"map-diagonal", "bracket", .style = {QUIET, .edge_map = {.detector = DP_EDGE_MAP_DIAGONAL}}},
    {"map-c1", "bracket", .style = {QUIET, .edge_map = {.detector = DP_EDGE_MAP_C1}}},
    {"map-printed", "bracket",
     .style = {QUIET, .edge_map = {.detector = DP_EDGE_MAP_DIAGONAL,
                                   .as_printed = true,
                                   .eight_bits = true}}},
    {"map-both", "bolt",
     .style = {.lines = DP_SILHOUETTE,
               .shade = {.shading = DP_SHADING_GOOCH},
               .edge_map = {.detector = DP_EDGE_MAP_DIAGONAL,
                            .inner = DP_RGB(255, 255, 255),
                            .radius = 2}}},
    {"mirror", "bolt",
     .style = {.surface = TAN,
               .shade = {.shading = DP_SHADING_TOON},
               .edge_map = {.detector = DP_EDGE_MAP_DIAGONAL},
               .mirror = {.normal = {0, 1, 0},
                          .offset = -1,
                          .size = 3,
                          .tint = DP_RGB(120, 160, 200),
                          .tint_share = 0.2f,
                          .fade = 2}}},
};

static void pictures_are_as_they_were(void **state) {
    (void)state;
    golden_check("styles", pictures, sizeof pictures / sizeof *pictures, W, H);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(pictures_are_as_they_were)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
