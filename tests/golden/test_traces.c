/* The traces of small drawings (golden.h): what each line is, what ends it and what hides it, how
 * lines are chained; of models with lines of all classes, open and badly wound ones, groups,
 * pictures that cut them, stylized strokes, adjacency, streamed sources.
 *
 * The traces pin what is found today. */
#include "golden.h"

#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 240, HEIGHT = 180 };

#define FLAT      .camera = {.flat = true}
#define STEEP     .camera = {.flat = true, .direction = {0.5, 0.6, 1}}
#define ADJACENCY .edges = DP_EDGES_ADJACENCY
#define COLORS                                                                                     \
    .line = {{1, DP_RGB(20, 20, 20)},                                                              \
             {1.5f, DP_RGB(200, 40, 30)},                                                          \
             {2, DP_RGB(30, 70, 200)},                                                             \
             {2.5f, DP_RGB(20, 140, 60)},                                                          \
             {3, DP_RGB(190, 110, 0)}}

/* From before the near plane to behind the far one: a roof, and a strip through it. */
static void make_long(model *m) {
    static const float at[3][4][3] = {
        {{-60, -10, -1000}, {0, 30, -1000}, {0, 30, 700}, {-60, -10, 700}},
        {{0, 30, -1000}, {60, -10, -1000}, {60, -10, 700}, {0, 30, 700}},
        {{-80, 0, -400}, {80, -5, -400}, {80, 5, 650}, {-80, 10, 650}},
    };
    for (size_t i = 0; i < 3; i++) {
        memcpy(m->positions[m->corners], at[i], sizeof at[i]);
        memset(m->flags + m->corners, 1, 4);
        m->firsts[m->polygons++] = (uint32_t)m->corners;
        m->firsts[m->polygons] = (uint32_t)(m->corners += 4);
    }
}

static const golden whole[] = {
    {"cube", "cube", .style = {COLORS}},
    {"cube-ortho", "cube", .camera = {.orthographic = true}},
    {"cube-near", "cube", .camera = {.direction = {0.4, 0.3, 1}, .zoom = 1.4}},
    {"crossing", "boxes", .style = {COLORS}, .fragile = true},
    {"open", .make = make_open, .style = {COLORS}, FLAT},
    {"valleys", .make = make_valleys, .style = {COLORS}, FLAT},
    {"gaps", .make = make_gaps, .style = {.stroke = {.taper = 60}}, FLAT},
    {"badly-wound", .make = make_badly_wound, .style = {.lines = DP_SIL_RIDGE_VALLEY}, FLAT},
    {"concave", .make = make_concave, FLAT},
    {"planes", .make = make_long, .camera = {.flat = true, .direction = {0.05, 0.06, 1}}},
    {"groups", .make = make_touching, .reading = GOLDEN_IMMEDIATE, STEEP},
    {"adjacency", .make = make_touching, .style = {ADJACENCY}, STEEP},
    {"section", "cube", .style = {COLORS},
     .clip = {.planes = {{{0, 1, 0}, 0.25}}, .plane_count = 1, .hatch_spacing = 0.4}},
    {"section-corner", "cube",
     .clip = {.planes = {{{0, 1, 0}, 0.25}, {{1, 0, 1}, 0.5}},
              .plane_count = 2,
              .look = DP_SECTION_CROSSED,
              .hatch_angle = 30,
              .hatch_spacing = 0.5}},
    {"section-parts", .make = make_touching, STEEP,
     .clip = {.planes = {{{0.5, 0.6, 1}, 0}}, .plane_count = 1, .hatch_spacing = 12}},
    {"section-open", .make = make_open, .style = {COLORS}, STEEP,
     .clip = {.planes = {{{1, 0, 0}, 5}}, .plane_count = 1, .look = DP_SECTION_PLAIN}},
};

/* The picture's edge cuts these. */
static const golden cut[] = {
    {"bars", .make = make_bars, .style = {.lines = DP_BORDER}, FLAT},
    {"fans", .make = make_fans, FLAT},
    {"sheets", .make = make_sheets, FLAT},
    {"crossing-many", .make = make_crossing, FLAT},
    {"streamed", .make = make_fans, FLAT, .reading = GOLDEN_TWICE},
};

static void traces_are_as_they_were(void **state) {
    (void)state;
    golden_check_traces("traces", whole, sizeof whole / sizeof *whole, WIDTH, HEIGHT);
}

static void traces_of_parts_are_as_they_were(void **state) {
    (void)state;
    golden_check_traces("traces", cut, sizeof cut / sizeof *cut, WIDTH / 2, HEIGHT / 2);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(traces_are_as_they_were),
                                       cmocka_unit_test(traces_of_parts_are_as_they_were)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
