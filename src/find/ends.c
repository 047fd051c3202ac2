/* Ends of visible pieces, solved: between the last sample point of a piece and the next one, which
 * is hidden, the place where the stretch begins that hides it.
 *
 *    note     the two points of each end, as pieces are made                dp_note_end
 *    list     seen polygons near them, in front of them                     hide.inc
 *    clip     each polygon hides an interval of the line through both:      clip_to_hidden
 *             inside all its edges, and nearer than the limit
 *    follow   from the hidden point back: the union of intervals that
 *             touch begins at the end                                       follow
 *
 * The line is that of the sample points, lifted off the surface (core/spine.h), and what hides it
 * is what would hide a sample point: all are linear along it, so an interval is exact but for
 * rounding. Polygons are placed on the screen again, in double precision, as an edge that crosses
 * the line at a small angle magnifies an error of float32 coordinates.
 *
 * Invariant: what is found depends on the set of polygons alone, not on their order, which differs
 * with the width of vectors. Where the next point is another tile's, its tile may see it: the two
 * pieces are joined then, and the end is forgotten (strokes/segments.c). Not handled: hidden
 * stretches that end before the next sample point; clipped polygons are taken as the tile has
 * them. */
#include "find/finder.h"
#include "find/kernels.h"

/* px: polygons beside each other may leave a gap this wide, by rounding; … */
static const double BRIDGED = 1e-4;

/* … and what hides the next sample point may begin this far behind it: its coordinates and limit are
 * rounded, and an edge may cross the line at a small angle. */
static const double MISSED = 0.01;

/* ------- which ends ------- */

/* Sample point k of a candidate, in tile space; d: how near a polygon must be to hide it. */
static dp_pointd point_of(const dp_finder *w, uint32_t candidate, uint32_t k) {
    const dp_pointd *const s = w->ends.spines[candidate];
    const dp_pointd p = dp_point_mix(s[0], s[1], (k + 0.5) / w->lines.candidates[candidate].n);
    return (dp_pointd){p.x - w->tile.tile_x, p.y - w->tile.tile_y,
                       p.d + dp_depth_step(&w->tile.frame->view, p.d, DP_PROBE_SLACK)};
}

void dp_note_end(dp_finder *w, uint32_t candidate, size_t piece, uint32_t side) {
    const dp_piece *const p = &w->found->pieces[piece];
    const uint32_t k = side ? p->k1 - 1 : p->k0;
    if (!DP_TILE_RESERVE(&w->tile, w, ends.ends, ends.ends_cap, w->ends.count + 1u)) return;
    w->ends.ends[w->ends.count++] =
        (dp_open_end){.piece = piece,
                      .candidate = candidate,
                      .side = side,
                      .from = point_of(w, candidate, k),
                      .to = point_of(w, candidate, side ? k + 1 : k - 1)};
}

/* ------- what a polygon hides ------- */

/* A polygon on the screen: twice its area, its plane, its nearest point. */
typedef struct outline {
    double area, d0, dx, dy, nearest;
} outline;

/* Corner i in tile space. */
static dp_pointd corner_of(const dp_finder *w, const dp_tile_polygon *p, uint32_t i) {
    const dp_frame *const f = w->tile.frame;
    const uint32_t corner = dp_first_corner(&f->polygons, p->id) + i;
    if (p->flags & DP_POLYGON_CLIPPED) {
        const dp_vertex v = w->tile.points[p->point + i];
        return (dp_pointd){(double)v.x, (double)v.y, (double)v.d};
    }
    const float *const at =
        dp_vertex_position(&f->polygons, dp_corner_vertex(&f->polygons, corner));
    const dp_pointd s = dp_to_screen(&f->view, dp_to_clip(&f->view, dp_v3f(at)));
    return (dp_pointd){s.x - w->tile.tile_x, s.y - w->tile.tile_y, s.d};
}

/* Its plane goes through the first corner; its normal is that of Newell. */
static outline outline_of(const dp_finder *w, const dp_tile_polygon *p) {
    const dp_pointd o = corner_of(w, p, 0);
    dp_pointd a = corner_of(w, p, 1);
    double nx = 0, ny = 0, nz = 0, nearest = dp_max(o.d, a.d);
    for (uint32_t i = 2; i < p->points; i++) {
        const dp_pointd b = corner_of(w, p, i);
        const double ax = a.x - o.x, ay = a.y - o.y, ad = a.d - o.d;
        const double bx = b.x - o.x, by = b.y - o.y, bd = b.d - o.d;
        nx += ay * bd - ad * by, ny += ad * bx - ax * bd, nz += ax * by - ay * bx;
        nearest = dp_max(nearest, b.d);
        a = b;
    }
    const double dx = -nx / nz, dy = -ny / nz;
    return (outline){nz, o.d - dx * o.x - dy * o.y, dx, dy, nearest};
}

/* Keeps the part of [*from, *to] where a function that is linear along the line is above zero. */
static void keep_above(double *from, double *to, double at_0, double at_1) {
    const double step = at_1 - at_0;
    if (step > 0)
        *from = dp_max(*from, -at_0 / step);
    else if (step < 0)
        *to = dp_min(*to, -at_0 / step);
    else if (at_0 < 0)
        *to = -INFINITY;
}

/* How far a point lies on the inner side of the edge from a to b. */
static double inside(double area, dp_pointd a, dp_pointd b, dp_pointd p) {
    const double e = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
    return area < 0 ? -e : e;
}

static double before(const outline *o, dp_pointd p) {
    return o->d0 + o->dx * p.x + o->dy * p.y - p.d;
}

/* Finds what a polygon hides of an end's line, up to a sample point further either way. */
static void find_hidden(const dp_finder *w, const dp_open_end *e, dp_end_hider *h) {
    const dp_tile_polygon *const p = &w->tile.polygons[h->polygon];
    const outline o = outline_of(w, p);
    h->from = -1, h->to = o.area != 0 ? 2 : -INFINITY;
    dp_pointd a = corner_of(w, p, p->points - 1u);
    for (uint32_t k = 0; k < p->points && h->from < h->to; k++) {
        const dp_pointd b = corner_of(w, p, k);
        keep_above(&h->from, &h->to, inside(o.area, a, b, e->from), inside(o.area, a, b, e->to));
        a = b;
    }
    keep_above(&h->from, &h->to, before(&o, e->from), before(&o, e->to));
    keep_above(&h->from, &h->to, o.nearest - e->from.d, o.nearest - e->to.d);
}

/* ------- where the stretch begins ------- */

/* A hidden stretch, as far as it has been followed. */
typedef struct stretch {
    double begin;
    uint32_t hider; /* polygon of the frame whose interval begins there */
} stretch;

/* Follows a stretch to the earliest interval that reaches its beginning, or to within `gap` of it.
 * Of two that begin together the lower number counts. False: there is none. */
static bool follow(const dp_finder *w, const dp_open_end *e, double gap, stretch *s) {
    const double least = s->begin - gap;
    bool found = false;
    for (uint32_t i = e->hider; i; i = w->ends.hiders[i - 1].next) {
        const dp_end_hider *const h = &w->ends.hiders[i - 1];
        const uint32_t id = w->tile.polygons[h->polygon].id;
        if (!(h->from < h->to) || h->to < least) continue;
        if (h->from < s->begin || (h->from == s->begin && id < s->hider))
            *s = (stretch){h->from, id}, found = true;
    }
    return found;
}

static void solve(dp_finder *w, const dp_open_end *e) {
    const double x = e->to.x - e->from.x, y = e->to.y - e->from.y, length = sqrt(x * x + y * y),
                 missed = MISSED / length;
    stretch s = {1 + missed, UINT32_MAX};
    if (!(length > 0)) return;
    for (uint32_t i = e->hider; i; i = w->ends.hiders[i - 1].next)
        find_hidden(w, e, &w->ends.hiders[i - 1]);
    if (!follow(w, e, 2 * missed, &s)) return;
    while (s.begin > 0 && follow(w, e, BRIDGED / length, &s)) continue;
    dp_piece *const p = &w->found->pieces[e->piece];
    const float from_middle = (float)(dp_max(s.begin, 0) - 0.5);
    p->end[e->side] = e->side ? from_middle : -from_middle;
    p->hider[e->side] = s.hider;
}

void dp_solve_ends(dp_finder *w) {
    if (w->ends.count && dp_group_ends(w)) {
        w->ends.hider_count = 0;
        dp_find_kernels_for(w->tile.frame->lanes)->list_hiders(w);
        for (uint32_t i = 0; i < w->ends.count && !w->tile.failed; i++) solve(w, &w->ends.ends[i]);
    }
    w->ends.count = 0;
}

/* ------- memory ------- */

static const dp_array arrays[] = {DP_ARRAY(dp_end_store, spines, spines_cap),
                                  DP_ARRAY(dp_end_store, ends, ends_cap),
                                  DP_ARRAY(dp_end_store, hiders, hiders_cap)};

void dp_end_store_free(dp_end_store *store, const dp_allocator *memory) {
    dp_arrays_free(memory, store, DP_ARRAYS(arrays));
}

uint64_t dp_end_store_bytes(const dp_end_store *store) {
    return dp_arrays_bytes(store, DP_ARRAYS(arrays));
}
