/* What the surface beside a line tells of it: how far the line stands before what lies beyond, and
 * how clearly the surface is folded there. */
#ifndef DP_STROKES_EVIDENCE_H
#define DP_STROKES_EVIDENCE_H

#include "strokes/stroke.h"

/* A point of a visible stroke, on the screen. */
typedef struct dp_stroke_point {
    dp_point at;
    float along[2], beside[2]; /* unit, px: the stroke's direction, and to the left of it */
    float climb;               /* change of depth d per px along */
    float step;                /* of depth d, for one pixel size */
} dp_stroke_point;

/* The point at t, 0 to 1 from a to b, of a stroke that is not a point. */
dp_stroke_point dp_stroke_point_at(const dp_frame *frame, const dp_stroke *stroke, float t);

/* How far an outline stands before what is seen beyond it, `reach` px from the point: pixel sizes,
 * INFINITY before the paper. What the surface beyond falls away of itself, at more than 4 to 1, does not
 * count: so steep a surface recedes by much within a pixel, and a crumb of it stands far before the
 * rest. */
float dp_outline_gap(const dp_frame *frame, const dp_stroke_point *point, float reach);

/* The most that dp_fold_clarity may be, whatever lies beside the fold. */
float dp_most_clarity(const dp_stroke *stroke);

/* How clearly a fold is one, 0 to 2: how sharp it is, and how far it stands out from the surface
 * around it. Where both sides bend on by as much as the fold, just beyond its polygons, it is one of
 * many by which a round or a rough surface is approximated. `polygon`: those that meet there; UINT32_MAX:
 * none, or it is not seen. `unit`, px: what is wide and what is near is measured in it. */
float dp_fold_clarity(const dp_frame *frame, const dp_stroke *stroke, const dp_stroke_point *point,
                      const uint32_t polygon[2], float unit);

/* Degrees of the angle whose cosine is given, to a hundredth (Abramowitz and Stegun 1964, 4.4.45). */
static inline float dp_degrees_of_cosine(float cosine) {
    const float c = dp_minf(fabsf(cosine), 1);
    const float angle =
        sqrtf(1 - c) * (1.5707288f + c * (-0.2121144f + c * (0.0742610f + c * -0.0187293f)));
    return (cosine < 0 ? 3.14159265f - angle : angle) * 57.29577951f;
}

/* The smooth step from 0 at `low` to 1 at `high`. */
static inline float dp_smooth_step(float low, float high, float value) {
    const float t = dp_minf(dp_maxf((value - low) / (high - low), 0), 1);
    return t * t * (3 - 2 * t);
}

#endif
