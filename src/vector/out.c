/* Bytes on their way to an application's `write`, and numbers as text.
 *
 * Numbers are whole thousandths and are printed digit by digit: the same in every locale and of every
 * C library. Invariant: after the first failure nothing more is handed on. */
#include "vector/out.h"

#include "base/print.h"

#include <math.h>
#include <string.h>

void dp_put_flush(dp_out *out) {
    if (!out->result && out->held)
        out->result = out->write(out->user, out->bytes, out->held, out->diag);
    out->held = 0;
}

void dp_put(dp_out *out, const void *bytes, size_t size) {
    const char *from = bytes;
    out->put += size;
    while (size && !out->result) {
        const size_t room = sizeof out->bytes - out->held, part = size < room ? size : room;
        memcpy(out->bytes + out->held, from, part);
        out->held += part;
        from += part;
        size -= part;
        if (out->held == sizeof out->bytes) dp_put_flush(out);
    }
}

void dp_put_text(dp_out *out, const char *text) { dp_put(out, text, strlen(text)); }

void dp_put_char(dp_out *out, char c) { dp_put(out, &c, 1); }

/* ------- numbers ------- */

int64_t dp_fixed(double value) {
    const double most = (double)DP_FIXED_MOST, thousandths = floor(value * DP_FIXED_ONE + 0.5);
    if (!(thousandths > -most)) return -DP_FIXED_MOST; /* NaN, too */
    return thousandths < most ? (int64_t)thousandths : DP_FIXED_MOST;
}

/* Digits of `value`, at least `width`, written backwards before `end`. */
static char *digits_before(char *end, uint64_t value, int width) {
    for (; value || width > 0; value /= 10, width--) *--end = (char)('0' + value % 10);
    return end;
}

/* value / 10^places, without trailing zeros; `whole`: 0 is written before a point. */
static void put_scaled(dp_out *out, int64_t value, int places, int whole) {
    char text[40], *end = text + sizeof text;
    uint64_t rest = value < 0 ? 0 - (uint64_t)value : (uint64_t)value;
    uint64_t power = 1;
    for (; places && rest % 10 == 0; places--) rest /= 10;
    for (int i = 0; i < places; i++) power *= 10;
    char *at = end;
    if (places) {
        at = digits_before(at, rest % power, places);
        *--at = '.';
    }
    at = digits_before(at, rest / power, places ? whole : 1);
    if (value < 0) *--at = '-';
    dp_put(out, at, (size_t)(end - at));
}

void dp_put_fixed(dp_out *out, int64_t thousandths) {
    put_scaled(out, thousandths, DP_FIXED_PLACES, 1);
}

void dp_put_short(dp_out *out, int64_t thousandths) {
    put_scaled(out, thousandths, DP_FIXED_PLACES, 0);
}

void dp_put_integer(dp_out *out, uint64_t value) { dp_put_padded(out, value, 1); }

void dp_put_padded(dp_out *out, uint64_t value, int width) {
    char text[40], *const end = text + sizeof text, *const at = digits_before(end, value, width);
    dp_put(out, at, (size_t)(end - at));
}

void dp_put_number(dp_out *out, double value, int places) {
    double scaled = value;
    for (int i = 0; i < places; i++) scaled *= 10;
    scaled = floor(scaled + 0.5);
    const double most = 9e18;
    const int64_t whole = !(scaled > -most) ? (int64_t)-most
                          : scaled < most   ? (int64_t)scaled
                                            : (int64_t)most;
    put_scaled(out, whole, places, 1);
}

void dp_put_digits(dp_out *out, double value, int digits) {
    if (!isfinite(value))
        dp_put_text(out, "null");
    else
        dp_put_text(out, dp_print_number((char[DP_NUMBER_TEXT]){0}, value, digits));
}

/* ------- bytes as text ------- */

void dp_put_base64(dp_out *out, const uint8_t *bytes, size_t size) {
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < size && !out->result; i += 3) {
        const size_t rest = size - i;
        const uint32_t three = (uint32_t)bytes[i] << 16 |
                               (uint32_t)(rest > 1 ? bytes[i + 1] : 0) << 8 |
                               (uint32_t)(rest > 2 ? bytes[i + 2] : 0);
        char four[4] = {digits[three >> 18], digits[three >> 12 & 63], '=', '='};
        if (rest > 1) four[2] = digits[three >> 6 & 63];
        if (rest > 2) four[3] = digits[three & 63];
        dp_put(out, four, 4);
    }
}
