/* Edges that the table cannot resolve: what lies across them is looked up on the screen.
 *
 *    for each unpaired edge, for each sample point of its spine in or beside the tile
 *        place three lookups: NEAR and FAR px across the edge, NEAR px on its own side
 *    for each polygon, for each lookup in its pixels
 *        if its plane passes through the edge there: keep the nearest that covers the lookup
 *    for each sample point
 *        own side covered by a nearer polygon   no line: that polygon's edge makes it
 *        something found across                 fold: ridge, valley or flat (core/fold.c)
 *        nothing across, something behind       silhouette, unless both face away
 *        nothing at all                         border
 *    runs of points with the same line and neighbour become candidates
 *
 * An edge with one polygon is a border, or its neighbours share no corner with it: T-junctions,
 * cracks, parts that touch. With (Raskar 2001, 2.2 and 2.3) the added quads tell these apart, as a
 * neighbour hides or traps them right beside the edge. Here the neighbour is looked up where the
 * quads would lie, and then classified exactly, so folds appear by the same thresholds as
 * elsewhere.
 *
 * Data structure: lookups in linked lists by pixel. Invariant: an edge's lookups are consecutive,
 * LOOKUPS for each sample point. Not handled: cracks wider than FAR px on the screen (they become
 * two borders). */
#include "core/fold.h"
#include "find/finder.h"

#include <string.h>

/* How far from the edge a neighbour is looked up, px: first close enough to hit the smallest
 * triangle, then far enough to reach across a crack. */
static const float NEAR = 0.001f, FAR = 0.05f;

/* How far a plane may miss the edge and still pass through it: TOUCHING pixel sizes in depth, and
 * PLACED px on the screen. The latter is the error of float32 corners, which a plane seen nearly
 * edge-on multiplies. */
static const double TOUCHING = 0.02;
static const float PLACED = 0.002f;

enum { LOOKUPS = 3 }; /* near across, far across, near on its own side */

typedef struct dp_lookup {
    float x, y;       /* where */
    float ex, ey, ed; /* the point of the edge */
    float tolerance;  /* of depth, at the point of the edge */
    uint32_t own;     /* tile polygon to ignore: the edge's own */
    uint32_t found;   /* nearest tile polygon at (x, y); UINT32_MAX: none */
    float depth;      /* its depth at (x, y) */
    uint32_t next;
} dp_lookup;

typedef struct emerging {
    dp_unpaired_edge unpaired;
    uint32_t id;  /* frame polygon */
    dp_vec3 a, b; /* ends, world space */
    dp_spine spine;
    uint32_t k0, k1; /* sample points [k0, k1) in the tile or right beside it */
    uint32_t first;  /* index of the first lookup */
} emerging;

static bool begin_edge(dp_finder *w, dp_unpaired_edge unpaired, emerging *e) {
    const dp_polygons *const polygons = &w->tile.frame->polygons;
    e->unpaired = unpaired;
    e->id = w->tile.polygons[unpaired.polygon].id;
    const uint32_t first = dp_first_corner(polygons, e->id), n = dp_corner_count(polygons, e->id);
    const uint32_t va = dp_corner_vertex(polygons, first + unpaired.edge);
    const uint32_t vb = dp_corner_vertex(polygons, first + (unpaired.edge + 1) % n);
    e->a = dp_v3f(dp_vertex_position(polygons, va));
    e->b = dp_v3f(dp_vertex_position(polygons, vb));
    return dp_spine_make(&w->tile.frame->view, e->a, e->b, dp_v3(0, 0, 0), &e->spine);
}

static dp_pointd edge_point(const dp_finder *w, const dp_spine *s, uint32_t k) {
    dp_pointd p = dp_point_mix(s->a, s->b, (k + 0.5) / s->n);
    p.x -= w->tile.tile_x, p.y -= w->tile.tile_y;
    return p;
}

static bool near_tile(dp_pointd p) {
    return p.x >= -DP_BESIDE && p.y >= -DP_BESIDE && p.x <= DP_TILE + DP_BESIDE &&
           p.y <= DP_TILE + DP_BESIDE;
}

/* Sample points in and beside the tile are consecutive, as the tile is convex. */
static bool find_range(const dp_finder *w, emerging *e) {
    e->k0 = 0, e->k1 = e->spine.n;
    while (e->k0 < e->k1 && !near_tile(edge_point(w, &e->spine, e->k0))) e->k0++;
    while (e->k0 < e->k1 && !near_tile(edge_point(w, &e->spine, e->k1 - 1))) e->k1--;
    return e->k0 < e->k1;
}

/* Unit vector across the edge on the screen, pointing away from the polygon. Polygons are wound
 * counter-clockwise as seen from their front, and the screen's y points down. */
static void outward(const dp_finder *w, const emerging *e, float out[2]) {
    const double ex = e->spine.b.x - e->spine.a.x, ey = e->spine.b.y - e->spine.a.y,
                 length = dp_hypot(ex, ey);
    const double sign = w->tile.polygons[e->unpaired.polygon].flags & DP_POLYGON_FRONT ? 1 : -1;
    out[0] = length > 0 ? (float)(-ey / length * sign) : 1;
    out[1] = length > 0 ? (float)(ex / length * sign) : 0;
}

static bool place_lookups(dp_finder *w, emerging *e, uint32_t *count) {
    const size_t need = (size_t)*count + (size_t)LOOKUPS * (e->k1 - e->k0);
    if (!DP_TILE_RESERVE(&w->tile, w, emergence.lookups, emergence.lookups_cap, need)) return false;
    const float steps[LOOKUPS] = {NEAR, FAR, -NEAR};
    float out[2];
    outward(w, e, out);
    e->first = *count;
    for (uint32_t k = e->k0; k < e->k1; k++) {
        const dp_pointd p = edge_point(w, &e->spine, k);
        const float x = (float)p.x, y = (float)p.y;
        for (int i = 0; i < LOOKUPS; i++) {
            dp_lookup *const l = &w->emergence.lookups[*count];
            *l = (dp_lookup){.x = x + steps[i] * out[0],
                             .y = y + steps[i] * out[1],
                             .ex = x,
                             .ey = y,
                             .ed = (float)p.d,
                             .own = e->unpaired.polygon,
                             .found = UINT32_MAX,
                             .tolerance =
                                 (float)fabs(dp_depth_step(&w->tile.frame->view, p.d, TOUCHING))};
            l->next = dp_pixel_push(&w->emergence.pixels, l->x, l->y, (*count)++);
        }
    }
    return true;
}

static void do_lookups_in_pixel(dp_finder *w, uint32_t index, uint32_t head) {
    const dp_tile_polygon *const p = &w->tile.polygons[index];
    const float slope = PLACED * (fabsf(p->dx) + fabsf(p->dy));
    for (uint32_t i = head; i != UINT32_MAX; i = w->emergence.lookups[i].next) {
        dp_lookup *const l = &w->emergence.lookups[i];
        if (l->own == index || fabsf(dp_plane_at(p, l->ex, l->ey) - l->ed) > l->tolerance + slope)
            continue;
        const float depth = dp_plane_at(p, l->x, l->y);
        if (l->found != UINT32_MAX && l->depth >= depth) continue;
        if (dp_tile_covers(&w->tile, p, l->x, l->y)) l->found = index, l->depth = depth;
    }
}

static void do_lookups(dp_finder *w) {
    for (uint32_t i = 0; i < w->tile.polygon_count; i++) {
        const dp_tile_polygon *const p = &w->tile.polygons[i];
        if (p->flags & DP_POLYGON_EDGE_ON) continue;
        const uint64_t span = dp_box_span(p);
        for (uint32_t y = p->y0; y <= p->y1; y++)
            for (uint64_t bits = w->emergence.pixels.row[y] & span; bits; bits &= bits - 1)
                do_lookups_in_pixel(
                    w, i, w->emergence.pixels.head[y * DP_TILE + (uint32_t)__builtin_ctzll(bits)]);
    }
}

/* What a sample point turned out to be. */
typedef struct finding {
    int line;           /* dp_line, or -1: no line */
    uint32_t neighbour; /* tile polygon, or UINT32_MAX */
    dp_vec3 normal;
} finding;

static finding outline_finding(const dp_finder *w, const emerging *e, uint32_t behind) {
    const dp_vec3 n = dp_polygon_normal(w->tile.frame, e->id);
    const bool front = w->tile.polygons[e->unpaired.polygon].flags & DP_POLYGON_FRONT;
    return (finding){behind == UINT32_MAX ? DP_LINE_BORDER : DP_LINE_SILHOUETTE, behind,
                     front ? n : dp_scale(n, -1)};
}

static finding fold_finding(const dp_finder *w, const emerging *e, uint32_t across) {
    const dp_tile_polygon *const p = &w->tile.polygons[e->unpaired.polygon];
    const dp_tile_polygon *const q = &w->tile.polygons[across];
    finding f = {-1, across, {0, 0, 0}};
    if (!((p->flags | q->flags) & DP_POLYGON_FRONT)) return f;
    const dp_vec3 at = dp_mix(e->a, e->b, 0.5);
    const dp_fold fold = dp_fold_at(w->tile.frame, p->id, p->flags & DP_POLYGON_FRONT, q->id,
                                    q->flags & DP_POLYGON_FRONT, at);
    f.line = dp_fold_line(&fold, dp_polygon_style(w->tile.frame, p->id));
    f.normal = fold.normal;
    return f;
}

/* Near its ends, polygons that only share a corner with the edge come within FAR of it. */
static bool is_near_end(const emerging *e, uint32_t k) { return k < 2 || k + 2 >= e->spine.n; }

static finding judge(const dp_finder *w, const emerging *e, uint32_t k) {
    const dp_lookup *const l = w->emergence.lookups + e->first + (size_t)LOOKUPS * (k - e->k0);
    const uint32_t far = is_near_end(e, k) ? UINT32_MAX : l[1].found, behind = l[2].found;
    const uint32_t across = l[0].found != UINT32_MAX ? l[0].found : far;
    const dp_tile_polygon *const p = &w->tile.polygons[e->unpaired.polygon];
    const dp_lookup *const own = &l[2];
    const bool covered =
        behind != UINT32_MAX && own->depth > dp_plane_at(p, own->x, own->y) + own->tolerance;
    if (covered) return (finding){-1, behind, {0, 0, 0}}; /* a nearer polygon has this edge too */
    if (across == UINT32_MAX) {
        const bool both_back = behind != UINT32_MAX &&
                               !((p->flags | w->tile.polygons[behind].flags) & DP_POLYGON_FRONT);
        return both_back ? (finding){-1, behind, {0, 0, 0}} : outline_finding(w, e, behind);
    }
    return fold_finding(w, e, across);
}

static void add_run(dp_finder *w, const emerging *e, finding f, uint32_t k0, uint32_t k1) {
    if (f.line < 0 || k0 >= k1) return;
    if (!(dp_polygon_style(w->tile.frame, e->id)->lines & (1u << f.line))) return;
    dp_spine spine;
    if (!dp_spine_make(&w->tile.frame->view, e->a, e->b, f.normal, &spine)) return;
    const uint32_t b = f.neighbour == UINT32_MAX ? UINT32_MAX : w->tile.polygons[f.neighbour].id;
    dp_add_candidate(w,
                     (dp_candidate){.a = e->id,
                                    .b = b,
                                    .edge = e->unpaired.edge,
                                    .k0 = k0,
                                    .k1 = k1,
                                    .line = (uint8_t)f.line},
                     &spine, NULL);
}

static bool is_same(const finding *a, const finding *b) {
    return a->line == b->line && a->neighbour == b->neighbour;
}

/* A single sample point that differs from two neighbours that agree, or from its neighbour at the
 * edge's end: something merely passes through the edge or touches its corner there. It follows
 * them. */
static finding settle(const emerging *e, uint32_t k, const finding *before, const finding *here,
                      const finding *after) {
    if (e->spine.n < 3) return *here;
    if (k == 0) return *after;
    if (k + 1 == e->spine.n) return *before;
    return is_same(before, after) ? *before : *here;
}

/* Adds a candidate for each run of sample points with the same line and neighbour. */
static void add_lines(dp_finder *w, const emerging *e) {
    finding last = {-1, UINT32_MAX, {0, 0, 0}}, before, here = judge(w, e, e->k0), after = here;
    uint32_t start = e->k0;
    for (uint32_t k = e->k0; k < e->k1 && !w->tile.failed; k++) {
        before = k > e->k0 ? here : after;
        here = k > e->k0 ? after : here;
        after = k + 1 < e->k1 ? judge(w, e, k + 1) : here;
        const finding f = settle(e, k, &before, &here, &after);
        if (is_same(&f, &last)) continue;
        add_run(w, e, last, start, k);
        last = f, start = k;
    }
    add_run(w, e, last, start, e->k1);
    if (last.line == DP_LINE_BORDER) w->tile.stats.open_edges++;
}

void dp_find_emergent(dp_finder *w) {
    uint32_t count = 0;
    emerging e;
    if (!w->emergence.unpaired_count) return;
    memset(w->emergence.pixels.row, 0, sizeof w->emergence.pixels.row);
    for (uint32_t i = 0; i < w->emergence.unpaired_count; i++)
        if (begin_edge(w, w->emergence.unpaired[i], &e) && find_range(w, &e) &&
            !place_lookups(w, &e, &count))
            return;
    if (!count) return;
    do_lookups(w);
    count = 0;
    for (uint32_t i = 0; i < w->emergence.unpaired_count && !w->tile.failed; i++) {
        if (!begin_edge(w, w->emergence.unpaired[i], &e) || !find_range(w, &e)) continue;
        e.first = count;
        count += LOOKUPS * (e.k1 - e.k0);
        w->tile.stats.edges_emergent++;
        add_lines(w, &e);
    }
}

/* ------- memory ------- */

static const dp_array arrays[] = {DP_ARRAY(dp_emergence, unpaired, unpaired_cap),
                                  DP_ARRAY(dp_emergence, lookups, lookups_cap)};

void dp_emergence_free(dp_emergence *store, const dp_allocator *memory) {
    dp_arrays_free(memory, store, DP_ARRAYS(arrays));
}

uint64_t dp_emergence_bytes(const dp_emergence *store) {
    return dp_arrays_bytes(store, DP_ARRAYS(arrays));
}
