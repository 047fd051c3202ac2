/* The order in which a pen draws the paths: layer by layer, in each so that it travels little.
 *
 *     from where the pen is, draw the path that begins nearest, again and again (grid); open paths
 *     begin at either end, closed ones at any point
 *     turn runs of WINDOW paths at most round where that is shorter (2-opt: Croes 1958), and draw
 *         single ones up to WINDOW others earlier or later (Or 1976)
 *     turn and rotate the points of the paths
 *
 * Data structure: a grid of the points at which paths of the layer can begin. When half of them are
 * drawn it is made anew with larger cells, so that nearest ones are found in a few steps however few
 * are left. Travel is counted from each path's end to the next one's start, from layer to layer
 * too, but not from the paper's corner, where the pen is at first. Invariant: all depends on the
 * paths and their order alone; of two points equally near the first one counts. */
#include "vector/clean.h"

#include <math.h>

enum { WINDOW = 50, PASSES = 5, PER_CELL = 2 };

typedef struct start {
    float x, y; /* px */
    uint32_t path;
    uint32_t point; /* of the path */
} start;

/* A path in its turn: where the pen comes down on it and where it leaves it. */
typedef struct stop {
    float in[2], out[2]; /* px */
    uint32_t path;
    uint32_t point; /* where it begins */
} stop;

typedef struct touring {
    dp_drawing *d;
    start *starts; /* in the grid, sorted by cell */
    start *sorting;
    uint32_t *cells; /* [across * down + 1] where in starts a cell's begin */
    stop *stops;
    bool *drawn; /* by path */
    dp_stored_path *paths;
    size_t starts_cap, sorting_cap, cells_cap, stops_cap, drawn_cap, paths_cap;
    size_t start_count, left; /* left: of them, those of paths that are not drawn */
    int32_t across, down;
    double x, y, cell; /* px: the grid's corner, size of a cell */
} touring;

static const dp_array arrays[] = {
    DP_ARRAY(touring, starts, starts_cap), DP_ARRAY(touring, sorting, sorting_cap),
    DP_ARRAY(touring, cells, cells_cap),   DP_ARRAY(touring, stops, stops_cap),
    DP_ARRAY(touring, drawn, drawn_cap),   DP_ARRAY(touring, paths, paths_cap)};

/* ------- the grid ------- */

static int32_t clamped(double cell, int32_t count) {
    return (int32_t)dp_max(0, dp_min(floor(cell), count - 1.0));
}

static int32_t column(const touring *t, float x) {
    return clamped(((double)x - t->x) / t->cell, t->across);
}

static int32_t row(const touring *t, float y) {
    return clamped(((double)y - t->y) / t->cell, t->down);
}

static uint32_t *cell_at(const touring *t, const start *s) {
    return &t->cells[(size_t)row(t, s->y) * (size_t)t->across + (size_t)column(t, s->x)];
}

/* The grid's place and size for the starts that there are; those outside the picture are
 * put into the cells at its edge, to which nothing is farther than to them. */
static void measure(touring *t) {
    const double most[2] = {t->d->info.width, t->d->info.height};
    double low[2] = {INFINITY, INFINITY}, high[2] = {0, 0};
    for (size_t i = 0; i < t->start_count; i++) {
        const double p[2] = {(double)t->starts[i].x, (double)t->starts[i].y};
        for (int k = 0; k < 2; k++) {
            const double on = dp_max(0, dp_min(most[k], p[k]));
            low[k] = dp_min(low[k], on), high[k] = dp_max(high[k], on);
        }
    }
    const double cells = (double)(t->start_count / PER_CELL + 1);
    const double wide = dp_max(high[0] - low[0], 1e-3), tall = dp_max(high[1] - low[1], 1e-3);
    t->x = low[0], t->y = low[1];
    t->cell = dp_max(sqrt(wide * tall / cells), dp_max(wide, tall) / cells);
    t->across = (int32_t)(wide / t->cell) + 1, t->down = (int32_t)(tall / t->cell) + 1;
}

/* Sorts the starts of paths that are not drawn into cells; in each they stay in order. */
static bool make_grid(touring *t) {
    size_t left = 0;
    for (size_t i = 0; i < t->start_count; i++)
        if (!t->drawn[t->starts[i].path]) t->starts[left++] = t->starts[i];
    t->start_count = t->left = left;
    measure(t);
    const size_t cells = (size_t)t->across * (size_t)t->down;
    if (!dp_reserve(&t->d->memory, &t->cells, &t->cells_cap, cells + 1, sizeof *t->cells) ||
        !dp_reserve(&t->d->memory, &t->sorting, &t->sorting_cap, left, sizeof *t->sorting))
        return false;
    for (size_t i = 0; i <= cells; i++) t->cells[i] = 0;
    for (size_t i = 0; i < left; i++) ++*cell_at(t, &t->starts[i]);
    uint32_t sum = 0;
    for (size_t i = 0; i <= cells; i++) sum += t->cells[i], t->cells[i] = sum;
    for (size_t i = left; i-- > 0;) t->sorting[--*cell_at(t, &t->starts[i])] = t->starts[i];
    start *const other = t->starts;
    const size_t cap = t->starts_cap;
    t->starts = t->sorting, t->starts_cap = t->sorting_cap;
    t->sorting = other, t->sorting_cap = cap;
    return true;
}

/* ------- the nearest start ------- */

typedef struct nearest {
    double square; /* px^2 */
    const start *at;
} nearest;

static bool comes_first(const start *s, const start *t) {
    return s->path != t->path ? s->path < t->path : s->point < t->point;
}

static void look_in_cell(const touring *t, int32_t i, int32_t k, const float pen[2],
                         nearest *best) {
    if (i < 0 || k < 0 || i >= t->across || k >= t->down) return;
    const uint32_t *const cell = &t->cells[(size_t)k * (size_t)t->across + (size_t)i];
    for (uint32_t n = cell[0]; n < cell[1]; n++) {
        const start *const s = &t->starts[n];
        const double x = (double)s->x - (double)pen[0], y = (double)s->y - (double)pen[1],
                     square = x * x + y * y;
        if (t->drawn[s->path] || square > best->square) continue;
        if (square < best->square || !best->at || comes_first(s, best->at))
            *best = (nearest){square, s};
    }
}

/* Cells in square rings about the pen's, until no farther ring can hold a nearer one. */
static const start *find_nearest(const touring *t, const float pen[2]) {
    const int32_t x = column(t, pen[0]), y = row(t, pen[1]);
    const int32_t rings = t->across > t->down ? t->across : t->down;
    nearest best = {INFINITY, NULL};
    for (int32_t r = 0; r <= rings; r++) {
        for (int32_t i = x - r; i <= x + r; i++) {
            look_in_cell(t, i, y - r, pen, &best);
            if (r) look_in_cell(t, i, y + r, pen, &best);
        }
        for (int32_t k = y - r + 1; k < y + r; k++) {
            look_in_cell(t, x - r, k, pen, &best);
            look_in_cell(t, x + r, k, pen, &best);
        }
        if (best.at && best.square <= (r * t->cell) * (r * t->cell)) break;
    }
    return best.at;
}

/* ------- a layer ------- */

static size_t starts_of(const dp_stored_path *p) { return p->closed ? p->count : 2; }

static bool list_starts(touring *t, size_t first, size_t last) {
    t->start_count = 0;
    for (size_t i = first; i < last; i++) {
        const dp_stored_path *const p = &t->d->paths[i];
        const size_t n = starts_of(p);
        if (!dp_reserve(&t->d->memory, &t->starts, &t->starts_cap, t->start_count + n,
                        sizeof *t->starts))
            return false;
        for (size_t k = 0; k < n; k++) {
            const size_t point = p->closed || !k ? k : p->count - 1;
            const dp_path_point *const at = &t->d->points[p->first + point];
            t->starts[t->start_count++] = (start){at->x, at->y, (uint32_t)i, (uint32_t)point};
        }
    }
    return t->start_count < UINT32_MAX;
}

static stop stop_at(const dp_drawing *d, uint32_t path, uint32_t point) {
    const dp_stored_path *const p = &d->paths[path];
    const dp_path_point *const points = d->points + p->first;
    const size_t end = p->closed ? point : point ? 0 : p->count - 1;
    return (stop){{points[point].x, points[point].y}, {points[end].x, points[end].y}, path, point};
}

/* The paths [first, last) from where the pen is, always to the nearest. */
static bool draw_nearest(touring *t, size_t first, size_t last, float pen[2]) {
    if (!list_starts(t, first, last) || !make_grid(t)) return false;
    for (size_t i = first; i < last; i++) {
        if (t->left < t->start_count / 2 && !make_grid(t)) return false;
        const start *const s = find_nearest(t, pen);
        t->stops[i] = stop_at(t->d, s->path, s->point);
        t->left -= starts_of(&t->d->paths[s->path]);
        t->drawn[s->path] = true;
        pen[0] = t->stops[i].out[0], pen[1] = t->stops[i].out[1];
    }
    return true;
}

static double way(const float from[2], const float to[2]) {
    return dp_hypot((double)to[0] - (double)from[0], (double)to[1] - (double)from[1]);
}

static stop turned(const dp_drawing *d, stop s) {
    const dp_stored_path *const p = &d->paths[s.path];
    return p->closed ? s : stop_at(d, s.path, s.point ? 0 : (uint32_t)p->count - 1);
}

static void turn_run(touring *t, size_t i, size_t k) {
    for (; i < k; i++, k--) {
        const stop kept = turned(t->d, t->stops[i]);
        t->stops[i] = turned(t->d, t->stops[k]), t->stops[k] = kept;
    }
    if (i == k) t->stops[i] = turned(t->d, t->stops[i]);
}

/* The way from one stop to the next; to or from nowhere it is none. */
static double leg(const stop *from, const stop *to) {
    return from && to ? way(from->out, to->in) : 0;
}

/* Where the layer begins and ends: nowhere but the pen, after the first layer, is a stop. */
typedef struct tour {
    size_t first, last;
    const stop *pen; /* NULL: anywhere */
} tour;

static const stop *before(const touring *t, const tour *r, size_t i) {
    return i > r->first ? &t->stops[i - 1] : r->pen;
}

static const stop *after(const touring *t, const tour *r, size_t i) {
    return i + 1 < r->last ? &t->stops[i + 1] : NULL;
}

static bool turn_runs(touring *t, const tour *r, size_t i) {
    const size_t end = r->last - i > WINDOW ? i + WINDOW : r->last;
    bool any = false;
    for (size_t k = i; k < end; k++) {
        const stop *const from = before(t, r, i), *const to = after(t, r, k);
        const stop head = turned(t->d, t->stops[i]), tail = turned(t->d, t->stops[k]);
        const double now = leg(from, &t->stops[i]) + leg(&t->stops[k], to),
                     then = leg(from, &tail) + leg(&head, to);
        if (!(then < now - 1e-9 * now)) continue;
        turn_run(t, i, k);
        any = true;
    }
    return any;
}

/* Puts stop i behind stop k, and those between one to the left. */
static void carry(touring *t, size_t i, size_t k, stop s) {
    for (; i < k; i++) t->stops[i] = t->stops[i + 1];
    for (; i > k; i--) t->stops[i] = t->stops[i - 1];
    t->stops[k] = s;
}

/* Draws one path at another time: the gap between stops k and k + 1 that it fits into best. */
static bool move_stop(touring *t, const tour *r, size_t i) {
    const stop *const from = before(t, r, i), *const to = after(t, r, i);
    const stop ways[2] = {t->stops[i], turned(t->d, t->stops[i])};
    const double saved = leg(from, &t->stops[i]) + leg(&t->stops[i], to) - leg(from, to);
    const size_t low = i - r->first > WINDOW ? i - WINDOW : r->first,
                 high = r->last - i > WINDOW ? i + WINDOW : r->last;
    double least = saved - 1e-9 * saved;
    size_t best = i;
    int turn = 0;
    for (size_t k = low; k < high; k++) {
        if (k == i) continue;
        /* where it then is stop k */
        const stop *const p = k < i ? before(t, r, k) : &t->stops[k], *const n =
                                                                          k < i ? &t->stops[k]
                                                                                : after(t, r, k);
        for (int w = 0; w < 2; w++) {
            const double cost = leg(p, &ways[w]) + leg(&ways[w], n) - leg(p, n);
            if (cost < least) least = cost, best = k, turn = w;
        }
    }
    if (best != i) carry(t, i, best, ways[turn]);
    return best != i;
}

static bool improve(touring *t, const tour *r) {
    bool any = false;
    for (size_t i = r->first; i < r->last; i++) any |= turn_runs(t, r, i);
    for (size_t i = r->first; i < r->last; i++) any |= move_stop(t, r, i);
    return any;
}

static bool order_layer(touring *t, size_t first, size_t last, float pen[2]) {
    const stop from = {.out = {pen[0], pen[1]}};
    const tour r = {first, last, first ? &from : NULL};
    if (!draw_nearest(t, first, last, pen)) return false;
    for (int pass = 0; pass < PASSES && improve(t, &r); pass++) {
    }
    pen[0] = t->stops[last - 1].out[0], pen[1] = t->stops[last - 1].out[1];
    return true;
}

/* ------- what comes of it ------- */

/* Draws an open path from its end; what each line is goes with it. */
static void turn_path(dp_path_point *points, dp_stored_path *p) {
    const size_t last = p->count - 1;
    for (size_t i = 0; i < p->count - 1 - i; i++) {
        const dp_path_point kept = points[i];
        points[i] = points[last - i], points[last - i] = kept;
    }
    for (size_t i = 0; i < last; i++) /* a line was told of at its other point */
        points[i].polygon = points[i + 1].polygon, points[i].edge = points[i + 1].edge;
    points[last].polygon = UINT64_MAX, points[last].edge = UINT32_MAX;
    const dp_line_end end = p->end[0];
    const uint64_t hider = p->hider[0];
    p->end[0] = p->end[1], p->end[1] = end;
    p->hider[0] = p->hider[1], p->hider[1] = hider;
}

static void put_in_order(touring *t) {
    dp_drawing *const d = t->d;
    for (size_t i = 0; i < d->info.paths; i++) {
        dp_stored_path *const p = &t->paths[i];
        *p = d->paths[t->stops[i].path];
        if (p->closed)
            dp_rotate_points(d->points + p->first, p->count, t->stops[i].point);
        else if (t->stops[i].point)
            turn_path(d->points + p->first, p);
    }
    dp_stored_path *const paths = d->paths;
    const size_t cap = d->paths_cap;
    d->paths = t->paths, d->paths_cap = t->paths_cap;
    t->paths = paths, t->paths_cap = cap;
}

static double travel_of(const dp_drawing *d) {
    double sum = 0;
    for (size_t i = 1; i < d->info.paths; i++) {
        const dp_stored_path *const p = &d->paths[i - 1], *const q = &d->paths[i];
        const dp_path_point *const a = &d->points[p->closed ? p->first : p->first + p->count - 1],
                                   *const b = &d->points[q->first];
        sum += dp_hypot((double)b->x - (double)a->x, (double)b->y - (double)a->y);
    }
    return sum;
}

static bool order_layers(touring *t) {
    const dp_drawing *const d = t->d;
    const size_t count = d->info.paths;
    float pen[2] = {0, 0};
    if (!dp_reserve(&d->memory, &t->stops, &t->stops_cap, count, sizeof *t->stops) ||
        !dp_reserve_zeroed(&d->memory, &t->drawn, &t->drawn_cap, count, sizeof *t->drawn) ||
        !dp_reserve(&d->memory, &t->paths, &t->paths_cap, count, sizeof *t->paths))
        return false;
    for (size_t first = 0, last; first < count; first = last) {
        const dp_stored_path *const p = &d->paths[first];
        for (last = first + 1; last < count; last++)
            if (d->paths[last].line != p->line || d->paths[last].level != p->level) break;
        if (!order_layer(t, first, last, pen)) return false;
    }
    return true;
}

bool dp_order_paths(dp_drawing *d, bool optimize) {
    touring t = {.d = d};
    d->info.travel = travel_of(d);
    if (!optimize || !d->info.paths) return true;
    d->info.travel_before = d->info.travel;
    const bool ok = order_layers(&t);
    if (ok) put_in_order(&t);
    if (ok) d->info.travel = travel_of(d);
    dp_arrays_free(&d->memory, &t, DP_ARRAYS(arrays));
    return ok;
}
