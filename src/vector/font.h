/* Letters of single strokes. */
#ifndef DP_VECTOR_FONT_H
#define DP_VECTOR_FONT_H

#include <stdbool.h>
#include <stddef.h>

enum {
    DP_LETTER_HEIGHT = 10,      /* of a capital letter, in units of letters */
    DP_LETTER_STROKE_MOST = 32, /* points */
};

/* A text on its way, stroke by stroke. */
typedef struct dp_lettering {
    const char *rest;            /* UTF-8 */
    const char *strokes, *above; /* of the letter that is being drawn, and of its accent */
    double x;                    /* of the letter */
    double next_x;
    double above_x, above_y; /* of the accent */
} dp_lettering;

/* The next stroke's points, x right and y up from the start of the base line; at least two. 0: the text is over. */
size_t dp_next_stroke(dp_lettering *lettering, double points[DP_LETTER_STROKE_MOST][2]);

#endif
