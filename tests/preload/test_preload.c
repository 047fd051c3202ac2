/* test_preload.c: runs scene.c with and without libdrypoint-preload.so, and looks at what its window shows.
 *
 * Lines have inks of their own by kind, and the bracket's edges are known: each must be inked in its kind's, and
 * nothing else may be inked at all. DISPLAY is an X server that run.sh starts. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "bracket.h"

#define INKS                                                                                       \
    "DRYPOINT_SILHOUETTE_INK=#ff0000 DRYPOINT_RIDGE_INK=#00c000 DRYPOINT_VALLEY_INK=#0000ff "

struct picture {
    unsigned char pixels[PICTURE][PICTURE][3];
};

struct result {
    struct picture picture;
    char said[65536];    /* on stdout */
    char messages[4096]; /* on stderr */
};

enum kind { SILHOUETTE, RIDGE, VALLEY };
static const unsigned char inks[3][3] = {{255, 0, 0}, {0, 192, 0}, {0, 0, 255}};

static const struct edge {
    enum kind kind;
    float from[3], to[3];
} edges[] = {
    {SILHOUETTE, {1, 3, 0}, {0, 3, 0}}, {SILHOUETTE, {0, 3, 0}, {0, 3, 2}},
    {SILHOUETTE, {0, 3, 2}, {0, 0, 2}}, {SILHOUETTE, {0, 0, 2}, {3, 0, 2}},
    {SILHOUETTE, {3, 0, 2}, {3, 0, 0}}, {SILHOUETTE, {3, 0, 0}, {3, 1, 0}},
    {SILHOUETTE, {3, 1, 0}, {1, 1, 0}}, {SILHOUETTE, {1, 1, 0}, {1, 3, 0}},
    {RIDGE, {3, 0, 2}, {3, 1, 2}},      {RIDGE, {3, 1, 2}, {1, 1, 2}},
    {RIDGE, {1, 1, 2}, {1, 3, 2}},      {RIDGE, {1, 3, 2}, {0, 3, 2}},
    {RIDGE, {3, 1, 2}, {3, 1, 0}},      {RIDGE, {1, 3, 2}, {1, 3, 0}},
    {VALLEY, {1, 1, 2}, {1, 1, 0}},
};
enum { EDGES = sizeof edges / sizeof edges[0], ALL_KINDS = 7 };

/* ---- running ---- */

static void read_text(const char *path, char *text, size_t room) {
    FILE *const file = fopen(path, "r");
    assert_non_null(file);
    text[fread(text, 1, room - 1, file)] = '\0';
    fclose(file);
}

/* A scene under these environment variables; NULL: without the library. */
static void run(struct result *result, const char *scene, const char *variables, int frames) {
    char base[] = "/tmp/preload-XXXXXX", command[2048], path[64];
    const int made = mkstemp(base);
    assert_true(made >= 0);
    close(made);
    snprintf(command, sizeof command, "env %s%s%s %s %s %s.ppm %d >%s 2>%s.err",
             variables ? "LD_PRELOAD=" : "", variables ? DP_PRELOAD " " : "",
             variables ? variables : "", DP_SCENE, scene, base, frames, base, base);
    const int status = system(command);
    memset(result, 0, sizeof *result);
    read_text(base, result->said, sizeof result->said);
    snprintf(path, sizeof path, "%s.err", base);
    read_text(path, result->messages, sizeof result->messages);
    unlink(path);
    snprintf(path, sizeof path, "%s.ppm", base);
    FILE *const file = fopen(path, "rb");
    size_t bytes = 0;
    if (file && fscanf(file, "P6 %*d %*d %*d") == 0 && fgetc(file) == '\n')
        bytes = fread(&result->picture, 1, sizeof result->picture, file);
    if (file) fclose(file);
    unlink(path);
    unlink(base);
    if (status != 0) fail_msg("%s: status %d: %s", command, status, result->messages);
    assert_int_equal(bytes, sizeof result->picture);
}

/* ---- looking ---- */

static float distance_to_color(const unsigned char *pixel, const unsigned char *color) {
    float sum = 0;
    for (int i = 0; i < 3; i++) sum += (float)((pixel[i] - color[i]) * (pixel[i] - color[i]));
    return sqrtf(sum);
}

static const unsigned char *pixel_at(const struct picture *picture, const float window[2]) {
    const int x = (int)window[0], y = PICTURE - 1 - (int)window[1];
    assert_in_range(x, 0, PICTURE - 1);
    assert_in_range(y, 0, PICTURE - 1);
    return picture->pixels[y][x];
}

/* How many of 40 places along an edge look like its ink. */
static int inked(const struct picture *picture, const struct edge *edge, const unsigned char *ink) {
    static const unsigned char paper[3] = {255, 255, 255};
    int count = 0;
    for (int i = 0; i < 40; i++) {
        float p[3], window[2];
        const float t = 0.06f + 0.88f * (float)i / 39;
        for (int k = 0; k < 3; k++) p[k] = edge->from[k] + t * (edge->to[k] - edge->from[k]);
        bracket_project(p, window);
        const unsigned char *const pixel = pixel_at(picture, window);
        count += distance_to_color(pixel, ink) < distance_to_color(pixel, paper);
    }
    return count;
}

static float distance_to_edge(const struct edge *edge, float x, float y) {
    float a[2], b[2];
    bracket_project(edge->from, a);
    bracket_project(edge->to, b);
    const float dx = b[0] - a[0], dy = b[1] - a[1];
    const float t = ((x - a[0]) * dx + (y - a[1]) * dy) / (dx * dx + dy * dy);
    const float s = t < 0 ? 0 : t > 1 ? 1 : t;
    return hypotf(x - a[0] - s * dx, y - a[1] - s * dy);
}

/* Is a pixel at most so far from an edge of one of these kinds (bits)? */
static bool is_near(int x, int y, unsigned kinds, float px) {
    for (int i = 0; i < EDGES; i++)
        if ((kinds >> edges[i].kind & 1) &&
            distance_to_edge(&edges[i], (float)x + 0.5f, (float)(PICTURE - 1 - y) + 0.5f) <= px)
            return true;
    return false;
}

/* Edges of these kinds have lines, and (if pure) nothing else has. */
static void check_lines(const char *scene, const struct picture *picture, unsigned kinds,
                        bool pure) {
    for (int i = 0; i < EDGES; i++) {
        if (!(kinds >> edges[i].kind & 1)) continue;
        const int count = inked(picture, &edges[i], inks[edges[i].kind]);
        if (count < 39) fail_msg("%s: edge %d has ink at %d of 40 places", scene, i, count);
    }
    for (int y = 0; y < PICTURE && pure; y++)
        for (int x = 0; x < PICTURE; x++) {
            const unsigned char *const p = picture->pixels[y][x];
            if ((p[0] & p[1] & p[2]) != 255 && !is_near(x, y, kinds, 2.2f))
                fail_msg("%s: ink at %d, %d, far from all edges", scene, x, y);
        }
}

static int count_ink(const struct picture *picture) {
    int count = 0;
    for (int y = 0; y < PICTURE; y++)
        for (int x = 0; x < PICTURE; x++) count += picture->pixels[y][x][1] < 128;
    return count;
}

static int count_black(const struct picture *picture) {
    int count = 0;
    for (int y = 0; y < PICTURE; y++)
        for (int x = 0; x < PICTURE; x++) {
            const unsigned char *const p = picture->pixels[y][x];
            count += p[0] < 16 && p[1] < 16 && p[2] < 16;
        }
    return count;
}

/* Each message once, however many frames there were. */
static void assert_says_once(const char *messages, const char *text) {
    const char *const at = strstr(messages, text);
    if (!at || strstr(at + 1, text)) fail_msg("not once \"%s\" in:\n%s", text, messages);
}

/* ---- tests ---- */

/* However the polygons come to GL. */
static void test_lines(void **state) {
    static const char *const scenes[] = {"begin",    "strips",  "list",       "arrays",
                                         "elements", "buffers", "inside-out", "contexts"};
    struct result result;
    (void)state;
    for (size_t i = 0; i < sizeof scenes / sizeof scenes[0]; i++) {
        run(&result, scenes[i], INKS "DRYPOINT_LINES=1", 1);
        check_lines(scenes[i], &result.picture, ALL_KINDS, true);
        assert_string_equal(result.messages, "");
    }
}

/* A list that is compiled and executed at once keeps its colours. */
static void test_nested_lists(void **state) {
    struct result result;
    (void)state;
    run(&result, "nested", INKS "DRYPOINT_LINES=1", 2);
    check_lines("nested", &result.picture, ALL_KINDS, false);
}

static void test_kinds(void **state) {
    static const char *const names[] = {"silhouette", "", "valley"};
    struct result result;
    (void)state;
    for (int kind = 0; kind < 3; kind += 2) {
        char variables[256];
        snprintf(variables, sizeof variables, INKS "DRYPOINT_LINES=%s", names[kind]);
        run(&result, "begin", variables, 1);
        check_lines(names[kind], &result.picture, 1u << kind, true);
    }
    run(&result, "begin", INKS "DRYPOINT_LINES=ridge,valley", 1);
    check_lines("ridge,valley", &result.picture, 1u << RIDGE | 1u << VALLEY, false);
}

/* A right angle is no ridge below 90 degrees, and no valley above 270. */
static void test_angles(void **state) {
    struct result result;
    (void)state;
    run(&result, "begin", INKS "DRYPOINT_LINES=1 DRYPOINT_RIDGE_ANGLE=80 DRYPOINT_VALLEY_ANGLE=280",
        1);
    check_lines("angles", &result.picture, 1u << SILHOUETTE, true);
}

static void test_width(void **state) {
    struct result thin, wide;
    (void)state;
    run(&thin, "begin", "DRYPOINT_LINES=1 DRYPOINT_WIDTH=2", 1);
    run(&wide, "begin", "DRYPOINT_LINES=1 DRYPOINT_WIDTH=6", 1);
    const double ratio = (double)count_ink(&wide.picture) / count_ink(&thin.picture);
    if (ratio < 2.6 || ratio > 3.2) fail_msg("three times the width, %g times the ink", ratio);
}

/* Figure 3: without the library an unknown capability; with it lines, on the program's own picture. */
static void test_asking(void **state) {
    struct result plain, lined;
    (void)state;
    run(&plain, "asking", NULL, 1);
    assert_string_equal(plain.said, "asked: error 0x500, enabled 0\n");
    run(&lined, "asking", "", 1);
    assert_string_equal(lined.said, "asked: error 0x0, enabled 1\n");
    assert_string_equal(lined.messages, "");
    static const unsigned char black[3] = {0, 0, 0};
    for (int i = 0; i < EDGES; i++)
        if (inked(&lined.picture, &edges[i], black) < 39) fail_msg("edge %d has no line", i);
    assert_int_equal(count_black(&plain.picture), 0);
    assert_true(count_black(&lined.picture) > 400);
    for (int y = 0; y < PICTURE; y++)
        for (int x = 0; x < PICTURE; x++)
            if (!is_near(x, y, ALL_KINDS, 2.2f))
                assert_memory_equal(plain.picture.pixels[y][x], lined.picture.pixels[y][x], 3);
}

/* Who does not ask, and whom nobody asks for, is left alone. */
static void test_not_asked(void **state) {
    struct result plain, loaded;
    (void)state;
    run(&plain, "begin", NULL, 1);
    run(&loaded, "begin", "DRYPOINT_LINES=0", 1);
    assert_memory_equal(&plain.picture, &loaded.picture, sizeof plain.picture);
}

static void test_untouched(void **state) {
    struct result plain, loaded;
    (void)state;
    run(&plain, "untouched", NULL, 3);
    run(&loaded, "untouched", "DRYPOINT_LINES=1", 3);
    assert_memory_equal(&plain.picture, &loaded.picture, sizeof plain.picture);
    assert_true(count_ink(&plain.picture) > 500);
    assert_says_once(loaded.messages, "drypoint: textured polygons are left");
    assert_says_once(loaded.messages, "drypoint: blended polygons are left");
    assert_says_once(loaded.messages, "own shaders is left");
}

/* They get lines where that is wanted. */
static void test_also(void **state) {
    struct result plain, also;
    (void)state;
    run(&plain, "untouched", NULL, 1);
    run(&also, "untouched", "DRYPOINT_LINES=1 DRYPOINT_ALSO=textured,blended", 1);
    assert_memory_not_equal(&plain.picture, &also.picture, sizeof plain.picture);
    assert_null(strstr(also.messages, "polygons are left"));
}

/* GL's state after the lines is what the program made it. */
static void test_state(void **state) {
    struct result plain, loaded;
    (void)state;
    run(&plain, "state", NULL, 2);
    run(&loaded, "state", "DRYPOINT_LINES=1", 2);
    assert_true(strlen(plain.said) > 10000);
    assert_string_equal(plain.said, loaded.said);
}

/* Wrong calls give GL's errors, and the bracket afterwards has its lines. */
static void test_wild(void **state) {
    struct result plain, loaded;
    (void)state;
    run(&plain, "wild", NULL, 2);
    run(&loaded, "wild", INKS "DRYPOINT_LINES=1", 2);
    assert_string_equal(plain.said, loaded.said);
    check_lines("wild", &loaded.picture, ALL_KINDS, true);
}

static void test_bad_variables(void **state) {
    struct result result;
    (void)state;
    run(&result, "begin",
        INKS "DRYPOINT_LINES=1 DRYPOINT_WIDTH=thick DRYPOINT_PAPER=white DRYPOINT_ALSO=all "
             "DRYPOINT_RIDGE_ANGLE=200 DRYPOINT_SHADED=perhaps",
        2);
    check_lines("bad variables", &result.picture, ALL_KINDS, true);
    assert_says_once(result.messages, "DRYPOINT_WIDTH=thick: want a number from");
    assert_says_once(result.messages, "DRYPOINT_PAPER=white: want a colour");
    assert_says_once(result.messages, "DRYPOINT_ALSO=all: want");
    assert_says_once(result.messages, "DRYPOINT_RIDGE_ANGLE=200: want");
    assert_says_once(result.messages, "DRYPOINT_SHADED=perhaps: want");
}

/* A context without geometry shaders: said once, and the picture is the program's. */
static void test_old_context(void **state) {
    struct result plain, loaded;
    (void)state;
    run(&plain, "begin", NULL, 2);
    run(&loaded, "begin", "MESA_GL_VERSION_OVERRIDE=2.1 DRYPOINT_LINES=1", 2);
    if (!strstr(loaded.messages, "OpenGL 3.2")) skip(); /* not Mesa */
    assert_says_once(loaded.messages, "no lines: they need OpenGL 3.2");
    assert_memory_equal(&plain.picture, &loaded.picture, sizeof plain.picture);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_lines),       cmocka_unit_test(test_nested_lists),
        cmocka_unit_test(test_kinds),       cmocka_unit_test(test_angles),
        cmocka_unit_test(test_width),       cmocka_unit_test(test_asking),
        cmocka_unit_test(test_not_asked),   cmocka_unit_test(test_untouched),
        cmocka_unit_test(test_also),        cmocka_unit_test(test_state),
        cmocka_unit_test(test_wild),        cmocka_unit_test(test_bad_variables),
        cmocka_unit_test(test_old_context),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
