/* Visibility of spines: sample points on them, hidden by whatever polygon covers them nearer.
 *
 * This is the depth test of the paper's emergent lines taken to the lines themselves: instead of
 * asking at fixed samples which added polygon wins, every polygon of the tile is rasterized onto
 * the points that matter (an irregular depth buffer). The answer is exact for edges far below a
 * pixel and owes nothing to the number of samples.
 *
 * Data structure: probes sorted by pixel, so that those in a row of a polygon's box follow each
 * other, and the least limit in a few cells of pixels side by side, which tells that most polygons
 * hide none. A spine's points belong to the tile whose pixel they lie in. Invariant: the
 * points of one candidate in a tile are consecutive, k0 to k1. */
#include "kernel/kernels.h"
#include "pipe/tile.h"

#include <string.h>

/* The tile that owns a point, by the pixel it lies in: the same answer in every tile. */
static bool owned(const dp_tile_worker *w, dp_pointd p) {
    return p.x >= w->tile_x && p.y >= w->tile_y && p.x < w->tile_x + DP_TILE &&
           p.y < w->tile_y + DP_TILE && p.x < w->frame->view.width && p.y < w->frame->view.height;
}

/* Cuts [*t0, *t1] to where from + t * (to - from) lies in [lo, hi]. */
static void cut(double from, double to, double lo, double hi, double *t0, double *t1) {
    const double step = to - from;
    if (step == 0) {
        if (from < lo || from > hi) *t1 = -1;
        return;
    }
    const double a = (lo - from) / step, b = (hi - from) / step;
    *t0 = dp_max(*t0, dp_min(a, b));
    *t1 = dp_min(*t1, dp_max(a, b));
}

static dp_pointd probe_point(const dp_spine *s, uint32_t k) {
    return dp_point_mix(s->probe_a, s->probe_b, (k + 0.5) / s->n);
}

/* So far inside that points between two such ones are the tile's too, however they are rounded. */
static bool well_inside(const dp_tile_worker *w, dp_pointd p) {
    const double slack = 1e-6, x = p.x - w->tile_x, y = p.y - w->tile_y;
    const double width = dp_min(DP_TILE, (double)w->frame->view.width - w->tile_x),
                 height = dp_min(DP_TILE, (double)w->frame->view.height - w->tile_y);
    return x >= slack && y >= slack && x < width - slack && y < height - slack;
}

/* Which sample points may be the tile's: one more on either side than the cut says, and of most
 * spines, which are short, all. */
static bool find_range(const dp_tile_worker *w, const dp_spine *s, uint32_t *k0, uint32_t *k1) {
    if (well_inside(w, s->probe_a) && well_inside(w, s->probe_b)) return *k0 < *k1;
    double t0 = 0, t1 = 1;
    cut(s->probe_a.x, s->probe_b.x, w->tile_x, w->tile_x + DP_TILE, &t0, &t1);
    cut(s->probe_a.y, s->probe_b.y, w->tile_y, w->tile_y + DP_TILE, &t0, &t1);
    if (t0 > t1) return false;
    const double lo = t0 * s->n - 1.5, hi = t1 * s->n + 2.5;
    if (lo > *k0) *k0 = (uint32_t)lo;
    if (hi < *k1) *k1 = (uint32_t)hi;
    while (*k0 < *k1 && !owned(w, probe_point(s, *k0))) ++*k0;
    while (*k0 < *k1 && !owned(w, probe_point(s, *k1 - 1))) --*k1;
    return *k0 < *k1;
}

void dp_tile_add_candidate(dp_tile_worker *w, dp_candidate c, const dp_spine *spine) {
    if (c.k1 > spine->n) c.k1 = spine->n;
    if (!find_range(w, spine, &c.k0, &c.k1)) return;
    if (!DP_WORKER_RESERVE(w, candidates, candidates_cap, w->candidate_count + 1u) ||
        !DP_WORKER_RESERVE(w, probes, probes_cap,
                           (size_t)w->probe_count + (c.k1 - c.k0) + DP_PROBES_ROOM))
        return;
    c.n = spine->n;
    c.probe = w->probe_count;
    w->candidates[w->candidate_count++] = c;
    w->frame->kernels->points(w, spine, c.k0, c.k1, w->probes + c.probe);
    w->probe_count += c.k1 - c.k0;
}

/* Is the point on the inner side of a -> b? Computed in one canonical order of the ends, so that of
 * two polygons that share an edge exactly one has it. */
static bool left_of(dp_vertex a, dp_vertex b, float x, float y, bool flip) {
    const bool swap = a.y > b.y || (a.y == b.y && a.x > b.x);
    const dp_vertex s = swap ? b : a, t = swap ? a : b;
    const double e =
        ((double)t.x - s.x) * ((double)y - s.y) - ((double)t.y - s.y) * ((double)x - s.x);
    return swap != flip ? e < 0 : e >= 0;
}

bool dp_tile_covers(const dp_tile_worker *w, const dp_tile_polygon *polygon, float x, float y) {
    const dp_vertex *const p = w->points + polygon->point;
    const bool front = polygon->flags & DP_POLYGON_FRONT;
    for (uint32_t i = 0; i < polygon->points; i++)
        if (!left_of(p[i], p[i + 1 == polygon->points ? 0 : i + 1], x, y, front)) return false;
    return true;
}

static bool reserve_sorted(dp_tile_worker *w, size_t need) {
    return DP_WORKER_RESERVE(w, places, places_cap, need) &&
           DP_WORKER_RESERVE(w, sorted.x, sorted.x_cap, need) &&
           DP_WORKER_RESERVE(w, sorted.y, sorted.y_cap, need) &&
           DP_WORKER_RESERVE(w, sorted.limit, sorted.limit_cap, need) &&
           DP_WORKER_RESERVE(w, sorted.candidate, sorted.candidate_cap, need);
}

/* Sorts them by pixel (counting sort), and finds each cell's least limit. */
static bool sort_probes(dp_tile_worker *w) {
    dp_sorted_probes *const out = &w->sorted;
    if (!reserve_sorted(w, (size_t)w->probe_count + 16)) return false;
    uint32_t *const first = out->first;
    uint32_t sum = 0;
    float *const least = out->least[0][0];
    for (uint32_t i = 0; i < DP_CELL_ROOM; i++) least[i] = INFINITY;
    memset(first, 0, sizeof out->first);
    for (uint32_t i = 0; i < w->probe_count; i++) first[w->probes[i].pixel]++;
    for (uint32_t p = 0; p < DP_TILE * DP_TILE; p++) first[p] = sum += first[p];
    first[DP_TILE * DP_TILE] = sum;
    /* the ends of pixels go down to their starts */
    for (uint32_t k = 0; k < w->candidate_count; k++) {
        const dp_candidate *const c = &w->candidates[k];
        for (uint32_t i = c->probe; i < c->probe + (c->k1 - c->k0); i++) {
            const dp_probe *const p = &w->probes[i];
            const float limit = p->hidden ? INFINITY : p->limit;
            const uint32_t at = --first[p->pixel], x = p->pixel % DP_TILE, y = p->pixel / DP_TILE,
                           cell = y / DP_CELL * DP_CELLS + x / DP_CELL;
            least[cell] = dp_minf(limit, least[cell]);
            out->x[at] = p->x, out->y[at] = p->y, out->limit[at] = limit;
            out->candidate[at] = k;
            w->places[i] = at;
        }
    }
    for (int k = 0; k < 16; k++) {
        const size_t at = (size_t)w->probe_count + (size_t)k;
        out->x[at] = out->y[at] = 0, out->limit[at] = INFINITY;
    }
    return true;
}

static void add_piece(dp_tile_worker *w, const dp_candidate *c, uint32_t k0, uint32_t k1) {
    if (!DP_WORKER_RESERVE(w, pieces, pieces_cap, w->piece_count + 1)) return;
    w->pieces[w->piece_count++] =
        (dp_piece){.a = c->a,
                   .b = c->b,
                   .edge = c->edge,
                   .k0 = k0,
                   .k1 = k1,
                   .n = c->n,
                   .line = c->line,
                   .open = (k0 == c->k0 && k0 > 0) || (k1 == c->k1 && k1 < c->n)};
}

/* Runs of visible sample points. */
static void collect(dp_tile_worker *w, const dp_candidate *c) {
    uint32_t start = c->k0;
    for (uint32_t k = c->k0; k <= c->k1; k++) {
        const bool visible = k < c->k1 && !w->probes[c->probe + (k - c->k0)].hidden;
        if (visible) continue;
        if (k > start) add_piece(w, c, start, k);
        start = k + 1;
    }
}

void dp_tile_hide(dp_tile_worker *w) {
    if (!w->probe_count || !sort_probes(w)) return;
    w->frame->kernels->hide(w);
    for (uint32_t i = 0; i < w->probe_count; i++)
        w->probes[i].hidden = w->sorted.limit[w->places[i]] == INFINITY;
}

void dp_tile_collect(dp_tile_worker *w) {
    for (uint32_t i = 0; i < w->candidate_count && !w->failed; i++) collect(w, &w->candidates[i]);
}

void dp_tile_probe(dp_tile_worker *w) {
    dp_tile_hide(w);
    dp_tile_collect(w);
}
