/* Do two lists of segments show the same lines? By class and by the pair of polygons that a line lies between. */
#ifndef TESTS_GL_AGREE_H
#define TESTS_GL_AGREE_H

#include <drypoint/gl.h>

typedef struct agreement {
    double length[2]; /* px of lines, in the first and in the second list */
    double
        alike; /* px: of pairs whose lengths differ by no more than 0.5 px in the two, the larger one */
    double common; /* px that both have: of each pair the smaller length */
    double all;    /* px: of each pair the larger length */
} agreement;

/* Of one class, or with DP_LINE_COUNT of all. */
agreement agree(const dp_segment *a, size_t a_count, const dp_segment *b, size_t b_count,
                dp_line line);
/* Share of the length that is alike; 1 where there are no lines. */
double agree_share(const agreement *g);
/* Prints what is not alike, longest first, `most` rows. */
void agree_print(const dp_segment *a, size_t a_count, const dp_segment *b, size_t b_count,
                 dp_line line, size_t most);

#endif
