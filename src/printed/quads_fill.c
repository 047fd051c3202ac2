/* The depth tests of quads as ink: what happens to the samples that an added polygon covers.
 *
 *    between    filled by              test
 *    plane      the kernel (ink.inc)   depths; then, by sample, the polygon that won it
 *    interval   this file              d > z1 updates z1; z1 > d >= z2 is trapped
 *    stencil    this file              down if d > depth, then up if d + offset > depth
 *
 * `plane` is the default. Its test asks whether two planes cross within half a line width on the
 * screen, where the paper asks whether depths are close (Raskar 2001, 2.3). The other tests fill
 * triangles, four samples at a time. Invariant: no test changes the depth of faces. */
#include "printed/kernels.h"
#include "features/crossing.h"
#include "printed/marks.h"

#include "features/features.h"

/* Under a joint, the surface's plane must pass the corner within this share of the joint's
 * reach. */
static const float JOINT = 0.1f;

static dp_f4 *depth_at(const dp_brush *b, size_t lane) {
    return (dp_f4 *)(void *)(b->w->tile->depth + lane);
}
static dp_f4 *ink_depth_at(const dp_brush *b, size_t lane) {
    return (dp_f4 *)(void *)(b->w->ink_depth + lane);
}
static dp_i4 *ink_at(const dp_brush *b, size_t lane) { return (dp_i4 *)(void *)(b->w->ink + lane); }
static dp_i4 splat(uint32_t v) { return (dp_i4){(int32_t)v, (int32_t)v, (int32_t)v, (int32_t)v}; }
static dp_f4 behind(dp_f4 d, dp_step s) { return d * dp_splat(s.scale) + dp_splat(s.offset); }

/* Where a sample lies, in tile space. */
static void sample_at(const dp_sampling *s, size_t lane, float *x, float *y) {
    const size_t width = (size_t)4 * s->vectors, cell = lane / width, i = lane % width;
    *x = (float)(cell % s->cells_x * s->cell_width) + s->x[i / 4][i % 4];
    *y = (float)(cell / s->cells_x) + s->y[i / 4][i % 4];
}

/* Does the surface at the sample pass through the edge or corner that the added polygon grows from?
 * The planes must cross within `reach` px of the root's nearest point. A surface that is merely
 * close in front of a hidden valley, or curves away beyond a corner, does not. */
static bool passes_root(const dp_brush *b, size_t lane, float d, float reach) {
    const dp_tile_polygon *const q = &b->w->tile->polygons[b->w->tile->winner[lane]];
    const float gx = q->dx - b->plane.dx, gy = q->dy - b->plane.dy;
    float x, y;
    sample_at(&b->w->tile->sampling, lane, &x, &y);
    const dp_point p = b->root[0], to = b->root[1];
    const float ex = to.x - p.x, ey = to.y - p.y, length2 = ex * ex + ey * ey;
    const float along = length2 > 0 ? ((x - p.x) * ex + (y - p.y) * ey) / length2 : 0;
    const float t = dp_minf(dp_maxf(along, 0), 1);
    const float gap =
        b->w->tile->depth[lane] - d - gx * (x - p.x - t * ex) - gy * (y - p.y - t * ey);
    return dp_planes_cross_within(gap, gx, gy, reach);
}

/* Are both seen from the front, or do their interiors really cross? Along every outline of a closed
 * model a front and a back face come close without crossing. */
static bool may_intersect(dp_brush *b, uint32_t other) {
    if (b->other == other) return b->meets;
    const dp_tile_polygon *const p = &b->w->tile->polygons[b->self], *const q =
                                                                         &b->w->tile
                                                                              ->polygons[other];
    b->other = other;
    b->meets = !dp_polygons_touch(&b->w->tile->frame->polygons, p->id, q->id);
    dp_vec3 from, to, normal;
    if (b->meets && !(p->flags & q->flags & DP_POLYGON_FRONT))
        b->meets = dp_crossing_find(b->w->tile->frame, p->id, q->id, &from, &to, &normal);
    return b->meets;
}

/* Around a corner lie polygons that share no edge with this one and may curve away without any
 * fold, so a close surface must pass through the corner. */
static bool wins_joint(const dp_brush *b, size_t lane, float d) {
    const bool close = b->w->tile->depth[lane] >= d * b->trap.scale + b->trap.offset;
    return !close || passes_root(b, lane, d, JOINT * b->reach);
}

/* ------- marks ------- */

/* With a pattern it matters which of several polygons inks a sample: those behind an outline reach
 * over it too, and often nearer to the eye. The pattern of the edge that is least far on the screen
 * is the one that is meant, for the same class of lines and within this many widths in depth. */
static const double ONE_LINE = 8;

/* px from the sample to the edge or corner that the polygon grows from. */
static float rank_of(const dp_brush *b, size_t lane) {
    double x, y;
    dp_mark_sample_at(b->w, lane, &x, &y);
    const dp_pointd p = b->screen_root[0], q = b->screen_root[1];
    const double ex = q.x - p.x, ey = q.y - p.y, length2 = ex * ex + ey * ey;
    const double along = length2 > 0 ? ((x - p.x) * ex + (y - p.y) * ey) / length2 : 0;
    const double t = dp_min(dp_max(along, 0), 1);
    return (float)dp_hypot(x - p.x - t * ex, y - p.y - t * ey);
}

static bool is_one_class(const dp_brush *b, uint32_t held) {
    const dp_mark *const m = &b->w->marks[(held & ~DP_INK_ADDED) - 1],
                         *const n = &b->w->marks[(b->ink & ~DP_INK_ADDED) - 1];
    return m->line == n->line && m->style == n->style && !m->plain;
}

/* Puts the polygon's ink into a sample, unless one that is less far has its own there (`held`). */
static void take(const dp_brush *b, uint32_t *held, size_t lane, bool compares) {
    const float rank = rank_of(b, lane);
    if (compares && *held && rank >= b->w->rank[lane]) return;
    *held = b->ink;
    b->w->rank[lane] = rank;
}

/* Is what inks the sample of the same line, at this depth? */
static bool is_one_line(const dp_brush *b, uint32_t held, size_t lane, float d) {
    const dp_printer *const w = b->w;
    if (!held || !is_one_class(b, held)) return false;
    const dp_mark *const m = &w->marks[(b->ink & ~DP_INK_ADDED) - 1];
    const double width = (double)w->tile->frame->styles[m->style].line[m->line].width;
    const double step = dp_depth_step(&w->tile->frame->view, fabs((double)d), ONE_LINE * width);
    return fabs((double)d - (double)w->ink_depth[lane]) <= step;
}

/* A line before the surface. Its depth is that of the nearest polygon, whichever inks it. */
static void take_line(const dp_brush *b, size_t lane, float d) {
    dp_printer *const w = b->w;
    const bool seen = d > w->tile->depth[lane], nearer = d > w->ink_depth[lane];
    if (!b->ink) return;
    const bool one_line = is_one_line(b, w->ink[lane], lane, d);
    if (!nearer && !(one_line && seen)) return;
    if (b->test == DP_INK_JOINT && !wins_joint(b, lane, d)) return;
    take(b, &w->ink[lane], lane, one_line);
    if (nearer) w->ink_depth[lane] = d;
}

/* May a trapped polygon ink what holds this ink already? */
static bool may_replace(const dp_brush *b, uint32_t held, size_t lane) {
    return b->w->marked && b->ink && is_one_class(b, held) && rank_of(b, lane) < b->w->rank[lane];
}

/* ------- the between-test of planes ------- */

static bool is_trapped(dp_brush *b, size_t lane, float d) {
    const dp_printer *const w = b->w;
    const uint32_t winner = w->tile->winner[lane], held = w->ink[lane];
    if (winner == UINT32_MAX || held & DP_INK_ADDED) return false;
    if (held && !b->face && !may_replace(b, held, lane)) return false;
    const dp_tile_polygon *const q = &w->tile->polygons[winner];
    if (!b->face && !(q->flags & DP_POLYGON_FRONT)) return false;
    if (!dp_planes_cross_within(w->tile->depth[lane] - d, q->dx - b->plane.dx, q->dy - b->plane.dy,
                                b->reach))
        return false;
    return b->face ? may_intersect(b, winner) : passes_root(b, lane, d, b->reach);
}

void dp_quads_ask(dp_brush *b, size_t lane, uint32_t bits, const float *d) {
    const bool joint = b->test == DP_INK_JOINT;
    for (; bits; bits &= bits - 1) {
        const uint32_t i = (uint32_t)__builtin_ctz(bits);
        if (!(joint ? wins_joint(b, lane + i, d[i]) : is_trapped(b, lane + i, d[i]))) continue;
        b->w->ink[lane + i] = b->ink;
        if (b->w->marked) b->w->rank[lane + i] = rank_of(b, lane + i);
        if (joint) b->w->ink_depth[lane + i] = d[i];
    }
}

/* The between-test (Raskar 2001, 2.3): z1 > d >= z2, where z1 is that of a face. Nothing is trapped
 * behind a silhouette or a ridge, although these update z1 too. */
DP_INLINED dp_i4 between(const dp_brush *b, size_t lane, dp_i4 in, dp_f4 d) {
    const dp_f4 z1 = *ink_depth_at(b, lane);
    const dp_i4 ink = *ink_at(b, lane);
    const dp_i4 line = ink & splat(DP_INK_ADDED);
    return in & (d < z1) & (d >= behind(z1, b->trap)) & (line == 0);
}

/* As printed (Raskar 2001, 2.4): what is nearest updates z1; other faces take the between-test. */
DP_INLINED void draw_interval(void *arg, size_t lane, dp_i4 in, dp_f4 d) {
    const dp_brush *const b = arg;
    const dp_f4 z1 = *ink_depth_at(b, lane);
    const dp_i4 win = in & (d > z1);
    const dp_i4 trapped = between(b, lane, in, d) & splat(b->intersections ? ~0u : 0);
    *ink_depth_at(b, lane) = dp_select(win, d, z1);
    const dp_i4 ink = dp_selecti(win, splat(b->face ? 0 : b->ink), *ink_at(b, lane));
    *ink_at(b, lane) = dp_selecti(trapped, splat(b->ink), ink);
}

/* The same for ink with marks. */
static void trap_marked(const dp_brush *b, size_t lane, dp_i4 trapped) {
    for (uint32_t i = 0; i < 4; i++) {
        uint32_t *const held = &b->w->ink[lane + i];
        if (trapped[i]) take(b, held, lane + i, *held && b->ink && is_one_class(b, *held));
    }
}

DP_INLINED void trap_in_interval(void *arg, size_t lane, dp_i4 in, dp_f4 d) {
    const dp_brush *const b = arg;
    if (b->w->marked) {
        trap_marked(b, lane, between(b, lane, in, d));
        return;
    }
    *ink_at(b, lane) = dp_selecti(between(b, lane, in, d), splat(b->ink), *ink_at(b, lane));
}

DP_INLINED void count_down(void *arg, size_t lane, dp_i4 in, dp_f4 d) {
    const dp_brush *const b = arg;
    const dp_i4 front = in & (d > *depth_at(b, lane));
    for (uint32_t i = 0; i < 4; i++)
        b->w->stencil[lane + i] += (uint8_t)front[i]; /* a mask is -1 */
}

DP_INLINED void count_up(void *arg, size_t lane, dp_i4 in, dp_f4 d) {
    const dp_brush *const b = arg;
    const dp_i4 front = in & (behind(d, b->nearer) > *depth_at(b, lane));
    for (uint32_t i = 0; i < 4; i++) b->w->stencil[lane + i] -= (uint8_t)front[i];
    if (!b->w->marked || b->face) return;
    const dp_i4 trapped = front & ~(d > *depth_at(b, lane));
    for (uint32_t i = 0; i < 4; i++)
        if (trapped[i]) take(b, &b->w->trapped[lane + i], lane + i, true);
}

/* Of four samples those that a line with a mark may take, one by one: they are few. */
static void take_lines(const dp_brush *b, size_t lane, dp_i4 may, dp_f4 d) {
    for (uint32_t i = 0; i < 4; i++)
        if (may[i]) take_line(b, lane + i, d[i]);
}

DP_INLINED void draw_marked(void *arg, size_t lane, dp_i4 in, dp_f4 d) {
    const dp_i4 seen = in & (d > *depth_at(arg, lane));
    if (dp_any(seen)) take_lines(arg, lane, seen, d);
}

/* z1 is that of lines and faces. */
DP_INLINED void draw_marked_interval(void *arg, size_t lane, dp_i4 in, dp_f4 d) {
    const dp_i4 may = in & ((d > *depth_at(arg, lane)) | (d > *ink_depth_at(arg, lane)));
    if (dp_any(may)) take_lines(arg, lane, may, d);
}

/* ------- rasterizing ------- */

/* Edge functions from each corner to the next, four at a time; a triangle's fourth is not used. The
 * same as dp_coverage_make, so a quad covers what its two triangles cover. False: beside the
 * tile. */
static bool make_shape(const dp_point *p, uint32_t n, dp_ink_shape *out) {
    const dp_point q = p[n == 4 ? 3 : 0];
    const float x0 = dp_minf(dp_minf(p[0].x, p[1].x), dp_minf(p[2].x, q.x));
    const float y0 = dp_minf(dp_minf(p[0].y, p[1].y), dp_minf(p[2].y, q.y));
    const float x1 = dp_maxf(dp_maxf(p[0].x, p[1].x), dp_maxf(p[2].x, q.x));
    const float y1 = dp_maxf(dp_maxf(p[0].y, p[1].y), dp_maxf(p[2].y, q.y));
    if (!(x1 > 0 && y1 > 0 && x0 < DP_TILE && y0 < DP_TILE)) return false;
    const int32_t sign = INT32_MIN;
    const dp_f4 px = {p[0].x, p[1].x, p[2].x, q.x}, py = {p[0].y, p[1].y, p[2].y, q.y};
    const dp_f4 qx = {p[1].x, p[2].x, q.x, p[0].x}, qy = {p[1].y, p[2].y, q.y, p[0].y};
    const float area =
        n == 4 ? (p[2].x - p[0].x) * (q.y - p[1].y) - (p[2].y - p[0].y) * (q.x - p[1].x)
               : (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x);
    const dp_i4 swap = (py > qy) | ((py == qy) & (px > qx)),
                flip = splat(area < 0 ? UINT32_MAX : 0);
    const dp_f4 sx = dp_select(swap, qx, px), sy = dp_select(swap, qy, py);
    const dp_f4 a = sy - dp_select(swap, py, qy), b = dp_select(swap, px, qx) - sx;
    const dp_f4 c = a * sx + b * sy;
    const dp_i4 turn = (swap ^ flip) & (dp_i4){sign, sign, sign, sign};
    out->a = (dp_f4)((dp_i4)a ^ turn), out->b = (dp_f4)((dp_i4)b ^ turn),
    out->c = (dp_f4)((dp_i4)-c ^ turn);
    out->threshold =
        (dp_f4)((dp_i4)dp_splat(1.1754944e-38f) & (swap ^ flip)); /* the least positive number */
    out->corners = n;
    out->box[0] = (uint8_t)dp_tile_px(x0), out->box[1] = (uint8_t)dp_tile_px(y0);
    out->box[2] = (uint8_t)dp_tile_px(x1), out->box[3] = (uint8_t)dp_tile_px(y1);
    return true;
}

static void fill_by_kernel(dp_brush *b, const dp_point *p, uint32_t n, dp_ink_test test) {
    void (*const ink)(dp_brush *, const dp_ink_shape *) =
        dp_printed_kernels_for(b->w->tile->frame->lanes)->ink;
    dp_ink_shape shape;
    b->test = test;
    if (n <= 4) {
        if (make_shape(p, n, &shape)) ink(b, &shape);
        return;
    }
    for (uint32_t i = 2; i < n; i++) {
        const dp_point triangle[3] = {p[0], p[i - 1], p[i]};
        if (make_shape(triangle, 3, &shape)) ink(b, &shape);
    }
}

void dp_fill_line(dp_brush *b, const dp_point *p, uint32_t n) {
    fill_by_kernel(b, p, n, DP_INK_NEAREST);
}
void dp_fill_joint(dp_brush *b, const dp_point *p, uint32_t n) {
    fill_by_kernel(b, p, n, DP_INK_JOINT);
}
void dp_fill_between_planes(dp_brush *b, const dp_point *p, uint32_t n) {
    fill_by_kernel(b, p, n, DP_INK_TRAPPED);
}

#define DEFINE_FILL(name, test)                                                                    \
    void name(dp_brush *b, const dp_point *p, uint32_t n) {                                        \
        const dp_sampling *const s = &b->w->tile->sampling;                                        \
        dp_coverage area;                                                                          \
        for (uint32_t i = 2; i < n; i++) {                                                         \
            if (!dp_coverage_make(p[0], p[i - 1], p[i], &area)) continue;                          \
            if (s->vectors == 1)                                                                   \
                dp_coverage_fill(s, &area, &b->plane, 1, test, b);                                 \
            else                                                                                   \
                dp_coverage_fill(s, &area, &b->plane, s->vectors, test, b);                        \
        }                                                                                          \
    }
static dp_fill fill_marked;
DEFINE_FILL(fill_marked, draw_marked)
DEFINE_FILL(dp_fill_marked_interval, draw_marked_interval)
DEFINE_FILL(dp_fill_interval, draw_interval)
DEFINE_FILL(dp_fill_trap_in_interval, trap_in_interval)
DEFINE_FILL(dp_fill_count_down, count_down)
DEFINE_FILL(dp_fill_count_up, count_up)

void dp_fill_marked_line(dp_brush *b, const dp_point *p, uint32_t n) {
    b->test = DP_INK_NEAREST;
    fill_marked(b, p, n);
}
void dp_fill_marked_joint(dp_brush *b, const dp_point *p, uint32_t n) {
    b->test = DP_INK_JOINT;
    fill_marked(b, p, n);
}
