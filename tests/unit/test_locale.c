/* base/print, files and messages are the same under a locale with a decimal comma. Skipped, with a
 * message, if there is no such locale and none can be made. */
#define _XOPEN_SOURCE 700 /* mkdtemp */
#include "base/print.h"
#include "temporary.h"

#include <drypoint/drypoint.h>
#include <drypoint/io.h>

#include <errno.h>
#include <locale.h>
#include <math.h>
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

static char directory[80];

static int enter_directory(void **state) {
    (void)state;
    temporary_name(directory, sizeof directory, "locale");
    return mkdtemp(directory) ? 0 : -1;
}

static int leave_directory(void **state) {
    char command[128];
    (void)state;
    snprintf(command, sizeof command, "rm -rf %s", directory);
    return system(command);
}

static bool has_comma(void) { return strcmp(localeconv()->decimal_point, ",") == 0; }

/* One that is there, or else one that localedef makes of what the package "locales" holds. */
static bool take_comma_locale(void) {
    static const char *const names[] = {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "de_DE",
                                        "fr_FR"};
    char command[256];
    for (size_t k = 0; k < sizeof names / sizeof *names; k++)
        if (setlocale(LC_ALL, names[k]) && has_comma()) return true;
    snprintf(command, sizeof command, "localedef -i de_DE -f UTF-8 %s/de_DE.UTF-8 >/dev/null 2>&1",
             directory);
    if (system(command) != 0 || setenv("LOCPATH", directory, 1)) return false;
    return setlocale(LC_ALL, "de_DE.UTF-8") && has_comma();
}

enum { NUMBERS = 20000 };

/* All kinds of floats; what printf makes of them in the C locale is the truth. */
static float number_of(uint32_t i) {
    static const float special[] = {0, -0.0f, 0.5f, 1e-45f, 3.4e38f, -123456.789f, 1e10f};
    const uint32_t bits = i * 2654435761u;
    float value;
    memcpy(&value, &bits, sizeof value);
    return i < sizeof special / sizeof *special ? special[i] : value;
}

static void numbers_are_those_of_the_c_locale(void **state) {
    static char expected[NUMBERS][2][DP_NUMBER_TEXT];
    (void)state;
    for (uint32_t i = 0; i < NUMBERS; i++)
        for (int k = 0; k < 2; k++) {
            char text[DP_NUMBER_TEXT];
            snprintf(expected[i][k], sizeof *expected[i], "%.*g", k ? 17 : 9, (double)number_of(i));
            assert_string_equal(dp_print_number(text, number_of(i), k ? 17 : 9), expected[i][k]);
        }
    if (!take_comma_locale()) {
        print_message("no locale with a decimal comma: skipped\n");
        skip();
    }
    char text[DP_NUMBER_TEXT];
    snprintf(text, sizeof text, "%g", 0.5);
    assert_string_equal(text, "0,5");
    for (uint32_t i = 0; i < NUMBERS; i++)
        for (int k = 0; k < 2; k++)
            assert_string_equal(dp_print_number(text, number_of(i), k ? 17 : 9), expected[i][k]);
}

typedef struct text {
    char bytes[1 << 18];
    size_t size;
} content;

static void write_model(dp_mesh_file kind, const char *path, content *out) {
    dp_source *source = NULL;
    const dp_shape shape = {.name = "torus", .triangles = 600};
    assert_int_equal(dp_source_from_shape(&shape, &source, NULL), DP_OK);
    assert_int_equal(dp_io_write_mesh(path, kind, source, NULL, NULL, NULL), DP_OK);
    dp_source_destroy(source);
    FILE *const file = fopen(path, "rb");
    assert_non_null(file);
    out->size = fread(out->bytes, 1, sizeof out->bytes, file);
    fclose(file);
    assert_true(out->size > 1000 && out->size < sizeof out->bytes);
}

static void models_are_written_and_read_alike(void **state) {
    static const dp_mesh_file kinds[] = {DP_MESH_FILE_OBJ, DP_MESH_FILE_PLY_ASCII, DP_MESH_FILE_PLY,
                                         DP_MESH_FILE_STL};
    static content before[4], after;
    static dp_extent expected[4];
    char path[96];
    (void)state;
    snprintf(path, sizeof path, "%s/model", directory);
    for (int pass = 0; pass < 2; pass++) {
        if (pass && !take_comma_locale()) {
            print_message("no locale with a decimal comma: skipped\n");
            skip();
        }
        for (int k = 0; k < 4; k++) {
            dp_extent extent;
            dp_source *source = NULL;
            dp_diag diag = {0};
            write_model(kinds[k], path, pass ? &after : &before[k]);
            if (dp_io_open(path, NULL, &source, &diag)) fail_msg("kind %d: %s", k, diag.message);
            assert_int_equal(dp_source_extent(source, &extent, NULL), DP_OK);
            dp_source_destroy(source);
            if (!pass) expected[k] = extent;
            if (!pass) continue;
            assert_int_equal(after.size, before[k].size);
            assert_memory_equal(after.bytes, before[k].bytes, after.size);
            assert_memory_equal(extent.min, expected[k].min, sizeof extent.min);
            assert_memory_equal(extent.max, expected[k].max, sizeof extent.max);
        }
    }
}

static void messages_have_points(void **state) {
    dp_diag diag = {0};
    const dp_style thin = {.line = {[DP_LINE_RIDGE] = {.width = 0.25f}}};
    (void)state;
    if (!take_comma_locale()) {
        print_message("no locale with a decimal comma: skipped\n");
        skip();
    }
    assert_int_equal(dp_style_resolve(&thin, NULL, &diag), DP_ERR_ARGUMENT);
    dp_style resolved;
    assert_int_equal(dp_style_resolve(&thin, &resolved, &diag), DP_ERR_ARGUMENT);
    assert_string_equal(diag.message, "the ridge width is 0.25 px; it must be 0.5 to 64");
}

static void errors_have_their_words(void **state) {
    static const int codes[] = {0, ENOENT, EACCES, ENOSPC, EISDIR, EINVAL};
    char text[DP_ERROR_TEXT];
    (void)state;
    for (size_t k = 0; k < sizeof codes / sizeof *codes; k++)
        assert_string_equal(dp_print_error(text, codes[k]), strerror(codes[k]));
    assert_true(*dp_print_error(text, 123456));
}

/* Each thread has its own number for an error, which nobody else's words may replace. */
static void *print_errors(void *arg) {
    const int code = *(const int *)arg;
    char number[16];
    snprintf(number, sizeof number, "%d", code);
    for (int i = 0; i < 20000; i++)
        if (!strstr(dp_print_error((char[DP_ERROR_TEXT]){0}, code), number)) return arg;
    return NULL;
}

static void errors_are_each_threads_own(void **state) {
    enum { THREADS = 4 };
    int codes[THREADS];
    pthread_t threads[THREADS];
    (void)state;
    for (int i = 0; i < THREADS; i++) {
        codes[i] = 100001 + 11111 * i;
        assert_int_equal(pthread_create(&threads[i], NULL, print_errors, &codes[i]), 0);
    }
    for (int i = 0; i < THREADS; i++) {
        void *wrong;
        assert_int_equal(pthread_join(threads[i], &wrong), 0);
        assert_null(wrong);
    }
}

static int leave_locale(void **state) {
    (void)state;
    return setlocale(LC_ALL, "C") ? 0 : -1;
}

#define TEST(name) cmocka_unit_test_teardown(name, leave_locale)

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(numbers_are_those_of_the_c_locale),
        TEST(models_are_written_and_read_alike),
        TEST(messages_have_points),
        TEST(errors_have_their_words),
        TEST(errors_are_each_threads_own),
    };
    return cmocka_run_group_tests(tests, enter_directory, leave_directory);
}
