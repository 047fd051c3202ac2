/* io/ply: the three encodings, every type, lists and strips, unknown content, and broken files. */
#include "reading.h"

#define HEADER(format, vertices)                                                                   \
    "ply\nformat " format " 1.0\nelement vertex " vertices                                         \
    "\nproperty float x\nproperty float y\nproperty float z\n"
#define FACES(count) "element face " count "\nproperty list uchar int vertex_indices\nend_header\n"
#define SQUARE       "0 0 0\n1 0 0\n1 1 0\n0 1 0\n"

static void ascii_is_read(void **state) {
    (void)state;
    assert_trace(HEADER("ascii", "4") FACES("2") SQUARE "3 0 1 2\n3 0 2 3\n",
                 "(0 0 0)(1 0 0)(1 1 0)\n(0 0 0)(1 1 0)(0 1 0)\n");
    assert_trace(HEADER("ascii", "4") FACES("3") SQUARE "4 0 1 2 3\n3 0 2 3\n0\n",
                 "(0 0 0)(1 0 0)(1 1 0)(0 1 0)\n(0 0 0)(1 1 0)(0 1 0)\n\n");
    /* values over many lines, and many on one */
    assert_trace(HEADER("ascii", "3") FACES("1") "0 0 0 1 0 0 1\n\n\t1 0 3 0\n1 2",
                 "(0 0 0)(1 0 0)(1 1 0)\n");
}

static void lines_may_end_in_any_way(void **state) {
    static const char *const ends[] = {"\n", "\r\n", "\r"};
    static const char text[] = HEADER("ascii", "4") FACES("1") SQUARE "3 0 1 2\n";
    (void)state;
    for (int e = 0; e < 3; e++) {
        char copy[1000] = "";
        for (const char *p = text; *p; p++)
            if (*p == '\n')
                append(copy, sizeof copy, "%s", ends[e]);
            else
                append(copy, sizeof copy, "%c", *p);
        assert_trace(copy, "(0 0 0)(1 0 0)(1 1 0)\n");
    }
}

static void what_is_not_needed_is_passed_over(void **state) {
    (void)state;
    assert_trace(
        "ply\nformat ascii 1.0\ncomment end_header\nobj_info \\\nelement material 2\n"
        "property list uchar float colour\nproperty int number\nelement vertex 3\n"
        "property float nx\nproperty double z\nproperty list int short tags\n"
        "property float32 y\nproperty uint8 red\nproperty int x\nelement nothing 99999999999999\n"
        "element face 1\nproperty list uchar float texcoord\n"
        "property list uint8 int32 vertex_index\nproperty uchar flags\nelement edge 1\n"
        "property int v\nend_header\n2 .5 .5 7\n0 8\n9 1 0 2 255 3\n9 4 2 7 7 5 255 6\n"
        "9 7 1 0 8 255 9\n6 0 0 0 1 1 1 3 2 1 0 255\n12\n",
        "(9 8 7)(6 5 4)(3 2 1)\n");
    assert_trace("ply\nformat ascii 1.0\nCreated by Blender3D 247 - www.blender.org, source file:\n"
                 "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n" FACES(
                     "1") "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
                 "(0 0 0)(1 0 0)(0 1 0)\n");
    assert_trace("ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\n"
                 "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                 "end_header\n3 0 1 2\n0 0 0\n1 0 0\n0 1 0\n",
                 "(0 0 0)(1 0 0)(0 1 0)\n");
}

static void odd_numbers_stay_for_the_engine(void **state) {
    (void)state;
    assert_trace(HEADER("ascii", "3") FACES("3") "0 0 nan\ninf 0 0\n0 1 0\n3 0 1 3\n3 -1 0 1\n"
                                                 "3 4294967296 99999999999999999999 2\n",
                 "(0 0 nan)(inf 0 0)(out)\n(none)(0 0 nan)(inf 0 0)\n(none)(none)(0 1 0)\n");
}

static void strips_are_triangles(void **state) {
    (void)state;
    assert_trace(
        HEADER("ascii",
               "6") "element tristrips 2\nproperty list int int vertex_indices\n"
                    "end_header\n0 0 0\n1 0 0\n2 0 0\n3 0 0\n4 0 0\n5 0 0\n9 0 1 2 3 -1 3 4 5 -1\n"
                    "7 0 1 2 2 2 3 4\n",
        "(0 0 0)(1 0 0)(2 0 0)\n(2 0 0)(1 0 0)(3 0 0)\n(3 0 0)(4 0 0)(5 0 0)\n"
        "(0 0 0)(1 0 0)(2 0 0)\n(2 0 0)(3 0 0)(4 0 0)\n");
}

/* Every type, once as a coordinate and once as an index, in both orders. */
static void binary_is_read_in_both_orders(void **state) {
    static const struct {
        const char *name;
        size_t size;
        char kind;
    } types[] = {{"char", 1, 'i'},  {"uchar", 1, 'u'},  {"short", 2, 'i'},   {"ushort", 2, 'u'},
                 {"int", 4, 'i'},   {"uint", 4, 'u'},   {"float", 4, 'f'},   {"double", 8, 'd'},
                 {"int8", 1, 'i'},  {"uint8", 1, 'u'},  {"int16", 2, 'i'},   {"uint16", 2, 'u'},
                 {"int32", 4, 'i'}, {"uint32", 4, 'u'}, {"float32", 4, 'f'}, {"float64", 8, 'd'}};
    (void)state;
    for (size_t i = 0; i < 2 * sizeof types / sizeof *types; i++) {
        const size_t t = i / 2;
        bytes file = {.big = i & 1};
        char header[500];
        snprintf(
            header, sizeof header,
            "ply\nformat binary_%s_endian 1.0\nelement vertex 3\nproperty %s x\nproperty %s y\n"
            "property %s z\nelement face 2\nproperty double w\nproperty list %s %s vertex_indices\n"
            "end_header\n",
            file.big ? "big" : "little", types[t].name, types[t].name, types[t].name, types[t].name,
            types[t].name);
        put_text(&file, header);
        for (int v = 0; v < 3; v++)
            for (int k = 0; k < 3; k++) {
                const int value = types[t].kind == 'u' ? 200 + 3 * v + k : 100 - 70 * v + k;
                if (types[t].kind == 'f')
                    put_float(&file, (float)value);
                else if (types[t].kind == 'd')
                    put_double(&file, value);
                else
                    put(&file, (uint64_t)(int64_t)value, types[t].size);
            }
        for (int f = 0; f < 2; f++) {
            put_double(&file, 7);
            for (int c = 0; c < 4 + f; c++) {
                const int value = c ? (c - 1) % 3 : 3 + f;
                if (types[t].kind == 'f')
                    put_float(&file, (float)value);
                else if (types[t].kind == 'd')
                    put_double(&file, value);
                else
                    put(&file, (uint64_t)value, types[t].size);
            }
        }
        const char *const expected = types[t].kind == 'u'
                                         ? "(200 201 202)(203 204 205)(206 207 208)\n"
                                           "(200 201 202)(203 204 205)(206 207 208)(200 201 202)\n"
                                         : "(100 101 102)(30 31 32)(-40 -39 -38)\n"
                                           "(100 101 102)(30 31 32)(-40 -39 -38)(100 101 102)\n";
        assert_string_equal(trace_bytes(file.data, file.size, NULL, DP_FORMAT_AUTO), expected);
    }
}

/* A header's last line end is one, two or no more bytes: 10 may be the content's first. */
static void binary_content_begins_right_behind_the_header(void **state) {
    static const char *const ends[] = {"\n", "\r\n", "\r"};
    (void)state;
    for (int e = 0; e < 3; e++) {
        bytes file = {.size = 0};
        static const char *const lines[] = {"ply",
                                            "format binary_little_endian 1.0",
                                            "element vertex 3",
                                            "property uchar x",
                                            "property uchar y",
                                            "property uchar z",
                                            "element face 1",
                                            "property list uchar char vertex_indices",
                                            "end_header"};
        for (size_t i = 0; i < sizeof lines / sizeof *lines; i++)
            put_text(&file, lines[i]), put_text(&file, ends[e]);
        static const uint8_t content[] = {10, 13, 10, 1, 2, 3, 4, 5, 6, 3, 0, 1, 2};
        for (size_t i = 0; i < sizeof content; i++) put(&file, content[i], 1);
        assert_string_equal(trace_bytes(file.data, file.size, NULL, DP_FORMAT_AUTO),
                            "(10 13 10)(1 2 3)(4 5 6)\n");
    }
}

static void binary_lists_in_vertices_and_strips(void **state) {
    bytes file = {.big = true};
    (void)state;
    put_text(&file,
             HEADER("binary_big_endian",
                    "4") "property list ushort double rest\n"
                         "element tristrips 1\nproperty list int int vertex_indices\nend_header\n");
    for (int v = 0; v < 4; v++) {
        for (int k = 0; k < 3; k++) put_float(&file, (float)(v * 10 + k));
        put(&file, (uint64_t)v, 2);
        for (int i = 0; i < v; i++) put_double(&file, 1);
    }
    put(&file, 8, 4);
    static const int strip[] = {0, 1, 2, 3, -1, 3, 2, 1};
    for (size_t i = 0; i < 8; i++) put(&file, (uint64_t)(int64_t)strip[i], 4);
    assert_string_equal(trace_bytes(file.data, file.size, NULL, DP_FORMAT_AUTO),
                        "(0 1 2)(10 11 12)(20 21 22)\n(20 21 22)(10 11 12)(30 31 32)\n"
                        "(30 31 32)(20 21 22)(10 11 12)\n");
}

/* Restarts of strips whose numbers have no sign: the largest number stands for -1, in either
 * order. */
static void strips_of_unsigned_numbers_begin_anew(void **state) {
    static const uint32_t strip[] = {0, 1, 2, UINT32_MAX, 3, 2, 1, 0};
    (void)state;
    for (int big = 0; big < 2; big++) {
        bytes file = {.big = big};
        put_text(&file,
                 big ? HEADER("binary_big_endian", "4") : HEADER("binary_little_endian", "4"));
        put_text(&file,
                 "element tristrips 1\nproperty list uint uint vertex_indices\nend_header\n");
        for (int v = 0; v < 4; v++)
            for (int k = 0; k < 3; k++) put_float(&file, (float)(v * 10 + k));
        put(&file, 8, 4);
        for (size_t i = 0; i < 8; i++) put(&file, strip[i], 4);
        assert_string_equal(trace_bytes(file.data, file.size, NULL, DP_FORMAT_AUTO),
                            "(0 1 2)(10 11 12)(20 21 22)\n(30 31 32)(20 21 22)(10 11 12)\n"
                            "(10 11 12)(20 21 22)(0 1 2)\n");
    }
}

static void broken_headers_are_told(void **state) {
    (void)state;
    assert_contains(trace_text("ply\nformat binary_middle_endian 1.0\nend_header\n"),
                    "at line 2, byte 0: `binary_middle_endian` is no PLY format");
    assert_contains(trace_text("ply\nelement vertex many\nend_header\n"),
                    "at line 2, byte 0: expected the number of vertex elements, found `many`");
    assert_contains(trace_text("ply\nelement vertex -3\nend_header\n"), "at line 2, ");
    assert_contains(trace_text("ply\nelement vertex\nend_header\n"),
                    "at line 2, byte 0: the line ends");
    assert_contains(trace_text("ply\nproperty float x\nend_header\n"), "before the first element");
    assert_contains(trace_text("ply\nelement face 1\nproperty list uchar number vertex_indices\n"),
                    "at line 3, byte 0: `number` is no type");
    assert_contains(
        trace_text("ply\nelement vertex 1\nproperty float x\nproperty float y\nend_header\n1 1\n"),
        "lack x, y or z");
    assert_contains(trace_text("ply\nformat ascii 1.0\nelement vertex 1\n"), "`end_header`");
    assert_contains(trace_bytes("plx\n", 4, "a.ply", DP_FORMAT_AUTO),
                    "expected `ply`, found `plx`");
    assert_contains(trace_text(HEADER("ascii", "4") "end_header\n" SQUARE),
                    "points but no polygons");
    assert_contains(trace_text("ply\nformat ascii 1.0\nend_header\n"), "no polygons");
}

static void broken_ascii_is_told_with_its_line(void **state) {
    (void)state;
    assert_contains(trace_text(HEADER("ascii", "4") FACES("2") SQUARE "3 0 1 2\n3 0 1"),
                    "at line 15, byte 0: the file ends where a vertex number of face 1 of 2");
    assert_contains(trace_text(HEADER("ascii", "4") FACES("1") "0 0 0\n1 0 zero\n"),
                    "at line 11, byte 0: expected a coordinate of vertex 1 of 4, found `zero`");
    assert_contains(trace_text(HEADER("ascii", "3") FACES("1") SQUARE "3 0 1 2\n"),
                    "text behind the last element");
    assert_contains(trace_text(HEADER("ascii", "4") FACES("1") SQUARE "-3 0 1 2\n"),
                    "at line 14, byte 0: a list's length is -3");
    assert_contains(trace_text(HEADER("ascii", "4") FACES("1") SQUARE "3 0 1.5 2\n"),
                    "found `1.5`");
}

/* What headers promise and files do not hold costs neither time nor memory. */
static void huge_counts_end_with_the_file(void **state) {
    bytes file = {.size = 0};
    (void)state;
    assert_contains(trace_text(HEADER("ascii", "999999999999999999") FACES("1") SQUARE "3 0 1 2\n"),
                    "file ends where");
    assert_contains(trace_text(HEADER("ascii", "4") FACES("1") SQUARE "4000000000 0 1 2\n"),
                    "file ends");
    put_text(&file, HEADER("binary_little_endian",
                           "1") "element face 999999999999999999\n"
                                "property list uint uchar vertex_indices\nend_header\n");
    for (int i = 0; i < 3; i++) put_float(&file, 0);
    put(&file, UINT32_MAX, 4);
    put(&file, 0, 8);
    char expected[100];
    snprintf(expected, sizeof expected, "byte %d: the file ends in face 0 of 999999999999999999",
             (int)file.size);
    assert_contains(trace_bytes(file.data, file.size, NULL, DP_FORMAT_AUTO), expected);
    bytes skip = {.size = 0};
    put_text(&skip, "ply\nformat binary_little_endian 1.0\nelement other 1\n"
                    "property list uint double x\nend_header\n");
    put(&skip, UINT32_MAX, 4);
    assert_contains(trace_bytes(skip.data, skip.size, NULL, DP_FORMAT_AUTO),
                    "the file ends in other");
    bytes negative = {.size = 0};
    put_text(&negative, HEADER("binary_little_endian",
                               "0") "element face 1\n"
                                    "property list int int vertex_indices\nend_header\n");
    const size_t offset = negative.size;
    put(&negative, UINT32_MAX, 4);
    snprintf(expected, sizeof expected, "byte %d: a list's length is -1", (int)offset);
    assert_contains(trace_bytes(negative.data, negative.size, NULL, DP_FORMAT_AUTO), expected);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ascii_is_read),
        cmocka_unit_test(lines_may_end_in_any_way),
        cmocka_unit_test(what_is_not_needed_is_passed_over),
        cmocka_unit_test(odd_numbers_stay_for_the_engine),
        cmocka_unit_test(strips_are_triangles),
        cmocka_unit_test(binary_is_read_in_both_orders),
        cmocka_unit_test(binary_content_begins_right_behind_the_header),
        cmocka_unit_test(binary_lists_in_vertices_and_strips),
        cmocka_unit_test(strips_of_unsigned_numbers_begin_anew),
        cmocka_unit_test(broken_headers_are_told),
        cmocka_unit_test(broken_ascii_is_told_with_its_line),
        cmocka_unit_test(huge_counts_end_with_the_file),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
