/* Words and numbers from a stream of text, with the number of the current line.
 *
 * Invariant: a word lies wholly in the window when it is read, unless it is longer than
 * DP_STREAM_AHEAD; no number is, so a longer word is not one. Line ends are LF, CR LF or CR. A byte
 * 0 inside the text is part of a word, and makes a bad number. */
#include "io/text.h"

#include "io/number.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static inline bool is_blank(uint8_t byte) {
    return byte == ' ' || byte == '\t' || byte == '\v' || byte == '\f';
}
static inline bool is_line_end(uint8_t byte) { return byte == '\n' || byte == '\r'; }
static inline bool ends_word(uint8_t byte) { return is_blank(byte) || is_line_end(byte); }

/* Bytes of a backslash and the line end after it; 0 if there is none. */
static size_t continuation(const uint8_t *p) {
    if (p[0] != '\\') return 0;
    if (p[1] == '\r' && p[2] == '\n') return 3;
    return is_line_end(p[1]) ? 2 : 0;
}

/* Skips the line end at p. The window holds the LF of a CR LF. */
static inline const uint8_t *pass_line_end(dp_stream *stream, const uint8_t *p) {
    stream->line += p[0] == '\n' || p[1] != '\n';
    return p + 1;
}

bool dp_text_space_slow(dp_stream *stream) {
    for (;;) {
        const uint8_t *p = stream->cursor;
        while (p < stream->limit) {
            if (is_blank(*p))
                p++;
            else if (is_line_end(*p))
                p = pass_line_end(stream, p);
            else
                break;
        }
        stream->cursor = p;
        if (p < stream->limit) return true;
        if (stream->at_end) return false;
        dp_stream_refill(stream);
    }
}

bool dp_text_blank_slow(dp_stream *stream) {
    for (;;) {
        const uint8_t *p = stream->cursor;
        while (is_blank(*p)) p++;
        stream->cursor = p;
        if (p > stream->limit && dp_stream_refill(stream)) continue;
        const size_t continued = continuation(stream->cursor);
        if (!continued) break;
        stream->cursor += continued;
        stream->line++;
    }
    return stream->cursor < stream->end && !is_line_end(*stream->cursor);
}

void dp_text_skip_line(dp_stream *stream) {
    for (;;) {
        const uint8_t *p = stream->cursor;
        while (p < stream->end && !is_line_end(*p)) p++;
        stream->cursor = p;
        if (p > stream->limit && dp_stream_refill(stream)) continue;
        if (stream->cursor == stream->end) return;
        const bool pair = stream->cursor[0] == '\r' && stream->cursor[1] == '\n';
        stream->cursor += pair ? 2 : 1;
        stream->line++;
        return;
    }
}

void dp_text_skip_word(dp_stream *stream) {
    for (;;) {
        const uint8_t *p = stream->cursor;
        while (p < stream->end && !ends_word(*p)) p++;
        stream->cursor = p;
        if (p < stream->end || !dp_stream_refill(stream)) return;
    }
}

/* Skips a number that ends at `p` if it is the whole word. */
static inline bool take(dp_stream *stream, const uint8_t *p) {
    if (!p) return false;
    if (p == stream->end ? !stream->at_end : !ends_word(*p) && !continuation(p)) return false;
    stream->cursor = p;
    return true;
}

bool dp_text_float(dp_stream *stream, float *value) {
    return take(stream, dp_number_float(stream->cursor, value));
}

bool dp_text_wide(dp_stream *stream, float *value, double *wide) {
    return take(stream, dp_number_wide(stream->cursor, value, wide));
}

bool dp_text_int_slow(dp_stream *stream, int64_t *value) {
    return take(stream, dp_number_int(stream->cursor, value));
}

size_t dp_text_word(dp_stream *stream, char *word, size_t size) {
    size_t length = 0;
    while (stream->cursor < stream->end || dp_stream_refill(stream)) {
        const uint8_t byte = *stream->cursor;
        if (ends_word(byte)) break;
        if (length + 1 < size) word[length] = (char)byte;
        length++;
        stream->cursor++;
    }
    word[length < size ? length : size - 1] = 0;
    return length;
}

void dp_text_rest(dp_stream *stream, char *rest, size_t size) {
    size_t length = 0;
    while (stream->cursor < stream->end || dp_stream_refill(stream)) {
        const uint8_t byte = *stream->cursor;
        if (is_line_end(byte)) break;
        if (length + 1 < size && (length || !is_blank(byte))) rest[length++] = (char)byte;
        stream->cursor++;
    }
    while (length && is_blank((uint8_t)rest[length - 1])) length--;
    rest[length] = 0;
}

bool dp_text_match(dp_stream *stream, const char *word) {
    if (!dp_stream_have(stream, 1)) return false;
    const uint8_t *p = stream->cursor;
    for (; *word; p++, word++)
        if ((*p | 0x20) != *word) return false;
    return take(stream, p);
}

void dp_text_skip_mark(dp_stream *stream) {
    if (dp_stream_have(stream, 3) && memcmp(stream->cursor, "\xef\xbb\xbf", 3) == 0)
        stream->cursor += 3;
}

/* Copies the word at the cursor, cut and made printable, as it may be binary. */
static void quote(dp_stream *stream, char *text, size_t size) {
    const size_t length = dp_text_word(stream, text, size);
    for (char *p = text; p < text + length && p < text + size - 1; p++)
        if ((uint8_t)*p < ' ' || (uint8_t)*p >= 0x7f) *p = '?';
    if (length >= size) memcpy(text + size - 4, "...", 4);
}

dp_result dp_text_expected(dp_stream *stream, dp_diag *diag, const char *what, ...) {
    char expected[120], found[32];
    va_list arguments;
    va_start(arguments, what);
    vsnprintf(expected, sizeof expected, what, arguments);
    va_end(arguments);
    const uint64_t line = stream->line;
    const bool more = dp_stream_have(stream, 1);
    const bool line_end = more && is_line_end(*stream->cursor);
    if (more && !line_end) quote(stream, found, sizeof found);
    if (stream->result) return dp_stream_fail(stream, diag);
    if (!more)
        return dp_fail_line(diag, DP_ERR_FORMAT, line,
                            "the file ends where %s should be: it is cut short, copy or export it "
                            "again",
                            expected);
    if (line_end)
        return dp_fail_line(diag, DP_ERR_FORMAT, line,
                            "the line ends where %s should be: complete it, or export the model "
                            "again",
                            expected);
    return dp_fail_line(diag, DP_ERR_FORMAT, line,
                        "expected %s, found `%s`: mend the line, or export the model again",
                        expected, found);
}
