/* Drawings as ink or none, and how two of them compare. */
#ifndef BENCH_INK_H
#define BENCH_INK_H

#include <drypoint/base.h>

typedef struct ink {
    uint8_t *pixels; /* [height][width]: 1 where there is ink, else 0 */
    uint32_t width, height;
    size_t count; /* pixels with ink */
} ink;

/* Reads a PNG: ink is what is darker than half white, seen on white paper. The caller frees it.
 * False: said why on stderr. */
bool ink_read(const char *path, ink *out);

/* The same of pixels in memory, [height][width][4] RGBA, not premultiplied. False: no memory. */
bool ink_make(const uint8_t *rgba, uint32_t width, uint32_t height, ink *out);

void ink_free(ink *i); /* zeroed allowed */

/* How many of a's ink pixels have ink of b at most px away, between centres of pixels. Both have
 * one size; px >= 0. SIZE_MAX: no memory. */
size_t ink_near(const ink *a, const ink *b, double px);

/* How many ink pixels lie in pieces, joined through edges or corners of pixels, whose box has both
 * sides below `size` px. SIZE_MAX: no memory. */
size_t ink_crumbs(const ink *i, uint32_t size);

#endif
