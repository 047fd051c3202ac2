/* What the eye sees of any polygons: where surfaces end before others, and where they fold.
 *
 * A second reference beside accuracy/reference.h, which needs a clean mesh. This one knows no
 * adjacency, no winding and no shared corners; it looks along rays, 4 x 4 in each pixel, and where
 * two neighbours meet different planes it halves the distance between them and says what is there:
 *
 *     outline    one side is empty, or the planes do not meet there
 *     ridge      they do, at a dihedral angle of at most theta, with normals turned to the eye
 *     valley     the same, at more than phi; also where a part stands on another, or crosses it
 *     undecided  counts neither way: angles within a degree of a threshold, diagonals of polygons
 *                that are not planar, crossings too shallow to be a valley, tiny steps, what is
 *                thinner than an eighth of a pixel, facets smaller than the distance of the rays
 *
 * All in double precision; shares no code with the library. Not noticed: a missing line beside
 * another one, a wrong width. Out of memory aborts. */
#ifndef DP_TEST_EYE_H
#define DP_TEST_EYE_H

#include <drypoint/drypoint.h>

enum { EYE_OUTLINE, EYE_RIDGE, EYE_VALLEY, EYE_UNDECIDED, EYE_KINDS };

typedef struct eye_point {
    double x, y;   /* px, y down */
    double length; /* of the line that it stands for, px */
    uint8_t kind;
    bool row; /* met between two rays of one row; else of one column */
} eye_point;

typedef struct eye_truth {
    eye_point *points;
    size_t count, room;
    uint32_t width, height; /* px */
} eye_truth;

/* Everything must lie in front of the eye. Angles in degrees. */
eye_truth *eye_see(const dp_batch *arrays, const dp_camera *camera, uint32_t width, uint32_t height,
                   double theta, double phi);
void eye_free(eye_truth *truth); /* NULL allowed */

typedef struct eye_score {
    double recall;    /* share of the truth's length with ink within half a line's width and 1 px */
    double precision; /* share of the ink so near to the truth */
    double length[EYE_KINDS], found[EYE_KINDS]; /* px */
    double ink, stray;                          /* px */
} eye_score;

/* Of a picture with dark lines, `px` wide, on white. */
eye_score eye_judge(const eye_truth *truth, const uint8_t *rgba, double px);

/* The truth itself as a picture, moved by (dx, dx). */
void eye_draw(const eye_truth *truth, double px, double dx, uint8_t *rgba);
/* Missing truth red, stray ink blue, undecided grey, other ink light grey. */
void eye_mark(const eye_truth *truth, const uint8_t *rgba, double px, uint8_t *marked);

#endif
