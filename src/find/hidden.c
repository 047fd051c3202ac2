/* Hidden lines of a tile: a second look, when all that is visible has been found.
 *
 *    make the polygons that were culled as well, and the normals of back faces    raster/assemble.c
 *    edges of all polygons: silhouette, ridge or valley by their two polygons     edges.c, fan.c
 *    edges that one polygon has, by what passes through them                      emerge.c
 *    crossings of all polygons                                                    intersect.c
 *    count the front faces that lie before each sample point, up to a limit       hide.inc
 *        of an x-ray, stack up the surfaces instead, whose opacity counts too
 *    runs of points of one level become pieces, but for what a visible piece of the same edge or
 *        crossing holds
 *
 * What is visible stays as it was found, bit for bit: nothing here changes it. Where the eye decides
 * what a visible line is (disputes, back faces in sight), the winding decides here, as no sample shows
 * what lies beside the line. Smooth folds are left out (dp_is_smooth).
 *
 * Data structure: visible pieces sorted by a key of their edge's ends. Invariant: sample points are
 * those that visible lines have, so a line goes on hidden where it stops being visible. Not handled:
 * a visible line along an edge that another polygon owns, whose corners are others: the hidden one
 * may run below it. */
#include "base/sort.h"
#include "find/fan.h"
#include "raster/xray.h"

#include <string.h>

/* Degrees by which a hidden fold must turn. ISO 128-3 and drawing offices leave out hidden edges of
 * tangent and nearly tangent surfaces: the facets of a flank, the runout of a fillet. Below that lie
 * the folds of a circle of ten facets or more; above it, the 45 degrees of a chamfer. */
static const double SMOOTH = 40;

bool dp_is_smooth(const dp_frame *frame, const dp_fold *fold) {
    return !frame->hidden_smooth && fabs(dp_fold_dihedral(fold) - 180) < SMOOTH - 1e-3;
}

/* A visible piece, and the key of its spine's ends or polygons. */
typedef struct dp_shown {
    uint32_t key, piece;
} shown;

static int by_key(const void *left, const void *right) {
    const shown *const l = left, *const r = right;
    if (l->key != r->key) return l->key < r->key ? -1 : 1;
    return (l->piece > r->piece) - (l->piece < r->piece);
}

/* What names a spine: the keys of its ends' positions; of a crossing, its polygons. */
typedef struct spine_name {
    uint32_t from, to;
} spine_name;

static spine_name name_of(const dp_frame *frame, uint32_t a, uint32_t b, uint32_t edge) {
    const dp_polygons *const polygons = &frame->polygons;
    if (edge == DP_CROSSING) return (spine_name){a, ~b};
    const uint32_t first = dp_first_corner(polygons, a), n = dp_corner_count(polygons, a);
    return (spine_name){frame->vertices[dp_corner_vertex(polygons, first + edge)].key,
                        frame->vertices[dp_corner_vertex(polygons, first + (edge + 1) % n)].key};
}

static bool list_shown(dp_finder *w, size_t first) {
    dp_hidden_store *const own = &w->hidden;
    const size_t count = w->found->piece_count - first;
    if (!DP_TILE_RESERVE(&w->tile, own, shown, shown_cap, count)) return false;
    for (size_t i = 0; i < count; i++) {
        const dp_piece *const p = &w->found->pieces[first + i];
        const spine_name name = name_of(w->tile.frame, p->a, p->b, p->edge);
        own->shown[i] = (shown){name.from ^ name.to, (uint32_t)i};
    }
    if (count) dp_sort(own->shown, count, sizeof *own->shown, by_key);
    own->shown_count = (uint32_t)count;
    return true;
}

/* The first visible piece with a key that is no less. */
static uint32_t find_shown(const dp_hidden_store *own, uint32_t key) {
    uint32_t lo = 0, hi = own->shown_count;
    while (lo < hi) {
        const uint32_t at = lo + (hi - lo) / 2;
        if (own->shown[at].key < key)
            lo = at + 1;
        else
            hi = at;
    }
    return lo;
}

/* The level of a candidate's sample point k. */
static uint8_t *level_at(const dp_finder *w, const dp_candidate *c, uint32_t k) {
    return &w->lines.level[c->probe + (k - c->k0)];
}

static float *through_at(const dp_finder *w, const dp_candidate *c, uint32_t k) {
    return &w->lines.through[c->probe + (k - c->k0)];
}

/* What a piece of the same spine shows is not hidden. */
static void leave_out(const dp_finder *w, const dp_candidate *c, const dp_piece *p, bool turned,
                      void *unused) {
    (void)unused;
    const uint32_t from = turned ? p->n - p->k1 : p->k0, to = turned ? p->n - p->k0 : p->k1;
    const uint32_t k0 = from > c->k0 ? from : c->k0, k1 = to < c->k1 ? to : c->k1;
    for (uint32_t k = k0; k < k1; k++) *level_at(w, c, k) = 0;
}

/* Does something to a candidate for each visible piece of the same spine, which may run the other
 * way. */
typedef void visit_shown(const dp_finder *w, const dp_candidate *c, const dp_piece *p, bool turned,
                         void *arg);

/* `first`: the first of the visible pieces, a number of the worker's. */
static void visit_all_shown(const dp_finder *w, const dp_candidate *c, size_t first,
                            visit_shown *visit, void *arg) {
    const dp_hidden_store *const own = &w->hidden;
    const spine_name name = name_of(w->tile.frame, c->a, c->b, c->edge);
    const uint32_t key = name.from ^ name.to;
    for (uint32_t i = find_shown(own, key); i < own->shown_count && own->shown[i].key == key; i++) {
        const dp_piece *const p = &w->found->pieces[first + own->shown[i].piece];
        const spine_name other = name_of(w->tile.frame, p->a, p->b, p->edge);
        const bool same = other.from == name.from && other.to == name.to,
                   turned = other.from == name.to && other.to == name.from;
        if ((same || turned) && p->n == c->n) visit(w, c, p, !same, arg);
    }
}

/* The surfaces that an x-ray's line lies behind, as its layers are peeled (raster/xray.c), and what
 * they let through. */
static uint32_t unstack(const dp_frame *frame, const dp_stack *s, float *through) {
    float bound = INFINITY;
    uint32_t level = 0;
    *through = 1;
    if (s->back > DP_DEPTH_EMPTY && !(s->count && dp_layer_bound(frame, s->back) < s->depth[0])) {
        *through = 1 - dp_opacity_of(frame, s->back_polygon);
        bound = dp_layer_bound(frame, s->back), level = 1;
    }
    for (uint32_t i = 0; i < s->count; i++) {
        if (!(s->depth[i] < bound)) continue;
        *through *= 1 - dp_opacity_of(frame, s->polygon[i]);
        bound = dp_layer_bound(frame, s->depth[i]), level++;
    }
    return level;
}

/* The same as find_levels, by stacks. */
static bool find_layers(const dp_finder *w, const dp_candidate *c) {
    const dp_frame *const frame = w->tile.frame;
    bool any = false;
    for (uint32_t k = c->k0; k < c->k1; k++) {
        const uint32_t at = c->probe + (k - c->k0);
        const uint32_t level = unstack(frame, &w->lines.stacks[at], &w->lines.through[at]);
        w->lines.level[at] = (uint8_t)(level < frame->hidden ? level : frame->hidden);
        any |= level;
    }
    return any;
}

/* From what was counted to levels: 0 is visible; what anything hides has 1 at least. */
static bool find_levels(const dp_finder *w, const dp_candidate *c) {
    if (w->tile.frame->xray) return find_layers(w, c);
    const uint32_t most = w->tile.frame->hidden;
    bool any = false;
    for (uint32_t k = c->k0; k < c->k1; k++) {
        uint8_t *const level = level_at(w, c, k);
        const bool hidden =
            *level & DP_LEVEL_HIDDEN || w->lines.probes.limit[c->probe + (k - c->k0)] == INFINITY;
        const uint32_t fronts = *level & DP_LEVEL_COUNT, least = fronts > 1 ? fronts : 1;
        *level = (uint8_t)(!hidden ? 0 : least < most ? least : most);
        any |= hidden;
    }
    return any;
}

static uint32_t hider_of(bool ends) { return (uint32_t)(ends ? DP_HIDER_NONE : DP_HIDER_UNKNOWN); }

/* A hidden piece begins and ends where a visible one of the spine is known to. */
static void meet(const dp_finder *w, const dp_candidate *c, const dp_piece *p, bool turned,
                 void *piece) {
    dp_piece *const out = piece;
    const uint32_t from = turned ? p->n - p->k1 : p->k0, to = turned ? p->n - p->k0 : p->k1;
    (void)w, (void)c;
    if (to == out->k0) out->end[0] = turned ? -p->end[0] : p->end[1];
    if (from == out->k1) out->end[1] = turned ? -p->end[1] : p->end[0];
}

/* `first`: as in visit_all_shown. */
static void add_piece(dp_finder *w, const dp_candidate *c, uint32_t k0, uint32_t k1, uint8_t level,
                      size_t first) {
    if (!DP_TILE_RESERVE(&w->tile, w, found->pieces, found->pieces_cap, w->found->piece_count + 1))
        return;
    dp_piece *const out = &w->found->pieces[w->found->piece_count++];
    *out = (dp_piece){.a = c->a,
                      .b = c->b,
                      .edge = c->edge,
                      .k0 = k0,
                      .k1 = k1,
                      .n = c->n,
                      .hider = {hider_of(k0 == 0), hider_of(k1 == c->n)},
                      .geometry = c->geometry,
                      .line = c->line,
                      .seen = c->seen,
                      .level = level,
                      .through = w->tile.frame->xray ? *through_at(w, c, k0) : 1,
                      .open = (k0 == c->k0 && k0 > 0) || (k1 == c->k1 && k1 < c->n)};
    if (w->tile.frame->styles[0].exact_ends) visit_all_shown(w, c, first, meet, out);
}

static void collect(dp_finder *w, const dp_candidate *c, size_t first) {
    const bool xray = w->tile.frame->xray;
    uint32_t start = c->k0;
    uint8_t level = 0;
    float through = 1;
    for (uint32_t k = c->k0; k <= c->k1; k++) {
        const uint8_t here = k < c->k1 ? *level_at(w, c, k) : 0;
        const float passes = xray && here ? *through_at(w, c, k) : 1;
        if (here == level && passes == through) continue;
        if (level && through > 0) add_piece(w, c, start, k, level, first);
        start = k, level = here, through = passes;
    }
}

/* Visible pieces are the worker's from `first` on, and `count` of them. */
static void collect_all(dp_finder *w, size_t first) {
    for (uint32_t i = 0; i < w->lines.candidate_count && !w->tile.failed; i++) {
        const dp_candidate *const c = &w->lines.candidates[i];
        if (!find_levels(w, c)) continue;
        visit_all_shown(w, c, first, leave_out, NULL);
        collect(w, c, first);
    }
}

static void find_candidates(dp_finder *w) {
    w->lines.candidate_count = w->lines.probe_count = 0;
    w->emergence.unpaired_count = w->emergence.drawn_count = w->emergence.served_count = 0;
    dp_find_edges(w);
    dp_find_emergent(w);
    dp_find_crossings(w);
    dp_find_marked(w);
}

static bool stack_hiders(dp_finder *w) {
    const uint32_t count = w->lines.probe_count;
    if (!DP_TILE_RESERVE(&w->tile, w, lines.stacks, lines.stacks_cap, count) ||
        !DP_TILE_RESERVE(&w->tile, w, lines.level, lines.level_cap, count) ||
        !DP_TILE_RESERVE(&w->tile, w, lines.through, lines.through_cap, count))
        return false;
    for (uint32_t i = 0; i < count; i++)
        w->lines.stacks[i].count = 0, w->lines.stacks[i].back = DP_DEPTH_EMPTY;
    w->lines.stacking = true;
    dp_hide_points(w);
    w->lines.stacking = false;
    return !w->tile.failed;
}

/* Where one level is all, the first polygon that hides a point is enough. */
static bool count_levels(dp_finder *w) {
    const uint32_t levels = w->tile.frame->hidden;
    if (w->tile.frame->xray) return stack_hiders(w);
    if (!DP_TILE_RESERVE(&w->tile, w, lines.level, lines.level_cap, w->lines.probe_count))
        return false;
    if (w->lines.probe_count) memset(w->lines.level, 0, w->lines.probe_count);
    w->lines.levels = levels > 1 ? levels : 0;
    dp_hide_points(w);
    w->lines.levels = 0;
    return !w->tile.failed;
}

void dp_find_hidden(dp_finder *w, size_t first) {
    const dp_stats stats = w->tile.stats;
    const bool sees_backs = w->tile.sees_backs;
    if (w->tile.failed || !list_shown(w, first) || !dp_tile_complete(&w->tile)) return;
    w->finds_hidden = true;
    w->tile.sees_backs = false;
    find_candidates(w);
    if (!w->tile.failed && count_levels(w)) collect_all(w, first);
    w->finds_hidden = false;
    w->tile.sees_backs = sees_backs;
    w->tile.stats = stats; /* of what is visible */
}

/* ------- memory ------- */

static const dp_array arrays[] = {DP_ARRAY(dp_hidden_store, shown, shown_cap)};

void dp_hidden_store_free(dp_hidden_store *store, const dp_allocator *memory) {
    dp_arrays_free(memory, store, DP_ARRAYS(arrays));
}

uint64_t dp_hidden_store_bytes(const dp_hidden_store *store) {
    return dp_arrays_bytes(store, DP_ARRAYS(arrays));
}
