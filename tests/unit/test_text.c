/* Texts of pages as strokes, which who draws pages elsewhere is handed. */
#include <drypoint/drawing.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

typedef struct reach {
    size_t strokes, points;
    double min[2], max[2];
} reach;

static void take(void *user, const double (*points)[2], size_t count) {
    reach *const r = user;
    assert_true(count >= 2);
    r->strokes++, r->points += count;
    for (size_t i = 0; i < count; i++)
        for (int k = 0; k < 2; k++) {
            r->min[k] = fmin(r->min[k], points[i][k]);
            r->max[k] = fmax(r->max[k], points[i][k]);
        }
}

static reach reach_of(const char *text, double x, double y, double height) {
    reach r = {.min = {INFINITY, INFINITY}, .max = {-INFINITY, -INFINITY}};
    const dp_page_text t = {text, x, y, height};
    dp_page_text_strokes(&t, take, &r);
    return r;
}

static void capitals_stand_on_their_line(void **state) {
    (void)state;
    const reach r = reach_of("HE", 20, 50, 5);
    assert_true(fabs(r.max[1] - 50) < 1e-9 && fabs(r.min[1] - 45) < 1e-9);
    assert_true(fabs(r.min[0] - 20) < 1e-9 && r.max[0] > 25 && r.max[0] < 30);
    assert_true(r.strokes >= 4);
}

static void texts_grow_with_their_letters(void **state) {
    (void)state;
    const reach one = reach_of("n", 0, 0, 10), two = reach_of("nn", 0, 0, 10),
                large = reach_of("n", 0, 0, 20);
    assert_true(two.max[0] > 1.9 * one.max[0] && two.strokes == 2 * one.strokes);
    assert_true(fabs(large.max[0] - 2 * one.max[0]) < 1e-9);
}

static void every_letter_is_drawn(void **state) {
    (void)state;
    for (int c = '!'; c <= '~'; c++) {
        const char text[2] = {(char)c, 0};
        const reach r = reach_of(text, 0, 0, 10);
        assert_true(r.strokes > 0 && r.min[0] >= 0 && r.max[1] <= 3 && r.min[1] >= -13);
    }
    assert_true(reach_of("\xC3\xA9", 0, 0, 10).strokes > reach_of("e", 0, 0, 10).strokes);
    assert_true(reach_of("\xE2\x82\xAC", 0, 0, 10).strokes > 0); /* a box */
}

static void nothing_is_no_stroke(void **state) {
    (void)state;
    assert_int_equal(reach_of("", 0, 0, 10).strokes, 0);
    assert_int_equal(reach_of("  ", 0, 0, 10).strokes, 0);
    assert_int_equal(reach_of(NULL, 0, 0, 10).strokes, 0);
    dp_page_text_strokes(NULL, take, NULL);
    dp_page_text_strokes(&(dp_page_text){.text = "a", .height = 1}, NULL, NULL);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(capitals_stand_on_their_line),
                                       cmocka_unit_test(texts_grow_with_their_letters),
                                       cmocka_unit_test(every_letter_is_drawn),
                                       cmocka_unit_test(nothing_is_no_stroke)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
