/* Text to float and integer, independent of the locale. */
#ifndef DP_IO_NUMBER_H
#define DP_IO_NUMBER_H

#include <stdint.h>

/* Each reads a number at `text`, which must end with some byte that is no part of a number (0, say).
 * It returns the first byte after it, or NULL if there is no number. Floats are rounded correctly;
 * "inf", "nan" and the "1.#IND" of old compilers are numbers too. Integers are clamped to
 * int64_t. */
const uint8_t *dp_number_float(const uint8_t *text, float *value);
/* The same, and the number in double precision, to two units in its last place; where it is too large
 * or too small for that, the float. */
const uint8_t *dp_number_wide(const uint8_t *text, float *value, double *wide);
const uint8_t *dp_number_int(const uint8_t *text, int64_t *value);

#endif
