/* base: result names, diagnostics, growing arrays and their overflow checks. */
#include "base/diag.h"
#include "base/memory.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

static void every_result_has_its_own_name(void **state) {
    (void)state;
    for (int a = DP_OK; a <= DP_ERR_CANCELLED; a++)
        for (int b = a + 1; b <= DP_ERR_CANCELLED + 1; b++)
            assert_string_not_equal(dp_result_name((dp_result)a), dp_result_name((dp_result)b));
    assert_non_null(dp_result_name((dp_result)-1));
}

static void version_is_what_the_macros_say(void **state) {
    (void)state;
    char expected[32];
    snprintf(expected, sizeof expected, "%d.%d.%d", DP_VERSION_MAJOR, DP_VERSION_MINOR,
             DP_VERSION_PATCH);
    assert_string_equal(dp_version(), expected);
}

static void headers_of_another_version_are_told(void **state) {
    (void)state;
    enum { MAJOR = DP_VERSION_MAJOR, MINOR = DP_VERSION_MINOR, PATCH = DP_VERSION_PATCH };
    dp_diag diag = {0};
    assert_int_equal(dp_version_check(&diag), DP_OK);
    assert_int_equal(dp_version_check(NULL), DP_OK);
    assert_string_equal(diag.message, "");
    assert_int_equal(dp_version_check_header(MAJOR, MINOR, PATCH + 1, &diag), DP_OK);
    assert_int_equal(dp_version_check_header(MAJOR + 1, MINOR, PATCH, NULL), DP_ERR_UNSUPPORTED);
    assert_int_equal(dp_version_check_header(MAJOR, MINOR + 90, 7, &diag), DP_ERR_UNSUPPORTED);
    assert_int_equal(diag.result, DP_ERR_UNSUPPORTED);
    char headers[32];
    snprintf(headers, sizeof headers, "drypoint %d.%d.7,", MAJOR, MINOR + 90);
    assert_non_null(strstr(diag.message, headers));
    assert_non_null(strstr(diag.message, dp_version()));
}

static void failing_fills_the_diagnosis(void **state) {
    (void)state;
    dp_diag diag = {.line = 99, .offset = 99, .item = 99};
    assert_int_equal(dp_fail(&diag, DP_ERR_IO, "no %s", "disk"), DP_ERR_IO);
    assert_int_equal(diag.result, DP_ERR_IO);
    assert_int_equal(diag.line + diag.offset + diag.item, 0);
    assert_string_equal(diag.message, "no disk");
    assert_int_equal(dp_fail_line(&diag, DP_ERR_FORMAT, 7, "x"), DP_ERR_FORMAT);
    assert_int_equal(diag.line, 7);
    assert_int_equal(dp_fail_offset(&diag, DP_ERR_FORMAT, 80, "x"), DP_ERR_FORMAT);
    assert_int_equal(diag.offset, 80);
    assert_int_equal(dp_fail(NULL, DP_ERR_LIMIT, "unheard"), DP_ERR_LIMIT);
}

static void a_long_message_is_cut_and_ended(void **state) {
    (void)state;
    char text[1000];
    memset(text, 'x', sizeof text);
    text[sizeof text - 1] = 0;
    dp_diag diag;
    dp_fail(&diag, DP_ERR_IO, "%s", text);
    assert_int_equal(strlen(diag.message), sizeof diag.message - 1);
}

static void arrays_keep_their_items_when_they_grow(void **state) {
    (void)state;
    const dp_allocator memory = dp_allocator_resolve(NULL);
    uint32_t *items = NULL;
    size_t capacity = 0;
    for (size_t i = 0; i < 10000; i++) {
        assert_true(dp_reserve(&memory, &items, &capacity, i + 1, sizeof *items));
        items[i] = (uint32_t)i;
    }
    for (size_t i = 0; i < 10000; i++) assert_int_equal(items[i], i);
    dp_free(&memory, items);
}

static void products_do_not_wrap(void **state) {
    const size_t half = SIZE_MAX / 2 + 1, root = (size_t)1 << 4 * sizeof(size_t);
    (void)state;
    assert_true(dp_times(0, SIZE_MAX) == 0 && dp_times(SIZE_MAX, 0) == 0);
    assert_true(dp_times(SIZE_MAX, 1) == SIZE_MAX && dp_times(1, SIZE_MAX) == SIZE_MAX);
    assert_true(dp_times(3, 5) == 15);
    assert_true(dp_times(half - 1, 2) == SIZE_MAX - 1);
    assert_true(dp_times(half, 2) == SIZE_MAX && dp_times(2, half) == SIZE_MAX);
    assert_true(dp_times(root, root) == SIZE_MAX);
    assert_true(dp_times(root, root - 1) == SIZE_MAX - root + 1);
}

/* An allocator that must not be asked for what no object can be. */
static void *grant(size_t size, void *user) {
    *(size_t *)user = size;
    return NULL;
}
static void *regrant(void *block, size_t size, void *user) {
    (void)block;
    return grant(size, user);
}
static void ungrant(void *block, void *user) { (void)block, (void)user; }

static void no_block_is_larger_than_distances(void **state) {
    (void)state;
    size_t asked = 0, capacity = 0;
    const dp_allocator memory = {grant, regrant, ungrant, &asked};
    char *block = NULL;
    assert_null(dp_alloc(&memory, (size_t)PTRDIFF_MAX + 1));
    assert_null(dp_alloc_zeroed(&memory, SIZE_MAX));
    assert_null(dp_alloc_array(&memory, SIZE_MAX / 4, 3));
    assert_false(dp_reserve(&memory, &block, &capacity, (size_t)PTRDIFF_MAX + 1, 1));
    assert_false(dp_reserve(&memory, &block, &capacity, SIZE_MAX, 16));
    assert_int_equal(asked, 0);
    assert_null(dp_alloc(&memory, PTRDIFF_MAX));
    assert_true(asked == PTRDIFF_MAX);
    capacity = PTRDIFF_MAX - 7; /* there is no room to grow by half, but for what is needed */
    assert_false(dp_reserve(&memory, &block, &capacity, PTRDIFF_MAX - 5, 1));
    assert_true(asked == PTRDIFF_MAX - 5);
}

static void sizes_that_overflow_are_refused(void **state) {
    (void)state;
    const dp_allocator memory = dp_allocator_resolve(NULL);
    assert_null(dp_alloc_array(&memory, SIZE_MAX / 2, 3));
    uint32_t *items = NULL;
    size_t capacity = 0;
    assert_false(dp_reserve(&memory, &items, &capacity, SIZE_MAX / 2, sizeof *items));
    assert_null(items);
    assert_int_equal(capacity, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_result_has_its_own_name),
        cmocka_unit_test(version_is_what_the_macros_say),
        cmocka_unit_test(headers_of_another_version_are_told),
        cmocka_unit_test(failing_fills_the_diagnosis),
        cmocka_unit_test(a_long_message_is_cut_and_ended),
        cmocka_unit_test(arrays_keep_their_items_when_they_grow),
        cmocka_unit_test(products_do_not_wrap),
        cmocka_unit_test(no_block_is_larger_than_distances),
        cmocka_unit_test(sizes_that_overflow_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
