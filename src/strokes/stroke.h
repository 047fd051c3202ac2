/* Strokes: feature segments as they are inked. */
#ifndef DP_STROKES_STROKE_H
#define DP_STROKES_STROKE_H

#include "core/frame.h"

/* A capsule on the screen: all points within half_width of the spine. */
typedef struct dp_stroke {
    dp_point a, b;     /* ends of the spine; screen space */
    float half_width;  /* px */
    float plane[2][3]; /* d0, dx, dy of the polygons that meet at the spine; NaN: none */
    float turn;        /* degrees between the normals of these; 0: there is only one */
    dp_color color;
    uint8_t line;  /* dp_line */
    uint8_t level; /* as in dp_segment; 0: visible */
    uint8_t stops; /* bit k: end k is where something hides the rest (DP_END_HIDDEN) */
} dp_stroke;

/* How steeply a surface may rise beside a stroke without hiding it: depth over distance, in pixels.
 * Lines of sections have no polygons whose planes would tell, and lie on a face that is often seen at
 * a grazing angle: down to 0.6 degrees, that is. Not around an end at which something hides them. */
enum { DP_STROKE_SLOPE = 8, DP_SECTION_SLOPE = 100 };
static inline bool dp_stroke_is_section(const dp_stroke *s) {
    return s->line == DP_LINE_SECTION || s->line == DP_LINE_HATCHING;
}
/* These t lie around ends: up to the first and from the second on. */
static inline float dp_stroke_from(const dp_stroke *s) { return s->stops & 1 ? 0 : -1; }
static inline float dp_stroke_to(const dp_stroke *s) { return s->stops & 2 ? 1 : 2; }
static inline float dp_stroke_slope(const dp_stroke *s, float t) {
    const bool along = dp_stroke_from(s) < t && t < dp_stroke_to(s);
    return dp_stroke_is_section(s) && along ? DP_SECTION_SLOPE : DP_STROKE_SLOPE;
}

/* How near a surface may come to a stroke without hiding it: depth, at (x, y) on the screen,
 * `distance` px beside the spine's point t. It may be nearer than the spine, in pixel sizes, by
 *
 *     2 + slope distance + sqrt(picture height * distance), the last of outlines alone:
 *
 * sides that rise by up to eight to one (dp_stroke_slope), and outlines that curve towards the eye
 * with a radius of up to half the picture (a circle rises by sqrt(2 r x)). And it may lie behind one
 * of the stroke's own polygons, carried on over the pixel; where that is steep, behind its depth at
 * the pixel's nearest part. A NaN for no polygon. */
static inline float dp_stroke_limit(const dp_frame *frame, const dp_stroke *s, float x, float y,
                                    float t, float distance) {
    const float spine = s->a.d + (s->b.d - s->a.d) * t,
                step = fabsf(spine) * frame->step_scale + frame->step_offset;
    const float rounded =
        s->line == DP_LINE_SILHOUETTE ? sqrtf((float)frame->view.height * distance) : 0;
    float limit = spine + step * (2 + dp_stroke_slope(s, t) * distance + rounded);
    for (int i = 0; i < 2; i++) {
        const float *const p = s->plane[i];
        const float own =
            p[0] + p[1] * x + p[2] * y + 0.5f * (fabsf(p[1]) + fabsf(p[2])) + 2 * step;
        limit = dp_maxf(own, limit);
    }
    return limit;
}

#endif
