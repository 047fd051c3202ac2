/* Texture coordinates of added polygons (Raskar 2001, 2.1: "texture mapping the enlarged part"). */
#ifndef DP_FEATURES_MAPPING_H
#define DP_FEATURES_MAPPING_H

#include "core/frame.h"
#include "features/features.h"

/* How long one repeat of the style's pattern, or of a stroke's texture, is on a line `width` px
 * wide: in the model's units, or px with dp_pattern.screen and strokes by arc. */
double dp_pattern_length(const dp_frame *frame, const dp_style *style, float width);

/* One added polygon and how its line is drawn. */
typedef struct dp_mapped {
    const dp_primitive *primitive;
    uint32_t edge;
    dp_line line;
    dp_pen pen;
    bool whole;        /* the line is drawn from one side: v is 0 to 1 on it; else half of v is */
    bool joint;        /* it goes around one of the edge's corners */
    double d0, dx, dy; /* its depth on the screen */
    double length;     /* of one repeat */
    bool screen;       /* that is px */
} dp_mapped;

/* u and v as quotients of affine functions of the screen, value[0] + value[1] x + value[2] y: that
 * is what perspective makes of lengths in a plane. */
typedef struct dp_mapping {
    double u[3], u_over[3], v[3], v_over[3];
    double v_from, v_scale; /* v of the texture: v_from + v_scale * v */
} dp_mapping;

/* Of a screen point: coordinates, and the length of their change per px. */
typedef struct dp_mapped_point {
    double u, v, du, dv;
} dp_mapped_point;

void dp_mapping_make(const dp_mapped *mapped, dp_mapping *out);
dp_mapped_point dp_mapping_at(const dp_mapping *mapping, double x, double y);

#endif
