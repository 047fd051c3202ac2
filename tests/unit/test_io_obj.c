/* io/obj: corners of every form, groups, continued lines, and errors. */
#include "reading.h"

#define SQUARE "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"

static void polygons_stay_polygons(void **state) {
    (void)state;
    assert_trace(SQUARE "f 1 2 3\nf 1 3 4\n", "(0 0 0)(1 0 0)(1 1 0)\n(0 0 0)(1 1 0)(0 1 0)\n");
    assert_trace(SQUARE "f 1 2 3\nf 1 2 3 4\nf 1 2 3",
                 "(0 0 0)(1 0 0)(1 1 0)\n(0 0 0)(1 0 0)(1 1 0)(0 1 0)\n(0 0 0)(1 0 0)(1 1 0)\n");
    assert_trace(SQUARE "f 1 2 3\nf 1 2\nf\t\nf 4\n",
                 "(0 0 0)(1 0 0)(1 1 0)\n(0 0 0)(1 0 0)\n\n(0 1 0)\n");
}

static void triangles_need_no_firsts(void **state) {
    static const char text[] = SQUARE "f 1 2 3\nf 1 3 4\n";
    (void)state;
    dp_stream *stream = NULL;
    dp_source *source = NULL;
    dp_batch batch;
    dp_stream_open_memory(text, sizeof text - 1, 2048, NULL, &stream, NULL);
    assert_int_equal(dp_read_stream(stream, NULL, DP_FORMAT_OBJ, &source, NULL), DP_OK);
    assert_int_equal(dp_source_next(source, &batch, NULL), DP_OK);
    assert_true(batch.stable && !batch.firsts && !batch.groups && batch.corner_count == 6);
    assert_int_equal(batch.vertex_count, 4);
    dp_source_destroy(source);
}

static void corners_have_many_forms(void **state) {
    (void)state;
    assert_trace(SQUARE "vt 0 0\nvn 0 0 1\nf 1/1 2/1 3/1\nf 1//1 2//1 3//1\nf 1/1/1 2/1/1 3/1/1\n"
                        "f -4/-1/-1 -3//-1 -2/-1\n  f\t1   2\t3  # why\nf 1/ 2/ 3/\n",
                 "(0 0 0)(1 0 0)(1 1 0)\n(0 0 0)(1 0 0)(1 1 0)\n(0 0 0)(1 0 0)(1 1 0)\n"
                 "(0 0 0)(1 0 0)(1 1 0)\n(0 0 0)(1 0 0)(1 1 0)\n(0 0 0)(1 0 0)(1 1 0)\n");
}

static void relative_indices_count_from_their_line(void **state) {
    (void)state;
    assert_trace("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 5 5 5\nf -1 -2 -3\n",
                 "(0 0 0)(1 0 0)(0 1 0)\n(5 5 5)(0 1 0)(1 0 0)\n");
    assert_trace("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n", "(0 0 0)(1 0 0)(0 1 0)\n");
}

static void indices_of_nothing_stay_for_the_engine(void **state) {
    (void)state;
    assert_trace(SQUARE "f 0 1 2\nf -5 1 2\nf 5 1 2\nf 4294967296 1 2\nf 4294967297 1 2\n"
                        "f 99999999999999999999999 -99999999999999999999999 2\n",
                 "(none)(0 0 0)(1 0 0)\n(none)(0 0 0)(1 0 0)\n(out)(0 0 0)(1 0 0)\n"
                 "(none)(0 0 0)(1 0 0)\n(none)(0 0 0)(1 0 0)\n(none)(none)(1 0 0)\n");
}

static void vertices_may_carry_more(void **state) {
    (void)state;
    assert_trace("v 1 2 3 1.0\r\nv 4e0 -5 .6e1 0.1 0.2 0.3\r\nv nan inf -inf\r\nf 1 2 3\r\n",
                 "(1 2 3)(4 -5 6)(nan inf -inf)\n");
    assert_trace("v 1 2 3\rv 4 5 6\rv 7 8 9\r# comment\rf 1 2 3\r", "(1 2 3)(4 5 6)(7 8 9)\n");
}

static void lines_may_be_continued(void **state) {
    (void)state;
    assert_trace("v 0 \\\n 0 0\nv 1\\\r\n 0 0\nv 0 1 0\n# not here \\\nf 1 \\\n\\\n2 3\\\n\n",
                 "(0 0 0)(1 0 0)(0 1 0)\n");
    assert_contains(trace_text("v 0 0 0\nv 0 \\\n 0 x\n"),
                    "at line 3, byte 0: expected a vertex's z");
}

static void groups_objects_and_materials_name(void **state) {
    (void)state;
    assert_trace(
        SQUARE
        "f 1 2 3\ng left side \nf 1 2 3\ng right\nf 1 2 3\ng left side\nf 1 2 3\ng\nf 1 2 3\n",
        "(0 0 0)(1 0 0)(1 1 0)\n(0 0 0)(1 0 0)(1 1 0)@left side\n"
        "(0 0 0)(1 0 0)(1 1 0)@right\n(0 0 0)(1 0 0)(1 1 0)@left side\n"
        "(0 0 0)(1 0 0)(1 1 0)\n");
    assert_trace(SQUARE "o box\nusemtl red\nf 1 2 3\ng lid\nf 1 2 3\no ball\ng\nf 1 2 3 4\n",
                 "(0 0 0)(1 0 0)(1 1 0)@box/red\n(0 0 0)(1 0 0)(1 1 0)@box/lid/red\n"
                 "(0 0 0)(1 0 0)(1 1 0)(0 1 0)@ball/red\n");
    assert_trace("o only\n" SQUARE "f 1 2 3\n", "(0 0 0)(1 0 0)(1 1 0)@only\n");
}

/* More groups than 16 bits can number: the last is shared. */
static void too_many_groups_share_the_last(void **state) {
    const size_t room = 70000 * 20;
    char *const text = malloc(room);
    size_t length = (size_t)sprintf(text, SQUARE);
    (void)state;
    for (int i = 0; i < 66000; i++)
        length += (size_t)snprintf(text + length, room - length, "g %d\nf 1 2 3\n", i);
    dp_stream *stream = NULL;
    dp_source *source = NULL;
    dp_batch batch;
    dp_stream_open_memory(text, length, DP_STREAM_WINDOW, NULL, &stream, NULL);
    assert_int_equal(dp_read_stream(stream, NULL, DP_FORMAT_AUTO, &source, NULL), DP_OK);
    assert_int_equal(dp_source_next(source, &batch, NULL), DP_OK);
    assert_int_equal(batch.polygon_count, 66000);
    for (size_t i = 0; i < 66000; i++) assert_int_equal(batch.groups[i], i < 65535 ? i : 65535);
    assert_string_equal(dp_source_group_name(source, 1234), "1234");
    assert_null(dp_source_group_name(source, 65536));
    dp_source_destroy(source);
    free(text);
}

static void long_names_are_cut(void **state) {
    char text[6000] = SQUARE "g ";
    (void)state;
    for (int i = 0; i < 5000; i++) append(text, sizeof text, "n");
    append(text, sizeof text, "\nf 1 2 3\n");
    char expected[400] = "(0 0 0)(1 0 0)(1 1 0)@";
    for (int i = 0; i < 255; i++) append(expected, sizeof expected, "n");
    append(expected, sizeof expected, "\n");
    assert_trace(text, expected);
}

static void other_lines_are_passed_over(void **state) {
    (void)state;
    assert_trace("# made by hand\nmtllib a.mtl\n" SQUARE "vp 1 2\ns off\nl 1 2\np 1\ncurv 0 1 1 2\n"
                 "unknown words here\nvolume 3\nfree\nobject\ngroups\nf 1 2 3\n",
                 "(0 0 0)(1 0 0)(1 1 0)\n");
}

static void broken_lines_are_told(void **state) {
    (void)state;
    assert_contains(trace_text("v 0 0 0\nv 1 0\nf 1 2 3\n"),
                    "at line 2, byte 0: the line ends where a vertex's z should be");
    assert_contains(trace_text("v 0 0 0\n\n\nv 1 zero 0\n"),
                    "at line 4, byte 0: expected a vertex's y, found `zero`");
    assert_contains(trace_text(SQUARE "f 1 2 x\n"),
                    "at line 5, byte 0: expected a face's vertex number, found `x`");
    assert_contains(trace_text(SQUARE "f 1 2.5 3\n"), "found `2.5`");
    assert_contains(trace_text(SQUARE "f 1 2/1/1x 3\n"), "found `2/1/1x`");
    assert_contains(trace_text("v 0 0 0\nv 0 0 1"), "points but no polygons");
    assert_contains(trace_text("v 0 0 0\nv 0 0"),
                    "at line 2, byte 0: the file ends where a vertex's z");
    assert_contains(trace_bytes("v 1 2 \0 3\n", 10, NULL, DP_FORMAT_AUTO), "found `?`");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(polygons_stay_polygons),
        cmocka_unit_test(triangles_need_no_firsts),
        cmocka_unit_test(corners_have_many_forms),
        cmocka_unit_test(relative_indices_count_from_their_line),
        cmocka_unit_test(indices_of_nothing_stay_for_the_engine),
        cmocka_unit_test(vertices_may_carry_more),
        cmocka_unit_test(lines_may_be_continued),
        cmocka_unit_test(groups_objects_and_materials_name),
        cmocka_unit_test(too_many_groups_share_the_last),
        cmocka_unit_test(long_names_are_cut),
        cmocka_unit_test(other_lines_are_passed_over),
        cmocka_unit_test(broken_lines_are_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
