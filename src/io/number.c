/* Text to float and integer.
 *
 * A decimal is m * 10^e, m with at most 18 digits. In double, m, 10^e and their product or quotient
 * err by half a unit in the last place each (digits cut off add less): 2 units together. Rounding
 * that double to float is correct unless it lies within 2 units of the middle between two floats,
 * which its low 29 bits tell. In that case, and outside the range of normal floats, strtof decides;
 * it gets the digits without a decimal point, as that depends on the locale.
 *
 * Not handled: hexadecimal floats, decimal commas, the "d" exponents of Fortran. */
#include "io/number.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    MANTISSA_DIGITS = 18,  /* fit int64_t */
    LARGEST_POWER = 60,    /* smallest normal float 1.2e-38 written with 18 digits: e = -55 */
    SLOW_DIGITS = 160,     /* the middle between two floats has at most 113 digits */
    EXPONENT_LIMIT = 99999 /* beyond, everything is 0 or infinite */
};

static const double power_of_ten[LARGEST_POWER + 1] = {
    1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
    1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22, 1e23, 1e24, 1e25, 1e26, 1e27, 1e28, 1e29, 1e30, 1e31,
    1e32, 1e33, 1e34, 1e35, 1e36, 1e37, 1e38, 1e39, 1e40, 1e41, 1e42, 1e43, 1e44, 1e45, 1e46, 1e47,
    1e48, 1e49, 1e50, 1e51, 1e52, 1e53, 1e54, 1e55, 1e56, 1e57, 1e58, 1e59, 1e60};

typedef struct decimal {
    int64_t mantissa;
    int exponent;          /* of ten */
    const uint8_t *digits; /* the first one, for the slow way */
    const uint8_t *stop;   /* behind the last digit or point */
    bool negative;
} decimal;

static inline unsigned digit_of(uint8_t byte) { return (unsigned)byte - '0'; }

/* strtof of the same digits; of those beyond SLOW_DIGITS it matters only whether any is not 0.
 * shift: the exponent as written. */
static float slow_float(const decimal *number, int shift) {
    char text[SLOW_DIGITS + 24];
    size_t length = 0;
    bool more = false, behind_point = false;
    text[length++] = number->negative ? '-' : '+';
    for (const uint8_t *p = number->digits; p < number->stop; p++) {
        if (*p == '.') {
            behind_point = true;
            continue;
        }
        const bool keep = length <= SLOW_DIGITS;
        if (keep && (length > 1 || *p != '0')) text[length++] = (char)*p;
        more |= !keep && *p != '0';
        shift += !keep - behind_point;
    }
    if (length == 1) text[length++] = '0';
    if (more) text[length++] = '1', shift--;
    snprintf(text + length, sizeof text - length, "e%d", shift);
    return strtof(text, NULL);
}

/* False if the double may lie on another side of a middle than the decimal. */
static inline bool round_to_float(double approximate, float *value) {
    uint64_t bits;
    memcpy(&bits, &approximate, sizeof bits);
    const uint64_t low = (bits & 0x1fffffff) - (0x10000000 - 4);
    if (low <= 8 || approximate < 0x1p-126 || approximate > 0x1.fffffep127) return false;
    *value = (float)approximate;
    return true;
}

static const uint8_t *read_exponent(const uint8_t *text, int *exponent) {
    const bool negative = *text == '-';
    const uint8_t *p = text + (*text == '-' || *text == '+');
    if (digit_of(*p) > 9) return NULL;
    int value = 0;
    for (; digit_of(*p) <= 9; p++)
        if (value < EXPONENT_LIMIT) value = value * 10 + (int)digit_of(*p);
    *exponent = negative ? -value : value;
    return p;
}

/* Reads digits with a point among them; false if there is no digit. */
static inline bool read_decimal(const uint8_t *p, decimal *number) {
    uint64_t mantissa = 0;
    const uint8_t *const first = p;
    while (digit_of(*p) <= 9) mantissa = mantissa * 10 + digit_of(*p++);
    size_t count = (size_t)(p - first);
    const uint8_t *point = p;
    if (*p == '.') {
        point = p++;
        while (digit_of(*p) <= 9) mantissa = mantissa * 10 + digit_of(*p++);
        count += (size_t)(p - point) - 1;
    }
    number->digits = first;
    number->stop = p;
    number->mantissa = (int64_t)mantissa;
    number->exponent = p > point ? -(int)(p - point - 1) : 0;
    return count > 0 && count <= MANTISSA_DIGITS;
}

/* The same for numbers with many leading zeros or digits, which read_decimal overflows on. */
static bool read_long_decimal(decimal *number) {
    uint64_t mantissa = 0;
    int kept = 0, exponent = 0;
    bool behind_point = false, any = false;
    for (const uint8_t *p = number->digits; p < number->stop; p++) {
        if (*p == '.') {
            behind_point = true;
            continue;
        }
        any = true;
        const bool keep = kept < MANTISSA_DIGITS;
        if (keep) mantissa = mantissa * 10 + digit_of(*p);
        if (keep && mantissa) kept++;
        exponent += !keep - behind_point;
    }
    number->mantissa = (int64_t)mantissa;
    number->exponent = exponent;
    return any;
}

static const uint8_t *match(const uint8_t *text, const char *word) {
    for (; *word; text++, word++)
        if ((*text | 0x20) != *word) return NULL;
    return text;
}

/* inf, infinity, nan, nan(…), all with a sign. */
static const uint8_t *read_special(const uint8_t *text, bool negative, float *value) {
    const uint8_t *p = match(text, "inf");
    if (p) {
        const uint8_t *const longer = match(p, "inity");
        *value = negative ? -INFINITY : INFINITY;
        return longer ? longer : p;
    }
    p = match(text, "nan");
    if (!p) return NULL;
    *value = NAN;
    if (*p == '(')
        while (*p > ' ') p++;
    return p;
}

/* "1.#INF00", "-1.#IND", "1.#QNAN": numbers that are not finite, by old Windows run times. */
static const uint8_t *read_windows_special(const uint8_t *text, bool negative, float *value) {
    const bool infinite = match(text, "inf") != NULL;
    *value = !infinite ? NAN : negative ? -INFINITY : INFINITY;
    while (*text > ' ') text++;
    return text;
}

/* *wide: the same before it is rounded, as well as doubles tell. */
static inline float decimal_to_float(const decimal *number, int shift, double *wide) {
    const int exponent = number->exponent + shift;
    if (!number->mantissa) return number->negative ? -0.0f : 0.0f;
    float value;
    double magnitude = (double)number->mantissa;
    if (exponent < -LARGEST_POWER || exponent > LARGEST_POWER) return slow_float(number, shift);
    if (exponent < 0)
        magnitude /= power_of_ten[-exponent];
    else
        magnitude *= power_of_ten[exponent];
    *wide = number->negative ? -magnitude : magnitude;
    if (round_to_float(magnitude, &value)) return number->negative ? -value : value;
    return slow_float(number, shift);
}

/* *wide is left as it is where the number has no better value than *value. */
static inline const uint8_t *read_number(const uint8_t *text, float *value, double *wide) {
    decimal number;
    number.negative = *text == '-';
    const uint8_t *p = text + (*text == '-' || *text == '+');
    if (!read_decimal(p, &number) && !read_long_decimal(&number))
        return read_special(p, number.negative, value);
    p = number.stop;
    int shift = 0;
    if ((*p | 0x20) == 'e') {
        p = read_exponent(p + 1, &shift);
        if (!p) return NULL;
    } else if (*p == '#') {
        return read_windows_special(p + 1, number.negative, value);
    }
    *value = decimal_to_float(&number, shift, wide);
    return p;
}

const uint8_t *dp_number_float(const uint8_t *text, float *value) {
    double unused;
    return read_number(text, value, &unused);
}

const uint8_t *dp_number_wide(const uint8_t *text, float *value, double *wide) {
    *wide = NAN;
    const uint8_t *const end = read_number(text, value, wide);
    if (isnan(*wide) && end) *wide = (double)*value;
    return end;
}

const uint8_t *dp_number_int(const uint8_t *text, int64_t *value) {
    const bool negative = *text == '-';
    const uint8_t *p = text + (*text == '-' || *text == '+');
    if (digit_of(*p) > 9) return NULL;
    const uint8_t *const first = p;
    uint64_t magnitude = 0;
    while (digit_of(*p) <= 9) magnitude = magnitude * 10 + digit_of(*p++);
    if (p - first > MANTISSA_DIGITS) { /* leading zeros, or too large for us */
        magnitude = 0;
        for (const uint8_t *q = first; q < p; q++)
            if (magnitude <= INT64_MAX / 10 - 1)
                magnitude = magnitude * 10 + digit_of(*q);
            else
                magnitude = INT64_MAX;
    }
    *value = negative ? -(int64_t)magnitude : (int64_t)magnitude;
    return p;
}
