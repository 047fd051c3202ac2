/* agree A.png B.png [PX]: do two drawings of one shape agree?
 *
 * Prints the share of A's ink that has ink of B within PX pixels (3), the reverse, their harmonic
 * mean F, the ink of each in pixels, and the share of each that is crumbs: pieces less than 12 px
 * wide and high. Where the drawings are of one model at two resolutions, or without and with noise,
 * a person would have drawn the same, and F would be 1. */
#include "ink.h"

#include <stdio.h>
#include <stdlib.h>

enum { CRUMB = 12 /* px */ };

static double share(size_t part, size_t whole) { return whole ? (double)part / (double)whole : 0; }

static int agree(const ink *a, const ink *b, double px) {
    if (a->width != b->width || a->height != b->height)
        return fprintf(stderr, "agree: the pictures differ in size\n"), EXIT_FAILURE;
    const size_t ab = ink_near(a, b, px), ba = ink_near(b, a, px);
    const size_t crumbs_a = ink_crumbs(a, CRUMB), crumbs_b = ink_crumbs(b, CRUMB);
    if (ab == SIZE_MAX || ba == SIZE_MAX || crumbs_a == SIZE_MAX || crumbs_b == SIZE_MAX)
        return fprintf(stderr, "agree: not enough memory\n"), EXIT_FAILURE;
    const double a_in_b = share(ab, a->count), b_in_a = share(ba, b->count);
    const double sum = a_in_b + b_in_a;
    printf("A in B %.3f  B in A %.3f  F %.3f  ink %zu %zu  crumbs %.3f %.3f\n", a_in_b, b_in_a,
           sum > 0 ? 2 * a_in_b * b_in_a / sum : 0, a->count, b->count, share(crumbs_a, a->count),
           share(crumbs_b, b->count));
    return EXIT_SUCCESS;
}

int main(int argc, char **argv) {
    char *rest = NULL;
    const double px = argc == 4 ? strtod(argv[3], &rest) : 3;
    if (argc < 3 || argc > 4 || !(px >= 0) || (rest && *rest))
        return fprintf(stderr, "usage: agree A.png B.png [PX]\n"), 2;
    ink a = {0}, b = {0};
    const bool read = ink_read(argv[1], &a) && ink_read(argv[2], &b);
    const int code = read ? agree(&a, &b, px) : EXIT_FAILURE;
    ink_free(&a);
    ink_free(&b);
    return code;
}
