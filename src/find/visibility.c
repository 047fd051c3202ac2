/* Visibility of lines: a sample point of a spine is hidden if another polygon is nearer there.
 *
 *    add     cut the spine to the tile, make its sample points            points.inc
 *    group   up to DP_GROUP consecutive points, with their box and least limit;
 *            sort groups by cell (counting sort)                          make_groups
 *    hide    points behind a seen polygon get an infinite limit           hide.inc
 *    collect runs of visible points become pieces                         dp_collect_pieces
 *
 * (Raskar 2001, 2.2) asks at each sample of the image which added polygon wins the depth test. Here
 * each polygon of the tile is rasterized onto the points that matter instead (an irregular depth
 * buffer). The answer is exact for edges far smaller than a pixel and does not depend on the number
 * of samples.
 *
 * Data structure: sample points in the order in which they are made; groups sorted by cell, so that
 * those near a polygon are consecutive; the least limit of blocks of cells, by which most polygons
 * are found to hide nothing. Invariants: a point belongs to the tile whose pixel it lies in, and a
 * candidate's points in a tile are consecutive, [k0, k1). Not handled: what hides a line between
 * two sample points, unless a line ends there (ends.c). */
#include "base/hostile.h"
#include "find/kernels.h"
#include "find/finder.h"

#include <string.h>

/* Does this tile own the point? Decided by the pixel it lies in, so all tiles agree. */
static bool owned(const dp_finder *w, dp_pointd p) {
    return p.x >= w->tile.tile_x && p.y >= w->tile.tile_y && p.x < w->tile.tile_x + DP_TILE &&
           p.y < w->tile.tile_y + DP_TILE && p.x < w->tile.frame->view.width &&
           p.y < w->tile.frame->view.height;
}

static dp_pointd probe_point(const dp_spine *s, uint32_t k) {
    return dp_point_mix(s->probe_a, s->probe_b, (k + 0.5) / s->n);
}

/* Is the point so far inside that points between two such points are the tile's too, even when
 * rounded? */
static bool well_inside(const dp_finder *w, dp_pointd p) {
    const double slack = 1e-6, x = p.x - w->tile.tile_x, y = p.y - w->tile.tile_y;
    const double width = dp_min(DP_TILE, (double)w->tile.frame->view.width - w->tile.tile_x),
                 height = dp_min(DP_TILE, (double)w->tile.frame->view.height - w->tile.tile_y);
    return x >= slack && y >= slack && x < width - slack && y < height - slack;
}

/* Which sample points may be the tile's: the cut, and one more on either side for rounding. Most
 * spines are short and lie inside wholly. */
static bool find_range(const dp_finder *w, const dp_spine *s, uint32_t *k0, uint32_t *k1) {
    if (well_inside(w, s->probe_a) && well_inside(w, s->probe_b)) return *k0 < *k1;
    double t0 = 0, t1 = 1;
    dp_cut_range(s->probe_a.x, s->probe_b.x, w->tile.tile_x, w->tile.tile_x + DP_TILE, &t0, &t1);
    dp_cut_range(s->probe_a.y, s->probe_b.y, w->tile.tile_y, w->tile.tile_y + DP_TILE, &t0, &t1);
    if (t0 > t1) return false;
    const double lo = t0 * s->n - 1.5, hi = t1 * s->n + 2.5;
    if (lo > *k0) *k0 = (uint32_t)lo;
    if (hi < *k1) *k1 = (uint32_t)hi;
    while (*k0 < *k1 && !owned(w, probe_point(s, *k0))) ++*k0;
    while (*k0 < *k1 && !owned(w, probe_point(s, *k1 - 1))) --*k1;
    return *k0 < *k1;
}

static bool reserve_probes(dp_finder *w, size_t need) {
    return DP_TILE_RESERVE(&w->tile, w, lines.probes.x, lines.probe_x_cap, need) &&
           DP_TILE_RESERVE(&w->tile, w, lines.probes.y, lines.probe_y_cap, need) &&
           DP_TILE_RESERVE(&w->tile, w, lines.probes.limit, lines.probe_limit_cap, need);
}

/* Keeps what segments will be made from. Beyond the limit it returns 0, and it is computed
 * again. */
static uint32_t keep_geometry(dp_finder *w, const dp_spine *spine, const dp_vec3 normals[2]) {
    const uint32_t most = DP_TUNED((1u << 24) - 1, 100);
    if (w->found->geometry_count == most ||
        !DP_TILE_RESERVE(&w->tile, w, found->geometry, found->geometry_cap,
                         w->found->geometry_count + 1u))
        return 0;
    w->found->geometry[w->found->geometry_count++] =
        (dp_segment_geometry){spine->a, spine->b, {normals[0], normals[1]}};
    return w->found->geometry_count;
}

/* Keeps where the next candidate's sample points lie, for its ends. */
static bool keep_spine(dp_finder *w, const dp_spine *spine) {
    const uint32_t at = w->lines.candidate_count;
    if (!DP_TILE_RESERVE(&w->tile, w, ends.spines, ends.spines_cap, at + 1u)) return false;
    w->ends.spines[at][0] = spine->probe_a, w->ends.spines[at][1] = spine->probe_b;
    return true;
}

void dp_add_candidate(dp_finder *w, dp_candidate c, const dp_spine *spine,
                      const dp_vec3 normals[2]) {
    if (c.k1 > spine->n) c.k1 = spine->n;
    if (!find_range(w, spine, &c.k0, &c.k1)) return;
    if (!DP_TILE_RESERVE(&w->tile, w, lines.candidates, lines.candidates_cap,
                         w->lines.candidate_count + 1u) ||
        !reserve_probes(w, (size_t)w->lines.probe_count + (c.k1 - c.k0) + DP_PROBES_ROOM))
        return;
    c.n = spine->n;
    c.probe = w->lines.probe_count;
    c.geometry = (normals ? keep_geometry(w, spine, normals) : 0) & 0xffffff;
    if (w->tile.frame->exact_ends && !keep_spine(w, spine)) return;
    w->lines.candidates[w->lines.candidate_count++] = c;
    dp_find_kernels_for(w->tile.frame->lanes)
        ->points(w, spine, c.k0, c.k1, &w->lines.probes, c.probe);
    w->lines.probe_count += c.k1 - c.k0;
}

/* ------- groups ------- */

/* Box of a group's points, in quarters of a pixel, and the least of their limits. */
typedef struct bounds {
    uint32_t x0, y0, x1, y1;
    float limit;
} bounds;

static uint32_t quarter_at(float px) {
    return !(px > 0) ? 0 : px >= DP_TILE ? DP_QUARTERS - 1 : (uint32_t)(4 * px);
}

/* Of points along a straight spine: the ends give the bounds. If an end is hidden, its limit is
 * infinite, and all points must be looked at. */
static bounds bounds_of(const dp_probes *probes, uint32_t first, uint32_t last) {
    const float la = probes->limit[first], lb = probes->limit[last];
    const uint32_t xa = quarter_at(probes->x[first]), xb = quarter_at(probes->x[last]),
                   ya = quarter_at(probes->y[first]), yb = quarter_at(probes->y[last]);
    bounds b = {xa < xb ? xa : xb, ya < yb ? ya : yb, xa < xb ? xb : xa, ya < yb ? yb : ya,
                dp_minf(la, lb)};
    if (dp_maxf(la, lb) == INFINITY)
        for (uint32_t i = first; i < last; i++) b.limit = dp_minf(b.limit, probes->limit[i]);
    return b;
}

enum { CELL_QUARTERS = 4 * DP_CELL };

/* Index of the last point in the group that begins with point `first`, of candidate c. */
static uint32_t group_last(const dp_candidate *c, uint32_t first) {
    const uint32_t end = c->probe + (c->k1 - c->k0);
    return (end - first < DP_GROUP ? end : first + DP_GROUP) - 1;
}

static uint32_t cell_of(const bounds *b) {
    return b->y0 / CELL_QUARTERS * DP_CELLS + b->x0 / CELL_QUARTERS;
}

/* Puts a group into its cell, from the end of the cell's run towards its start. */
static void put_group(dp_probe_groups *out, dp_probe_group group, const bounds *b) {
    const uint32_t at = --out->first[cell_of(b)];
    out->group[at] = group;
    out->box[at] = b->x0 | b->y0 << 8 | (255 - b->x1) << 16 | (255 - b->y1) << 24;
    out->limit[at] = b->limit;
    if (b->x1 - b->x0 > out->width) out->width = b->x1 - b->x0;
    if (b->y1 - b->y0 > out->height) out->height = b->y1 - b->y0;
    for (uint32_t y = b->y0 / CELL_QUARTERS; y <= b->y1 / CELL_QUARTERS; y++)
        for (uint32_t x = b->x0 / CELL_QUARTERS; x <= b->x1 / CELL_QUARTERS; x++) {
            float *const least = &out->least[0][0][y * DP_CELLS + x];
            *least = dp_minf(b->limit, *least);
        }
}

static bool reserve_groups(dp_finder *w, uint32_t count) {
    const size_t room = (size_t)count + DP_PROBES_ROOM;
    return DP_TILE_RESERVE(&w->tile, w, lines.groups.group, lines.groups.group_cap, count) &&
           DP_TILE_RESERVE(&w->tile, w, lines.groups.box, lines.groups.box_cap, room) &&
           DP_TILE_RESERVE(&w->tile, w, lines.groups.limit, lines.groups.limit_cap, room);
}

/* Counts a group in its cell, or puts it there. */
static inline void visit_group(dp_finder *w, bool counting, dp_probe_group group, const bounds *b) {
    if (counting)
        w->lines.groups.first[cell_of(b)]++;
    else
        put_group(&w->lines.groups, group, b);
}

/* All groups of sample points that are not hidden. */
static void visit_points(dp_finder *w, bool counting) {
    for (uint32_t k = 0; k < w->lines.candidate_count; k++) {
        const dp_candidate *const c = &w->lines.candidates[k];
        for (uint32_t i = c->probe; i < c->probe + (c->k1 - c->k0); i += DP_GROUP) {
            const uint32_t last = group_last(c, i);
            const bounds b = bounds_of(&w->lines.probes, i, last);
            if (b.limit == INFINITY) continue; /* all are hidden */
            visit_group(w, counting, (dp_probe_group){i, last + 1 - i, k}, &b);
        }
    }
}

/* Sorts groups by cell (counting sort), and finds each cell's least limit. */
static bool make_groups(dp_finder *w, void (*visit)(dp_finder *w, bool counting)) {
    dp_probe_groups *const out = &w->lines.groups;
    uint32_t sum = 0;
    for (uint32_t i = 0; i < DP_CELL_ROOM; i++) out->least[0][0][i] = INFINITY;
    memset(out->first, 0, sizeof out->first);
    out->width = out->height = 0;
    visit(w, true);
    for (uint32_t i = 0; i < DP_CELLS * DP_CELLS; i++) out->first[i] = sum += out->first[i];
    out->first[DP_CELLS * DP_CELLS] = sum;
    if (!reserve_groups(w, sum)) return false;
    visit(w, false);
    return true;
}

/* Ends are groups of two points, of which the second may be another tile's. */
static void visit_ends(dp_finder *w, bool counting) {
    for (uint32_t i = 0; i < w->ends.count; i++) {
        const dp_open_end *const e = &w->ends.ends[i];
        const float slack = 1e-3f; /* px: coordinates are rounded */
        const bounds b = {quarter_at((float)dp_min(e->from.x, e->to.x) - slack),
                          quarter_at((float)dp_min(e->from.y, e->to.y) - slack),
                          quarter_at((float)dp_max(e->from.x, e->to.x) + slack),
                          quarter_at((float)dp_max(e->from.y, e->to.y) + slack),
                          (float)dp_min(e->from.d, e->to.d)};
        visit_group(w, counting, (dp_probe_group){i, 2, e->candidate}, &b);
    }
}

bool dp_group_ends(dp_finder *w) { return make_groups(w, visit_ends); }

/* ------- pieces and what hides their ends ------- */

/* A run of visible sample points, as numbers of the candidate's, and one of its ends. */
typedef struct run_end {
    uint32_t point;  /* the visible one at the end, as a probe */
    uint32_t inward; /* the next one the other way, hidden where the run is of one point; the same
                        where that is another tile's */
    uint32_t beyond; /* the next one outside; UINT32_MAX where it is another tile's */
} run_end;

/* Where the sample point beyond an end lies, and how near a polygon must be to hide it. The point's
 * own limit is infinite, as it is hidden; this one continues those of the run, or is that of the
 * run's only point. */
static void point_beyond(const dp_probes *p, const run_end *e, float *x, float *y, float *limit) {
    const bool known = e->beyond != UINT32_MAX;
    *x = known ? p->x[e->beyond] : 2 * p->x[e->point] - p->x[e->inward];
    *y = known ? p->y[e->beyond] : 2 * p->y[e->point] - p->y[e->inward];
    const float end = p->limit[e->point], inward = p->limit[e->inward];
    *limit = inward < INFINITY ? 2 * end - inward : end;
}

/* Does the polygon's plane lie nearer than `limit` at a point? Not if it is the line's own. */
static bool lies_before(const dp_tile *t, const dp_candidate *c, uint32_t index, float x, float y,
                        float limit) {
    const dp_tile_polygon *const p = &t->polygons[index];
    return p->id != c->a && p->id != c->b && dp_minf(dp_plane_at(p, x, y), p->nearest) > limit;
}

/* A search for what hides a point of the tile. */
typedef struct hider_search {
    const dp_tile *tile;
    const dp_candidate *candidate;
    float x, y, limit;
    float least;    /* distance of the nearest sample so far, px, squared */
    uint32_t hider; /* whose sample that is, a polygon of the frame */
} hider_search;

/* Distance of sample i of pixel (px, py) from the point, px, squared. */
static float sample_distance(const hider_search *h, uint32_t px, uint32_t py, uint32_t i) {
    const dp_sampling *const s = &h->tile->sampling;
    const float x = s->samples == 1 ? 0.5f : s->x[i / 4][i % 4],
                y = s->samples == 1 ? 0.5f : s->y[i / 4][i % 4];
    const float dx = h->x - (float)px - x, dy = h->y - (float)py - y;
    return dx * dx + dy * dy;
}

/* Looks at what has won the pixel's samples; true when a polygon covers the point itself. */
static bool search_pixel(hider_search *h, uint32_t px, uint32_t py) {
    const dp_tile *const t = h->tile;
    const uint32_t *const winner = t->winner + dp_pixel_lane(&t->sampling, px, py);
    for (uint32_t i = 0, last = UINT32_MAX; i < t->sampling.samples; i++) {
        if (winner[i] == last) continue;
        last = winner[i];
        if (last == UINT32_MAX || !lies_before(t, h->candidate, last, h->x, h->y, h->limit))
            continue;
        const bool covers = dp_tile_covers(t, &t->polygons[last], h->x, h->y);
        const float distance = covers ? 0 : sample_distance(h, px, py, i);
        if (distance < h->least) h->least = distance, h->hider = t->polygons[last].id;
        if (covers) return true;
    }
    return false;
}

/* What has won samples of the point's pixel, or else of those around it, and lies before the point:
 * the polygon that covers it, else that of the nearest sample, which hides the line a little
 * further on. */
static uint32_t find_hider(const dp_tile *t, const dp_candidate *c, float x, float y, float limit) {
    hider_search h = {t, c, x, y, limit, INFINITY, (uint32_t)DP_HIDER_UNKNOWN};
    /* a point at the far border may be rounded onto it */
    const uint32_t px = (uint32_t)dp_minf(dp_maxf(x, 0), DP_TILE - 1),
                   py = (uint32_t)dp_minf(dp_maxf(y, 0), DP_TILE - 1);
    if (search_pixel(&h, px, py) || h.least < INFINITY) return h.hider;
    for (uint32_t qy = py ? py - 1 : 0; qy <= py + 1 && qy < DP_TILE; qy++)
        for (uint32_t qx = px ? px - 1 : 0; qx <= px + 1 && qx < DP_TILE; qx++)
            if (search_pixel(&h, qx, qy)) return h.hider;
    return h.hider;
}

static uint32_t hider_at(const dp_finder *w, const dp_candidate *c, const run_end *e) {
    const dp_view *const view = &w->tile.frame->view;
    float x, y, limit;
    point_beyond(&w->lines.probes, e, &x, &y, &limit);
    const double at_x = (double)x + w->tile.tile_x, at_y = (double)y + w->tile.tile_y;
    if (at_x < 0 || at_y < 0 || at_x >= view->width || at_y >= view->height)
        return (uint32_t)DP_HIDER_PICTURE;
    /* In another tile the line most often goes on, and the search would find nothing. */
    if (w->lines.streamed || e->beyond == UINT32_MAX) return (uint32_t)DP_HIDER_UNKNOWN;
    return find_hider(&w->tile, c, x, y, limit);
}

/* Is there a next sample point in the picture? */
static bool goes_on(uint32_t hider) {
    return hider != (uint32_t)DP_HIDER_NONE && hider != (uint32_t)DP_HIDER_PICTURE;
}

static void note_ends(dp_finder *w, const dp_candidate *c) {
    const size_t piece = w->found->piece_count - 1;
    for (uint32_t side = 0; side < 2; side++)
        if (goes_on(w->found->pieces[piece].hider[side]))
            dp_note_end(w, (uint32_t)(c - w->lines.candidates), piece, side);
}

static void add_piece(dp_finder *w, const dp_candidate *c, uint32_t k0, uint32_t k1) {
    if (!DP_TILE_RESERVE(&w->tile, w, found->pieces, found->pieces_cap, w->found->piece_count + 1))
        return;
    const uint32_t first = c->probe + (k0 - c->k0), last = c->probe + (k1 - 1 - c->k0);
    const bool starts = k0 == c->k0, ends = k1 == c->k1; /* with the tile's part of the spine */
    const run_end start = {first, first < last || !ends ? first + 1 : first,
                           starts ? UINT32_MAX : first - 1};
    const run_end end = {last, first < last || !starts ? last - 1 : last,
                         ends ? UINT32_MAX : last + 1};
    w->found->pieces[w->found->piece_count++] =
        (dp_piece){.a = c->a,
                   .b = c->b,
                   .edge = c->edge,
                   .k0 = k0,
                   .k1 = k1,
                   .n = c->n,
                   .hider = {k0 > 0 ? hider_at(w, c, &start) : (uint32_t)DP_HIDER_NONE,
                             k1 < c->n ? hider_at(w, c, &end) : (uint32_t)DP_HIDER_NONE},
                   .geometry = c->geometry,
                   .line = c->line,
                   .seen = c->seen,
                   .open = (k0 == c->k0 && k0 > 0) || (k1 == c->k1 && k1 < c->n)};
    if (w->tile.frame->exact_ends) note_ends(w, c);
}

/* Makes pieces of a candidate's runs of visible sample points. */
static void collect(dp_finder *w, const dp_candidate *c) {
    uint32_t start = c->k0;
    for (uint32_t k = c->k0; k <= c->k1; k++) {
        const bool visible = k < c->k1 && w->lines.probes.limit[c->probe + (k - c->k0)] < INFINITY;
        if (visible) continue;
        if (k > start) add_piece(w, c, start, k);
        start = k + 1;
    }
}

void dp_hide_points(dp_finder *w) {
    if (w->lines.probe_count && make_groups(w, visit_points))
        dp_find_kernels_for(w->tile.frame->lanes)->hide(w);
}

void dp_collect_pieces(dp_finder *w) {
    for (uint32_t i = 0; i < w->lines.candidate_count && !w->tile.failed; i++)
        collect(w, &w->lines.candidates[i]);
    dp_solve_ends(w);
}

void dp_find_visible(dp_finder *w) {
    dp_hide_points(w);
    dp_collect_pieces(w);
}

/* ------- memory ------- */

static const dp_array arrays[] = {DP_ARRAY(dp_line_store, candidates, candidates_cap),
                                  DP_ARRAY(dp_line_store, probes.x, probe_x_cap),
                                  DP_ARRAY(dp_line_store, probes.y, probe_y_cap),
                                  DP_ARRAY(dp_line_store, probes.limit, probe_limit_cap),
                                  DP_ARRAY(dp_line_store, level, level_cap),
                                  DP_ARRAY(dp_line_store, stacks, stacks_cap),
                                  DP_ARRAY(dp_line_store, through, through_cap),
                                  DP_ARRAY(dp_line_store, groups.group, groups.group_cap),
                                  DP_ARRAY(dp_line_store, groups.box, groups.box_cap),
                                  DP_ARRAY(dp_line_store, groups.limit, groups.limit_cap)};

void dp_line_store_free(dp_line_store *store, const dp_allocator *memory) {
    dp_arrays_free(memory, store, DP_ARRAYS(arrays));
}

uint64_t dp_line_store_bytes(const dp_line_store *store) {
    return dp_arrays_bytes(store, DP_ARRAYS(arrays));
}
