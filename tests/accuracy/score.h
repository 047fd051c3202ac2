/* How well a picture, or a list of segments, agrees with the truth. */
#ifndef DP_TEST_SCORE_H
#define DP_TEST_SCORE_H

#include "reference.h"

typedef struct score {
    double recall;    /* share of the truth that has ink within 1 px */
    double precision; /* share of the ink within a line's reach of the truth: half its width and
                            1.5 px; for silhouettes the whole width and 1.5 px */
    double uncovered; /* share of the ideal strokes, 1 px inside their border, without ink; not of
                            silhouettes */
    double cracks;    /* the same without what a clearly nearer surface hides */
    double width_median; /* px, across the middles of long edges where no other line is near; 0:
                            none */
    double width_low,
        width_high; /* 2nd and 98th percentile of the same, averaged over 8 px along */
    size_t samples; /* of the truth */
    size_t width_samples;
    double ink, stray; /* px */
} score;

/* Dark ink on white: [height][width][4], not premultiplied. `lines`: the classes that were asked
 * for, all `px` wide. */
score score_picture(const ref_truth *truth, const uint8_t *rgba, uint32_t lines, double px);

/* Of one class: recall as above, precision as the share of the segments' length within 1.5 px. */
score score_segments(const ref_truth *truth, const dp_segment *segments, size_t count,
                     dp_line line);

/* The ideal picture, black on white: a capsule around every piece, moved by (dx, dy) px. */
void score_draw_truth(const ref_truth *truth, uint32_t lines, double px, double dx, double dy,
                      uint8_t *rgba);

#endif
