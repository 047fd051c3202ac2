/* What the surface beside a line tells of it, by the depth samples of the picture.
 *
 *     gap       of an outline: its depth less that of what is seen a little beyond it
 *     clarity   of a fold: the slope of each of its sides is known, as its polygons' planes are; the
 *               slope of the surface just beyond each polygon is that of the chord between two depth
 *               samples; their difference is by how much that side bends on
 *
 * Depth is affine on every plane (core/view.h), so slopes are exact where surfaces are flat. They are
 * pixel sizes along the line of sight over px beside the line. Sample points are taken where a pixel
 * has its middle, and the offset of that from the line is what slopes are taken over. */
#include "strokes/evidence.h"

#include "core/piece.h"

/* Depth of the surface in the pixel at (x, y), the mean of its samples; DP_DEPTH_EMPTY where any is
 * paper; NaN outside the picture. */
static float depth_at(const dp_frame *f, float x, float y) {
    if (!(x >= 0 && y >= 0 && x < (float)f->target.width && y < (float)f->target.height))
        return NAN;
    const uint32_t px = (uint32_t)x, py = (uint32_t)y, samples = f->target.samples,
                   tile = py / DP_TILE * f->tiles_x + px / DP_TILE;
    if (f->tile_pieces[tile].empty) return DP_DEPTH_EMPTY;
    const float *const at = f->depth + tile * f->tile_samples +
                            (size_t)(py % DP_TILE * DP_TILE + px % DP_TILE) * samples;
    float sum = 0;
    for (uint32_t i = 0; i < samples; i++) {
        if (at[i] == DP_DEPTH_EMPTY) return DP_DEPTH_EMPTY;
        sum += at[i];
    }
    return sum / (float)samples;
}

dp_stroke_point dp_stroke_point_at(const dp_frame *frame, const dp_stroke *s, float t) {
    const float x = s->b.x - s->a.x, y = s->b.y - s->a.y, d = s->b.d - s->a.d,
                length = dp_hypotf(x, y);
    const dp_point at = {s->a.x + x * t, s->a.y + y * t, s->a.d + d * t};
    return (dp_stroke_point){.at = at,
                             .along = {x / length, y / length},
                             .beside = {y / length, -x / length},
                             .climb = d / length,
                             .step = fabsf(at.d) * frame->step_scale + frame->step_offset};
}

/* The surface at some distance beside a line. */
typedef struct beside {
    float away;   /* px from the line, as the pixel's middle lies; positive to the left */
    float nearer; /* than the line: pixel sizes; -INFINITY: paper; NaN: outside the picture */
} beside;

static beside look_beside(const dp_frame *f, const dp_stroke_point *p, float away) {
    const float x = p->at.x + p->beside[0] * away, y = p->at.y + p->beside[1] * away,
                depth = depth_at(f, x, y);
    const float dx = floorf(x) + 0.5f - p->at.x, dy = floorf(y) + 0.5f - p->at.y;
    const float line = p->at.d + p->climb * (dx * p->along[0] + dy * p->along[1]);
    return (beside){dx * p->beside[0] + dy * p->beside[1],
                    depth == DP_DEPTH_EMPTY ? -INFINITY : (depth - line) / p->step};
}

/* Slope from one to the other: how much nearer it becomes per px. They may lie in one pixel. */
static float slope_between(const beside *from, const beside *to) {
    return (to->nearer - from->nearer) / dp_maxf(fabsf(to->away - from->away), 0.5f);
}

float dp_outline_gap(const dp_frame *f, const dp_stroke_point *p, float reach) {
    static const float FREE = 4; /* to 1: what a surface may fall away without loss */
    const beside left = look_beside(f, p, reach);
    if (!(left.nearer > -INFINITY)) return INFINITY;
    const beside right = look_beside(f, p, -reach);
    if (!(right.nearer > -INFINITY)) return INFINITY;
    const beside *const there = left.nearer < right.nearer ? &left : &right;
    const beside close = look_beside(f, p, there == &left ? reach / 2 : -reach / 2);
    if (!(close.nearer > -INFINITY)) return INFINITY;
    const float falls = dp_maxf(-slope_between(&close, there) - FREE, 0);
    return dp_maxf(-there->nearer - fabsf(there->away) * falls, 0);
}

/* px from the stroke to the furthest corner of a polygon. Corners behind the eye do not count. */
static float reach_of(const dp_frame *f, uint32_t polygon, const dp_stroke_point *p) {
    const dp_polygons *const polygons = &f->polygons;
    const uint32_t first = dp_first_corner(polygons, polygon),
                   n = dp_corner_count(polygons, polygon);
    float most = 0;
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t v = dp_corner_vertex(polygons, first + i);
        const dp_clip_point c = dp_to_clip(&f->view, dp_v3f(dp_vertex_position(polygons, v)));
        if (!(c.w > 0)) continue;
        const dp_pointd at = dp_to_screen(&f->view, c);
        const float x = (float)at.x - p->at.x, y = (float)at.y - p->at.y;
        most = dp_maxf(most, fabsf(x * p->beside[0] + y * p->beside[1]));
    }
    return most;
}

static float degrees_of(float slope) {
    return 90 - dp_degrees_of_cosine(slope / sqrtf(1 + slope * slope));
}

/* Degrees by which the surface bends just beyond a polygon whose slope away from the line is known;
 * 0 where nothing is known of it: the surface ends there, or another one is seen. `away`: signed. */
static float bend_beyond(const dp_frame *f, const dp_stroke_point *p, float slope, float away) {
    static const float OTHER =
        2; /* to 1: what is off the polygon's plane by more is another surface */
    const float sign = away < 0 ? -1 : 1;
    const beside from = look_beside(f, p, 1.2f * away), to = look_beside(f, p, 2 * away);
    if (!(fabsf(from.nearer - slope * from.away * sign) <= OTHER * fabsf(from.away)) ||
        !(fabsf(to.nearer - slope * to.away * sign) <= OTHER * fabsf(to.away)))
        return 0;
    return fabsf(degrees_of(slope_between(&from, &to)) - degrees_of(slope));
}

/* Does polygon 0 of the two lie to the left? By which plane fits the depth there. */
static bool first_is_left(const dp_frame *f, const dp_stroke_point *p, const float slope[2]) {
    const beside left = look_beside(f, p, 1.5f);
    return !(fabsf(left.nearer - slope[0] * left.away) > fabsf(left.nearer - slope[1] * left.away));
}

/* How sharp a fold is, 0 to 1: of creases from 20 to 60 degrees, of outlines, which are that without a
 * fold, from 50 to 80. */
static float sharpness(const dp_stroke *s) {
    return s->line == DP_LINE_SILHOUETTE ? dp_smooth_step(50, 80, s->turn)
                                         : dp_smooth_step(20, 60, s->turn);
}

/* 0 to 1 from 75 to 88 degrees. */
static float rightness(const dp_stroke *s) { return dp_smooth_step(75, 88, s->turn); }

float dp_most_clarity(const dp_stroke *s) { return sharpness(s) + rightness(s); }

float dp_fold_clarity(const dp_frame *f, const dp_stroke *s, const dp_stroke_point *p,
                      const uint32_t polygon[2], float unit) {
    const bool outline = s->line == DP_LINE_SILHOUETTE;
    const float sharp = sharpness(s);
    float slope[2], bend = INFINITY, widest = 0;
    if (!(sharp > 0)) return 0;
    for (int k = 0; k < 2; k++)
        slope[k] = (s->plane[k][1] * p->beside[0] + s->plane[k][2] * p->beside[1]) / p->step;
    const bool left = first_is_left(f, p, slope);
    for (int k = 0; k < 2; k++) {
        if (polygon[k] == UINT32_MAX) continue;
        const float sign = (k == 0) == left ? 1 : -1, reach = reach_of(f, polygon[k], p);
        const float away = dp_minf(dp_maxf(reach, 5 * unit), 40 * unit);
        bend = dp_minf(bend, bend_beyond(f, p, slope[k] * sign, away * sign));
        widest = dp_maxf(widest, reach);
    }
    if (bend == INFINITY) return 0;
    /* sharp folds, outlines only beside wide polygons, and folds of wide polygons are meant in any case */
    const float sharpest = outline ? dp_smooth_step(70, 90, s->turn) *
                                         dp_smooth_step(8 * unit, 20 * unit, widest)
                                   : dp_smooth_step(50, 80, s->turn),
                wide = outline ? 0 : dp_smooth_step(40 * unit, 100 * unit, widest);
    const float meant = 1 - (1 - sharpest) * (1 - wide);
    /* a right angle at a wide, flat face is worth twice as much: few of them are chance */
    const float right = rightness(s) * dp_smooth_step(15 * unit, 30 * unit, widest) *
                        (1 - dp_smooth_step(0.05f, 0.2f, bend / s->turn));
    return sharp * (1 - dp_smooth_step(0.1f, 0.4f, bend / s->turn) * (1 - meant)) + right;
}
