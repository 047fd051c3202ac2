/* Words and numbers from a stream of text. The usual cases are inline. */
#ifndef DP_IO_TEXT_H
#define DP_IO_TEXT_H

#include "base/diag.h"
#include "io/stream.h"

/* Skip to the next word, across line ends; false at the end of the text. */
bool dp_text_space_slow(dp_stream *stream);
static inline bool dp_text_space(dp_stream *stream) {
    const uint8_t *p = stream->cursor;
    if (p >= stream->limit) return dp_text_space_slow(stream);
    p += *p == ' '; /* one blank between two words is the rule */
    if (*p <= ' ' || p >= stream->limit) return dp_text_space_slow(stream);
    stream->cursor = p;
    return true;
}
/* Skip to the next word of this line, which a backslash may continue; false at its end. */
bool dp_text_blank_slow(dp_stream *stream);
static inline bool dp_text_blank(dp_stream *stream) {
    const uint8_t *p = stream->cursor;
    if (p >= stream->limit) return dp_text_blank_slow(stream);
    p += *p == ' ';
    if (*p <= ' ' || *p == '\\' || p >= stream->limit) return dp_text_blank_slow(stream);
    stream->cursor = p;
    return true;
}
/* Skips to after this line's end. */
void dp_text_skip_line(dp_stream *stream);
/* Skips this word. */
void dp_text_skip_word(dp_stream *stream);

/* Reads the number at the cursor. False, with the cursor unmoved, if the word is not a number. */
bool dp_text_float(dp_stream *stream, float *value);
/* The same, and the number in double precision (dp_number_wide). */
bool dp_text_wide(dp_stream *stream, float *value, double *wide);
bool dp_text_int_slow(dp_stream *stream, int64_t *value);
static inline bool dp_text_int(dp_stream *stream, int64_t *value) {
    const uint8_t *p = stream->cursor;
    uint32_t number = 0;
    for (uint32_t digit; (digit = (uint32_t)*p - '0') <= 9; p++) number = number * 10 + digit;
    const size_t digits = (size_t)(p - stream->cursor);
    if (digits - 1 > 8 || (*p != ' ' && *p != '\n')) return dp_text_int_slow(stream, value);
    stream->cursor = p;
    *value = number;
    return true;
}

/* Copies the word at the cursor, cut to size - 1 bytes; returns its full length. */
size_t dp_text_word(dp_stream *stream, char *word, size_t size);
/* Copies the rest of the line, without blanks around it, cut to size - 1 bytes; goes to the line's
 * end. */
void dp_text_rest(dp_stream *stream, char *rest, size_t size);
/* Skips `word` (given in lower case; any case matches) if it is the whole word at the cursor. */
bool dp_text_match(dp_stream *stream, const char *word);
/* Skips a UTF-8 byte order mark at the start. */
void dp_text_skip_mark(dp_stream *stream);

/* Fails with the stream's own failure if there is one, else with DP_ERR_FORMAT: "expected <what>,
 * found <the word at the cursor>", or that the file ends there. `what` is a printf format. */
dp_result dp_text_expected(dp_stream *stream, dp_diag *diag, const char *what, ...) DP_PRINTF(3, 4);

#endif
