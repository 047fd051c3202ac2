/* What pages are written with: names and numbers as formats want them, bytes as text, and letters. */
#include "vector/font.h"
#include "vector/out.h"
#include "vector/packed.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static struct {
    char bytes[1 << 16];
    size_t size;
} paper;

static dp_result keep(void *user, const char *text, size_t size, dp_diag *diag) {
    (void)user;
    (void)diag;
    assert_true(paper.size + size < sizeof paper.bytes);
    memcpy(paper.bytes + paper.size, text, size);
    paper.bytes[paper.size += size] = 0;
    return DP_OK;
}

/* ------- names and numbers ------- */

typedef void putter(dp_out *out, const char *text);

static void assert_put(putter *put, const char *text, const char *expected) {
    dp_out out = {.write = keep};
    paper.size = 0;
    put(&out, text);
    dp_put_flush(&out);
    assert_string_equal(paper.bytes, expected);
    assert_int_equal(out.put, strlen(expected));
}

static void names_are_escaped(void **state) {
    (void)state;
    assert_put(dp_put_xml, "a<b> & \"c\" \xC3\xBC\xE2\x82\xAC\xF0\x9F\x99\x82",
               "a&lt;b&gt; &amp; &quot;c&quot; \xC3\xBC\xE2\x82\xAC\xF0\x9F\x99\x82");
    /* bytes that begin nothing, overlong, surrogates, cut off, no character of XML */
    assert_put(dp_put_xml, "\x80", "\xEF\xBF\xBD");
    assert_put(dp_put_xml, "\xC0\x80|", "\xEF\xBF\xBD\xEF\xBF\xBD|");
    assert_put(dp_put_xml, "\xED\xA0\x80|", "\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD|");
    assert_put(dp_put_xml, "\xE2\x82", "\xEF\xBF\xBD\xEF\xBF\xBD");
    assert_put(dp_put_xml, "\xF5\x80|", "\xEF\xBF\xBD\xEF\xBF\xBD|");
    assert_put(dp_put_xml, "\x01\t\xEF\xBF\xBF", "\xEF\xBF\xBD\t\xEF\xBF\xBD");
    assert_put(dp_put_json, "a\"b\\c\n\xC3\xBC\xFF", "\"a\\\"b\\\\c\\u000A\xC3\xBC\xEF\xBF\xBD\"");
    assert_put(dp_put_json, NULL, "null");
    assert_put(dp_put_pdf, "a(b)\\", "(a\\(b\\)\\\\)");
    assert_put(dp_put_pdf, "\xC3\xBC\xF0\x9F\x99\x82", "<FEFF00FCD83DDE42>");
    assert_put(dp_put_postscript, "a)\xC3\xBC\n",
               "(a\\)?"
               "?)");
    assert_put(dp_put_ascii, "a\xE2\x82\xAC\n", "a??");
}

static void assert_number(void (*put)(dp_out *out, int64_t thousandths), int64_t value,
                          const char *expected) {
    dp_out out = {.write = keep};
    paper.size = 0;
    put(&out, value);
    dp_put_flush(&out);
    assert_string_equal(paper.bytes, expected);
}

static void numbers_are_short(void **state) {
    (void)state;
    assert_number(dp_put_fixed, 0, "0");
    assert_number(dp_put_fixed, 1000, "1");
    assert_number(dp_put_fixed, -1, "-0.001");
    assert_number(dp_put_fixed, 120500, "120.5");
    assert_number(dp_put_short, -250, "-.25");
    assert_number(dp_put_short, 10, ".01");
    assert_number(dp_put_short, 0, "0");
    assert_number(dp_put_fixed, INT64_MIN, "-9223372036854775.808");
    assert_int_equal(dp_fixed(0.0005), 1);
    assert_int_equal(dp_fixed(-0.0004), 0);
    assert_int_equal(dp_fixed(-1.5), -1500);
    assert_int_equal(dp_fixed(1e300), DP_FIXED_MOST);
    assert_int_equal(dp_fixed(-1e300), -DP_FIXED_MOST);
    assert_int_equal(dp_fixed(NAN), -DP_FIXED_MOST);
    dp_out out = {.write = keep};
    paper.size = 0;
    dp_put_number(&out, 0.264583333, 6);
    dp_put_char(&out, ' ');
    dp_put_number(&out, -2, 9);
    dp_put_char(&out, ' ');
    dp_put_padded(&out, 42, 10);
    dp_put_char(&out, ' ');
    dp_put_digits(&out, NAN, 9);
    dp_put_flush(&out);
    assert_string_equal(paper.bytes, "0.264583 -2 0000000042 null");
}

static void bytes_become_base64(void **state) {
    (void)state;
    static const char *const texts[] = {"", "TQ==", "TWE=", "TWFu", "TWFuTQ=="};
    static const size_t sizes[] = {0, 1, 2, 3, 4};
    for (size_t i = 1; i < sizeof texts / sizeof *texts; i++) {
        dp_out out = {.write = keep};
        paper.size = 0;
        dp_put_base64(&out, (const uint8_t *)"ManM", sizes[i]);
        dp_put_flush(&out);
        assert_string_equal(paper.bytes, texts[i]);
    }
}

/* ASCII85 and runs back to bytes, by the book. */
static size_t unpack(const char *text, uint8_t *bytes) {
    static uint8_t packed[1 << 16];
    size_t size = 0, count = 0, at = 0;
    uint32_t four = 0;
    int digits = 0;
    for (; *text != '~'; text++) {
        if (*text == '\n' || *text == ' ') continue;
        if (*text == 'z') {
            memset(packed + size, 0, 4);
            size += 4;
            continue;
        }
        assert_in_range(*text, '!', 'u');
        four = four * 85 + (uint32_t)(*text - '!');
        if (++digits < 5) continue;
        for (int i = 3; i >= 0; i--) packed[size++] = (uint8_t)(four >> 8 * i);
        four = 0, digits = 0;
    }
    const int rest = digits;
    for (; digits && digits < 5; digits++) four = four * 85 + 84;
    for (int i = 0; i < rest - 1; i++) packed[size++] = (uint8_t)(four >> (24 - 8 * i));
    while (packed[at] != 128) {
        const size_t n = packed[at++];
        assert_true(at < size);
        for (size_t i = 0; i < (n < 128 ? n + 1 : 257 - n); i++)
            bytes[count++] = packed[n < 128 ? at + i : at];
        at += n < 128 ? n + 1 : 1;
    }
    assert_int_equal(at + 1, size);
    return count;
}

static void packed_bytes_come_back(void **state) {
    (void)state;
    static uint8_t bytes[3000], back[4000];
    for (uint32_t seed = 1; seed < 40; seed++) {
        uint32_t random = seed * 2654435761u;
        const size_t size = seed < 10 ? seed - 1 : seed * 70;
        for (size_t i = 0; i < size; i++) {
            random = random * 1664525 + 1013904223;
            const bool repeats = i && random >> 16 & (seed % 3 ? 0x7F : 1);
            bytes[i] = repeats ? bytes[i - 1] : (uint8_t)(random >> 24);
        }
        dp_out out = {.write = keep};
        dp_packed packed = {.out = &out};
        paper.size = 0;
        for (size_t i = 0; i < size; i++) dp_packed_put(&packed, bytes[i]);
        dp_packed_end(&packed);
        dp_put_flush(&out);
        assert_int_equal(unpack(paper.bytes, back), size);
        assert_memory_equal(back, bytes, size);
    }
}

/* Readers of comments would take such a line for theirs. 14 literals begin with one. */
static void packed_lines_do_not_begin_with_percent(void **state) {
    (void)state;
    uint8_t back[4000];
    for (size_t size = 1; size < 900; size++) {
        dp_out out = {.write = keep};
        dp_packed packed = {.out = &out};
        paper.size = 0;
        for (size_t i = 0; i < size; i++) dp_packed_put(&packed, (uint8_t)(i % 13));
        dp_packed_end(&packed);
        dp_put_flush(&out);
        assert_true(paper.bytes[0] != '%');
        assert_null(strstr(paper.bytes, "\n%"));
        assert_int_equal(unpack(paper.bytes, back), size);
    }
}

/* ------- letters ------- */

/* Every letter has strokes within its box, and the next one begins beyond them. */
static void letters_lie_in_their_boxes(void **state) {
    (void)state;
    for (uint32_t code = '!'; code < 0x100; code++) {
        if (code == 0x7F) code = 0xA1;
        char text[3] = {(char)code, 0, 0};
        if (code > 0x7F) text[0] = (char)(0xC0 | code >> 6), text[1] = (char)(0x80 | (code & 63));
        double points[DP_LETTER_STROKE_MOST][2], right = 0;
        dp_lettering l = {.rest = text};
        size_t strokes = 0;
        for (size_t n; (n = dp_next_stroke(&l, points)); strokes++) {
            assert_in_range(n, 2, DP_LETTER_STROKE_MOST);
            for (size_t i = 0; i < n; i++) {
                assert_true(points[i][0] >= 0 && points[i][1] >= -3 && points[i][1] <= 13.5);
                right = points[i][0] > right ? points[i][0] : right;
            }
        }
        if (!strokes) fail_msg("U+%04X has no strokes", code);
        if (l.next_x < right + 1) fail_msg("U+%04X is wider than its box", code);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(names_are_escaped),
                                       cmocka_unit_test(numbers_are_short),
                                       cmocka_unit_test(bytes_become_base64),
                                       cmocka_unit_test(packed_bytes_come_back),
                                       cmocka_unit_test(packed_lines_do_not_begin_with_percent),
                                       cmocka_unit_test(letters_lie_in_their_boxes)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
