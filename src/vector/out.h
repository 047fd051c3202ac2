/* Bytes on their way to an application's `write`: numbers and names as the formats want them. */
#ifndef DP_VECTOR_OUT_H
#define DP_VECTOR_OUT_H

#include "base/hostile.h"
#include <drypoint/sink.h>

enum { DP_OUT_HOLDS = DP_TUNED(1 << 14, 7) /* bytes */ };

/* Where bytes go; the first failure stays, and nothing is written after it. */
typedef struct dp_out {
    dp_text_writer *write;
    void *user;
    dp_diag *diag;
    dp_result result;
    uint64_t put; /* bytes, with those that are held */
    size_t held;
    char bytes[DP_OUT_HOLDS];
} dp_out;

void dp_put(dp_out *out, const void *bytes, size_t size);
void dp_put_text(dp_out *out, const char *text);
void dp_put_char(dp_out *out, char c);
/* Hands on what is held. */
void dp_put_flush(dp_out *out);

/* ------- numbers: without printf, so in any locale ------- */

/* Lengths of pages are counted in thousandths of a unit; what is out of range is as far as it can
 * be. */
enum { DP_FIXED_PLACES = 3, DP_FIXED_ONE = 1000 };
#define DP_FIXED_MOST INT64_C(1000000000000000)
int64_t dp_fixed(double value);

void dp_put_fixed(dp_out *out, int64_t thousandths); /* "-0.25" */
void dp_put_short(dp_out *out, int64_t thousandths); /* "-.25" */
void dp_put_integer(dp_out *out, uint64_t value);
/* With up to `places` (at most 9) behind the point. */
void dp_put_number(dp_out *out, double value, int places);
/* With `digits` that count (at most 17); "null" for what is not finite. */
void dp_put_digits(dp_out *out, double value, int digits);
/* "0000000012": filled up with zeros to `width` digits. */
void dp_put_padded(dp_out *out, uint64_t value, int width);

/* ------- names and titles ------- */

enum { DP_NO_CHARACTER = 0xFFFD };

/* The next character of a UTF-8 text, and past it; DP_NO_CHARACTER for each byte that begins none.
 * 0: the text is over. */
uint32_t dp_next_character(const char **text);

void dp_put_xml(dp_out *out, const char *text);
void dp_put_json(dp_out *out, const char *text); /* with its quotes; "null" for NULL */
void dp_put_pdf(dp_out *out, const char *text);  /* (…), or <FEFF…> where it is not ASCII */
void dp_put_postscript(dp_out *out, const char *text); /* (…), its first 100 characters */
void dp_put_ascii(dp_out *out, const char *text);      /* its first 200, others as ? */

/* ------- bytes as text ------- */

void dp_put_base64(dp_out *out, const uint8_t *bytes, size_t size);

#endif
