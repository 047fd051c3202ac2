/* io/off: the keyword's variants, extras, comments, and errors. */
#include "reading.h"

#define TRIANGLE "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"
#define TRACE    "(0 0 0)(1 0 0)(0 1 0)\n"

static void plain_files_are_read(void **state) {
    (void)state;
    assert_trace("OFF\n3 1 0\n" TRIANGLE, TRACE);
    assert_trace("OFF 3 1 0\n" TRIANGLE, TRACE);
    assert_trace("OFF3 1 0\n" TRIANGLE, TRACE);
    assert_trace("OFF\n3 1\n" TRIANGLE, TRACE);
    assert_trace("OFF\r\n3 1 0\r\n0 0 0\r\n1 0 0\r\n0 1 0\r\n3 0 1 2", TRACE);
    assert_trace("OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n4 0 1 3 2\n3 0 1 2\n",
                 "(0 0 0)(1 0 0)(1 1 0)(0 1 0)\n" TRACE);
    static const char empty[] = "3 1 0\n" TRIANGLE;
    assert_string_equal(trace_bytes(empty, sizeof empty - 1, "a.off", DP_FORMAT_AUTO), TRACE);
}

static void comments_are_passed_over(void **state) {
    (void)state;
    assert_trace("# first\nOFF # here\n# there\n3 1 0 # counts\n\n0 0 0 # a\n# b\n1 0 0\n"
                 "0 1 # broken\n 0\n# c\n3 0 1 2 # d\n",
                 TRACE);
}

static void extras_are_passed_over(void **state) {
    (void)state;
    assert_trace("COFF\n3 1 0\n0 0 0 255 0 0 255\n1 0 0 1 1 1\n0 1 0 .5 .5 .5 1\n3 0 1 2\n", TRACE);
    assert_trace("NOFF\n3 1 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n3 0 1 2 255 0 0\n",
                 "(0 0 0)(1 0 0)(0 1 0)@#FF0000\n");
    assert_trace("STCNOFF\n3 1 0\n0 0 0 0 0 1 1 1 1 1 0 0\n1 0 0 0 0 1 1 1 1 1 0 0\n"
                 "0 1 0 0 0 1 1 1 1 1 0 0\n3 0 1 2 7\n",
                 TRACE);
    assert_trace("STOFF\n3 1 0\n0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\nanything behind\n",
                 TRACE);
}

static void indices_of_nothing_stay_for_the_engine(void **state) {
    (void)state;
    assert_trace("OFF\n1 2 0\n0 0 nan\n3 0 1 -1\n2 99999999999 0\n",
                 "(0 0 nan)(out)(none)\n(none)(0 0 nan)\n");
}

static void other_kinds_are_refused(void **state) {
    (void)state;
    assert_contains(trace_text("OFF BINARY\n"), "not supported at line 1, byte 0: binary OFF");
    assert_contains(trace_text("4OFF\n3 1 0\n"), "other than three coordinates");
    assert_contains(trace_text("nOFF 2\n3 1 0\n"), "other than three coordinates");
}

static void broken_files_are_told_with_their_line(void **state) {
    (void)state;
    assert_contains(trace_text("OFF\n"), "the file ends where the number of vertices");
    assert_contains(trace_text("OFF\nx 1 0\n"),
                    "at line 2, byte 0: expected the number of vertices");
    assert_contains(trace_text("OFF\n3 -1 0\n"), "number of faces, found `-1`");
    assert_contains(trace_text("OFF\n3 1 0\n0 0 0\n1 a 0\n"),
                    "at line 4, byte 0: expected a coordinate of vertex 1 of 3, found `a`");
    assert_contains(trace_text("OFF\n3 2 0\n" TRIANGLE), "number of corners of face 1 of 2");
    assert_contains(trace_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1.5 2\n"),
                    "at line 6, byte 0: expected a vertex number of face 0 of 1, found `1.5`");
    assert_contains(trace_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n-3 0 1 2\n"), "found `-3`");
    assert_contains(trace_text("OFF\n353535235358 1 0\n0 0 0\n"), "vertex 1 of 353535235358");
    assert_contains(trace_text("OFF\n3 99999999999 0\n" TRIANGLE), "face 1 of 99999999999");
    assert_contains(trace_text("OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n"), "points but no polygons");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plain_files_are_read),
        cmocka_unit_test(comments_are_passed_over),
        cmocka_unit_test(extras_are_passed_over),
        cmocka_unit_test(indices_of_nothing_stay_for_the_engine),
        cmocka_unit_test(other_kinds_are_refused),
        cmocka_unit_test(broken_files_are_told_with_their_line),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
