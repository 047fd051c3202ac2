/* base/json. */
#include "base/json.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static dp_arena arena;
static char *kept[200]; /* texts, as strings lie in them */
static size_t kept_count;

static dp_result parse_result(const char *text, size_t size, const dp_json **out, dp_diag *diag) {
    char *const copy = malloc(size + 1); /* strings lie in it; nothing is read beyond its end */
    memcpy(copy, text, size);
    const dp_result result = dp_json_parse(copy, size, &arena, out, diag);
    if (result) assert_null(*out);
    copy[size] = '!';
    assert_true(kept_count < sizeof kept / sizeof *kept);
    kept[kept_count++] = copy;
    return result;
}

static const dp_json *parse(const char *text) {
    const dp_json *out;
    dp_diag diag = {0};
    if (parse_result(text, strlen(text), &out, &diag)) fail_msg("%s: %s", text, diag.message);
    return out;
}

static void assert_refused(const char *text, const char *word, uint64_t line) {
    const dp_json *out;
    dp_diag diag = {0};
    assert_int_equal(parse_result(text, strlen(text), &out, &diag), DP_ERR_FORMAT);
    if (!strstr(diag.message, word)) fail_msg("%s: %s", text, diag.message);
    assert_int_equal(diag.line, line);
}

static void assert_number(const char *text, double expected) {
    const dp_json *const v = parse(text);
    assert_int_equal(v->kind, DP_JSON_NUMBER);
    const double error = fabs(v->as.number - expected);
    if (!(error <= 4e-16 * fabs(expected))) fail_msg("%s: %.17g", text, v->as.number);
}

static void assert_string(const char *text, const char *expected) {
    const dp_json *const v = parse(text);
    if (!dp_json_is(v, expected))
        fail_msg("%s: %.*s", text, (int)v->as.string.size, v->as.string.text);
}

static void values_are_read(void **state) {
    (void)state;
    const dp_json *const v =
        parse("\xef\xbb\xbf {\"a\": [1, true, null, \"x\"], \"b\":{}, \"a\":2}\n");
    const dp_json *const a = dp_json_find(v, "a");
    assert_int_equal(v->kind, DP_JSON_OBJECT), assert_int_equal(v->count, 3);
    assert_int_equal(dp_json_count(a), 4);
    assert_true(dp_json_item(a, 0)->as.number == 1);
    assert_true(dp_json_item(a, 1)->as.truth);
    assert_int_equal(dp_json_item(a, 2)->kind, DP_JSON_NULL);
    assert_true(dp_json_is(dp_json_item(a, 3), "x"));
    assert_null(dp_json_item(a, 4));
    assert_int_equal(dp_json_find(v, "b")->kind, DP_JSON_OBJECT);
    assert_null(dp_json_find(v, "c")), assert_null(dp_json_find(a, "a"));
    assert_null(dp_json_find(NULL, "a")), assert_null(dp_json_item(NULL, 0));
    assert_int_equal(dp_json_count(v), 0);
    assert_false(parse("false")->as.truth);
}

static void numbers_are_read(void **state) {
    (void)state;
    assert_number("0", 0), assert_number("-12.5", -12.5), assert_number("1e3", 1000);
    assert_number("0.1", 0.1), assert_number("5e-324", 5e-324), assert_number("1E+2", 100);
    assert_number("1.7976931348623157e308", 1.7976931348623157e308);
    assert_number("123456789012345678901234567890", 123456789012345678901234567890.0);
    assert_number("0.00000000000000000000000012345678901234567890123", 1.2345678901234568e-25);
    assert_number("1e-99999999999999999999", 0), assert_number("0e99999999999", 0);
    assert_true(parse("0.1")->as.number == 0.1 && parse("3.14159")->as.number == 3.14159);
    assert_true(signbit(parse("-0")->as.number));
}

static void strings_are_read(void **state) {
    (void)state;
    assert_string("\"\"", "");
    assert_string("\"a\\\"\\\\\\/\\n\\u0041\"", "a\"\\/\nA");
    assert_string("\"\\u00e9\\u20ac\\ud83d\\ude00\"", "\xc3\xa9\xe2\x82\xac\xf0\x9f\x98\x80");
    assert_string("\"\\ud83dx\\ude00\"", "\xef\xbf\xbdx\xef\xbf\xbd");
    assert_string("\"\\ud83d\\u0041\"", "\xef\xbf\xbd"
                                        "A");
    assert_true(dp_json_find(parse("{\"\\u0061b\": 1}"), "ab") != NULL);
}

static void what_is_not_json_is_refused(void **state) {
    (void)state;
    assert_refused("", "expected a value, but the JSON text ends", 1);
    assert_refused("{\n\"a\" 1}", "expected ':', found '1'", 2);
    assert_refused("[1,\n\n]", "expected a value, found ']'", 3);
    assert_refused("[1 2]", "',' or ']'", 1);
    assert_refused("{\"a\":1,}", "a string", 1);
    assert_refused("[1] x", "the end of the JSON text, found 'x'", 1);
    assert_refused("tru", "a value", 1), assert_refused("NaN", "a value", 1);
    assert_refused("01", "the end", 1), assert_refused("-", "a digit", 1);
    assert_refused("1.", "a digit", 1), assert_refused(".5", "a value", 1);
    assert_refused("1e", "an exponent's digit", 1), assert_refused("1e999", "1.8e308", 1);
    assert_refused("\"a", "the string's end", 1), assert_refused("\"\\", "the string's end", 1);
    assert_refused("\"\x01\"", "found byte 0x01", 1), assert_refused("\"\\x\"", "an escape", 1);
    assert_refused("\"\\u12g4\"", "hexadecimal", 1), assert_refused("[", "a value", 1);
    assert_refused("\"\\u12\"", "hexadecimal", 1), assert_refused("/* */1", "a value", 1);
}

static void depth_is_bounded(void **state) {
    (void)state;
    static char deep[1000];
    const dp_json *out;
    dp_diag diag = {0};
    memset(deep, '[', 500);
    assert_int_equal(parse_result(deep, 500, &out, &diag), DP_ERR_LIMIT);
    memset(deep, '[', 200), memset(deep + 200, ']', 200);
    assert_int_equal(parse_result(deep, 400, &out, &diag), DP_OK);
}

static void *none(size_t size, void *user) {
    long *const left = user;
    return --*left < 0 ? NULL : malloc(size);
}
static void *no_more(void *block, size_t size, void *user) {
    long *const left = user;
    return --*left < 0 ? NULL : realloc(block, size);
}
static void give_back(void *block, void *user) {
    (void)user;
    free(block);
}

static void memory_may_run_out(void **state) {
    (void)state;
    static const char text[] = "{\"a\": [1, [2, \"\\n\"], {\"b\": 3}]}";
    for (long have = 0;; have++) {
        long left = have;
        dp_arena small = {.memory = {none, no_more, give_back, &left}};
        const dp_json *out;
        dp_diag diag;
        const dp_result result = dp_json_parse(text, sizeof text - 1, &small, &out, &diag);
        dp_arena_free(&small);
        if (!result) break;
        assert_int_equal(result, DP_ERR_MEMORY);
    }
}

int main(void) {
    arena = (dp_arena){.memory = dp_allocator_resolve(NULL)};
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_are_read),  cmocka_unit_test(numbers_are_read),
        cmocka_unit_test(strings_are_read), cmocka_unit_test(what_is_not_json_is_refused),
        cmocka_unit_test(depth_is_bounded), cmocka_unit_test(memory_may_run_out),
    };
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    dp_arena_free(&arena);
    while (kept_count) free(kept[--kept_count]);
    return failed;
}
