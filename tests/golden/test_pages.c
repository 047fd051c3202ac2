/* Pages in every format, byte by byte as they are kept in golden/pages: an empty one, a picture as the
 * program writes it, and one that has all there is. PDF is not compressed here, so nothing depends on
 * zlib. DP_GOLDEN_WRITE=1 writes those that are missing; golden/pages.py shows whether other
 * programs like them. */
#include "unit/page_scene.h"

#include <locale.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

static uint8_t *read_file(const char *path, size_t *size) {
    FILE *const file = fopen(path, "rb");
    if (!file) return NULL;
    assert_int_equal(fseek(file, 0, SEEK_END), 0);
    *size = (size_t)ftell(file);
    rewind(file);
    uint8_t *const bytes = malloc(*size + 1);
    assert_non_null(bytes);
    assert_int_equal(fread(bytes, 1, *size, file), *size);
    fclose(file);
    return bytes;
}

static void write_file(const char *path, const void *bytes, size_t size) {
    FILE *const file = fopen(path, "wb");
    if (!file) fail_msg("cannot write %s", path);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
    print_message("wrote %s\n", path);
}

/* Where they differ, with some of the text before. */
static void report(const char *path, const char *written, size_t size, const uint8_t *kept,
                   size_t kept_size) {
    size_t at = 0;
    while (at < size && at < kept_size && (uint8_t)written[at] == kept[at]) at++;
    const size_t from = at > 60 ? at - 60 : 0;
    fail_msg("%s: %zu bytes, kept are %zu; they differ from %zu on:\n...%.*s\nkept: ...%.*s", path,
             size, kept_size, at, (int)(size - from < 120 ? size - from : 120), written + from,
             (int)(kept_size - from < 120 ? kept_size - from : 120), (const char *)kept + from);
}

static void check_page(const dp_page *page, const char *name) {
    for (int f = 0; f < DP_FORMAT_COUNT; f++) {
        char path[512];
        void *written = NULL;
        size_t size = 0, kept_size = 0;
        dp_diag diag = {0};
        snprintf(path, sizeof path, "%s/golden/pages/%s.%s", DP_TESTS_DIR, name,
                 dp_format_name((dp_format)f));
        if (dp_page_write_memory(page, (dp_format)f, &written, &size, &diag))
            fail_msg("%s: %s", path, diag.message);
        uint8_t *const kept = read_file(path, &kept_size);
        if (kept && (size != kept_size || memcmp(kept, written, size)))
            report(path, written, size, kept, kept_size);
        if (!kept && !getenv("DP_GOLDEN_WRITE")) fail_msg("%s is not there", path);
        if (!kept) write_file(path, written, size);
        free(kept);
        dp_bytes_free(written);
    }
}

static void an_empty_page(void **state) {
    (void)state;
    check_page(&(dp_page){.width = 20, .height = 10}, "empty");
}

static void a_picture(void **state) {
    (void)state;
    static page_scene scene;
    check_page(scene_make(&scene, false), "picture");
}

static void a_page_with_all_there_is(void **state) {
    (void)state;
    static page_scene scene;
    setlocale(LC_ALL, ""); /* may have a decimal comma; bytes do not depend on it */
    check_page(scene_make(&scene, true), "sheet");
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(an_empty_page), cmocka_unit_test(a_picture),
                                       cmocka_unit_test(a_page_with_all_there_is)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
