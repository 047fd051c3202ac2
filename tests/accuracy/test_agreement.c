/* What scripts/agreement.sh measures drawings with (bench/ink.c), against direct counts. */
#include "ink.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { SIDE_MAX = 40 };

/* A picture of black ink on white: `#` is ink, lines end with '\n'. */
static ink drawn(const char *rows) {
    uint8_t rgba[SIDE_MAX * SIDE_MAX * 4];
    const uint32_t width = (uint32_t)strcspn(rows, "\n");
    uint32_t pixels = 0;
    ink i;
    for (; *rows; rows++) {
        if (*rows == '\n') continue;
        memset(rgba + 4 * (size_t)pixels, *rows == '#' ? 0 : 255, 3);
        rgba[4 * (size_t)pixels++ + 3] = 255;
    }
    assert_true(ink_make(rgba, width, pixels / width, &i));
    return i;
}

static void scatter(ink *i, uint32_t width, uint32_t height, uint32_t one_in) {
    static uint32_t state = 1;
    uint8_t rgba[SIDE_MAX * SIDE_MAX * 4];
    for (uint32_t p = 0; p < width * height; p++) {
        state = state * 1664525 + 1013904223;
        memset(rgba + 4 * (size_t)p, (state >> 16) % one_in ? 255 : 0, 3);
        rgba[4 * (size_t)p + 3] = 255;
    }
    assert_true(ink_make(rgba, width, height, i));
}

/* Every pixel of a against every pixel of b. */
static size_t near_by_pairs(const ink *a, const ink *b, double px) {
    size_t near = 0;
    const size_t pixels = (size_t)a->width * a->height;
    for (size_t p = 0; p < pixels; p++) {
        bool found = false;
        for (size_t q = 0; q < pixels && a->pixels[p] && !found; q++) {
            const double dx = (double)(p % a->width) - (double)(q % a->width);
            const double dy = (double)(p / a->width) - (double)(q / a->width);
            found = b->pixels[q] && dx * dx + dy * dy <= px * px;
        }
        near += found;
    }
    return near;
}

static void test_near_is_what_pairs_say(void **state) {
    (void)state;
    static const double distances[] = {0, 0.9, 1, 1.5, 2, 3, 3.7, 17, 35, 1000};
    static const uint32_t sizes[][2] = {{40, 40}, {40, 7}, {7, 40}, {1, 40}, {40, 1}, {1, 1}};
    static const uint32_t one_in[] = {2, 30, 300, 100000};
    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++)
        for (size_t n = 0; n < sizeof one_in / sizeof *one_in; n++) {
            ink a, b;
            scatter(&a, sizes[s][0], sizes[s][1], 10);
            scatter(&b, sizes[s][0], sizes[s][1], one_in[n]);
            for (size_t d = 0; d < sizeof distances / sizeof *distances; d++)
                assert_int_equal(ink_near(&a, &b, distances[d]),
                                 near_by_pairs(&a, &b, distances[d]));
            ink_free(&a);
            ink_free(&b);
        }
}

static void test_ink_is_darker_than_half_white(void **state) {
    (void)state;
    static const uint8_t rgba[][4] = {{127, 127, 127, 255}, {128, 128, 128, 255}, {0, 0, 0, 0},
                                      {0, 0, 0, 255},       {0, 0, 0, 100},       {0, 0, 0, 150},
                                      {255, 0, 0, 255},     {0, 255, 0, 255}};
    static const uint8_t expected[] = {1, 0, 0, 1, 0, 1, 1, 0};
    ink i;
    assert_true(ink_make(*rgba, 4, 2, &i));
    assert_memory_equal(i.pixels, expected, sizeof expected);
    assert_int_equal(i.count, 4);
    ink_free(&i);
}

static void crumbs_are(const char *rows, uint32_t size, size_t expected) {
    ink i = drawn(rows);
    assert_int_equal(ink_crumbs(&i, size), expected);
    ink_free(&i);
}

static void test_crumbs(void **state) {
    (void)state;
    crumbs_are("....\n....\n", 3, 0);
    crumbs_are("##..\n....\n", 3, 2);
    crumbs_are("##..\n....\n", 2, 0);
    crumbs_are("#...\n.#..\n..#.\n", 4, 3); /* joined at corners */
    crumbs_are("#...\n.#..\n..#.\n", 3, 0);
    crumbs_are("..#.\n.#..\n#...\n", 3, 0);
    crumbs_are("#.#.#\n#.#..\n#....\n", 3, 3);               /* three pieces, one too high */
    crumbs_are("#####\n#...#\n#.#.#\n#...#\n#####\n", 4, 1); /* one within another */
    crumbs_are("#...#\n....#\n....#\n#...#\n", 4, 2); /* pieces do not go on round the border */
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_near_is_what_pairs_say),
        cmocka_unit_test(test_ink_is_darker_than_half_white),
        cmocka_unit_test(test_crumbs),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
