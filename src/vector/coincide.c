/* What lies on each other on the screen is drawn once.
 *
 *     chain the segments, at any turn
 *     go along the chains: visible before hidden, lower levels before higher ones, outlines before
 *     creases, longer chains before shorter ones, which leaves them whole
 *         find the parts kept so far that lie under a segment (grid)
 *         keep what of the segment none of them lies under
 *
 * Two lines lie on each other where they run side by side, turned by at most LEAN, and no more than
 * NEAR apart: on all of their common length, or on LONG px of it. Segments that share an end have
 * no common length. Where a chain turns back and parts slowly from itself, as outlines of fine meshes
 * do, it is not cut: it would be broken at every turn.
 *
 * Data structure: a hash table of grid cells and directions, each a list of the kept parts that run
 * through the cell that way. Cells grow with the mean length of the segments, so that a segment
 * crosses a few on the average. Invariant: no two kept parts lie on each other; so there are few in
 * a cell and direction, however many segments meet there.
 *
 * Not handled: thousands of segments far shorter than a cell in one cell are compared each with
 * each that has its direction. */
#include "vector/join.h"

#include "base/sort.h"

#include <math.h>

static const double NEAR = 0.02;   /* px */
static const double LEAN = 0.04;   /* sine: two lines that cross more steeply are near each other on
                                     less than a pixel */
static const double LONG = 1;      /* px: lines that part or meet slowly share less, which shows not
                                     and is not worth a gap in one of them */
static const double ROUGHLY = 1.5; /* for what is known in floats only */
static const double TOUCH = 1e-3;  /* px: less is no common length */
static const double LEAST_CELL = 4; /* px */
enum { CLOSE = 6 /* segments of a chain that may part slowly */ };
enum { WAYS = 16 /* directions that the grid tells apart; neighbours are wider than LEAN */ };

typedef struct entry {
    float a[2], b[2];    /* px, ends of the part: most are seen to lie apart without a look at it */
    uint32_t part, next; /* next: 1 + number of the next entry, or 0 */
} entry;

typedef struct range {
    double from, to; /* px along the segment */
    uint32_t part;
    bool whole; /* all that the two have in common */
} range;

/* Where a segment lies in its chain, as it was before anything was cut. */
typedef struct track {
    uint32_t chain, place;
} track;

typedef struct grid {
    dp_cleaning *c;
    double cell; /* px */
    uint32_t *heads;
    size_t slots; /* a power of two */
    entry *entries;
    range *ranges;     /* of the segment in question */
    double from, to;   /* px along the line that is looked at: what of it the column holds */
    double covered[2]; /* px along it: a run of it that is covered */
    track *tracks;     /* by segment */
    size_t entries_cap, ranges_cap, heads_cap, tracks_cap, entry_count, range_count;
    dp_part *kept;
    size_t kept_cap;
    uint32_t kept_count;
} grid;

static const dp_array arrays[] = {
    DP_ARRAY(grid, heads, heads_cap), DP_ARRAY(grid, entries, entries_cap),
    DP_ARRAY(grid, ranges, ranges_cap), DP_ARRAY(grid, tracks, tracks_cap),
    DP_ARRAY(grid, kept, kept_cap)};

/* A straight line on the screen, from p on, `length` px in the unit direction u. */
typedef struct line {
    double p[2], u[2], length;
} line;

static line line_between(const double a[2], const double b[2]) {
    const double x = b[0] - a[0], y = b[1] - a[1], length = dp_hypot(x, y);
    const double scale = length > 0 ? 1 / length : 0;
    return (line){{a[0], a[1]}, {x * scale, y * scale}, length};
}

static line line_of(const dp_segment *s) {
    const double a[2] = {(double)s->a[0], (double)s->a[1]},
                 b[2] = {(double)s->b[0], (double)s->b[1]};
    return line_between(a, b);
}

static line line_of_part(const dp_cleaning *c, const dp_part *part) {
    line l = line_of(&c->drawn->segments[part->segment]);
    const double from = part->at[0] * l.length, to = part->at[1] * l.length;
    l.p[0] += from * l.u[0], l.p[1] += from * l.u[1];
    l.length = to - from;
    return l;
}

/* ------- the grid ------- */

/* Direction as a number in [0, 2), the same for both ways along a line; it changes by half the
 * angle at least, and by the whole angle at most. */
static double way_of(const line *l) {
    const double flip = l->u[1] < 0 || (l->u[1] == 0 && l->u[0] < 0) ? -1 : 1;
    const double x = l->u[0] * flip, y = l->u[1] * flip;
    return fabs(x) + y > 0 ? 1 - x / (fabs(x) + y) : 0;
}

static int32_t cell_of(const grid *g, double px) {
    return (int32_t)floor(dp_max(-1e9, dp_min(1e9, px / g->cell)));
}

static uint32_t *head_of(const grid *g, int32_t x, int32_t y, int way) {
    return &g->heads[(dp_cell_hash(x, y) + (uint32_t)way * 0x9e3779b1u) & (g->slots - 1)];
}

typedef bool visit(grid *g, const line *l, int32_t x, int32_t y, uint32_t item);

/* Visits the cells within `margin` px of a line, from its start on, column by column along its longer
 * direction; but for those in which it is known to be covered. */
static bool walk(grid *g, const line *l, double margin, visit *visitor, uint32_t part) {
    const int across = fabs(l->u[0]) >= fabs(l->u[1]) ? 0 : 1, up = !across;
    const double u = l->u[across], end = l->p[across] + u * l->length;
    const double low = dp_min(l->p[across], end), high = dp_max(l->p[across], end);
    const int32_t first = cell_of(g, low - margin), last = cell_of(g, high + margin);
    for (int32_t n = 0; n <= last - first; n++) {
        const int32_t i = u > 0 ? first + n : last - n;
        const double from = dp_max(low, i * g->cell - margin),
                     to = dp_min(high, (i + 1.0) * g->cell + margin);
        const double one = (from - l->p[across]) / u, two = (to - l->p[across]) / u;
        const double a = l->p[up] + l->u[up] * one, b = l->p[up] + l->u[up] * two;
        const int32_t top = cell_of(g, dp_max(a, b) + margin);
        g->from = dp_min(one, two), g->to = dp_max(one, two);
        for (int32_t k = cell_of(g, dp_min(a, b) - margin); k <= top; k++)
            if (!visitor(g, l, across ? k : i, across ? i : k, part)) return false;
    }
    return true;
}

static bool enter(grid *g, const line *l, int32_t x, int32_t y, uint32_t part) {
    uint32_t *const head = head_of(g, x, y, (int)(way_of(l) * (WAYS / 2)) % WAYS);
    if (g->entry_count >= UINT32_MAX - 1 || !dp_reserve(g->c->memory, &g->entries, &g->entries_cap,
                                                        g->entry_count + 1, sizeof *g->entries))
        return false;
    g->entries[g->entry_count++] =
        (entry){{(float)l->p[0], (float)l->p[1]},
                {(float)(l->p[0] + l->u[0] * l->length), (float)(l->p[1] + l->u[1] * l->length)},
                part,
                *head};
    *head = (uint32_t)g->entry_count;
    return true;
}

/* ------- what lies under a segment ------- */

/* Where on line s does t lie? */
static bool shared(const line *s, const line *t, range *out) {
    if (fabs(s->u[0] * t->u[1] - s->u[1] * t->u[0]) > LEAN) return false;
    double along[2], off[2]; /* px, of the ends of t in s's own axes */
    for (int k = 0; k < 2; k++) {
        const double reach = k ? t->length : 0, x = t->p[0] + t->u[0] * reach - s->p[0],
                     y = t->p[1] + t->u[1] * reach - s->p[1];
        along[k] = x * s->u[0] + y * s->u[1], off[k] = y * s->u[0] - x * s->u[1];
    }
    double from = dp_max(0, dp_min(along[0], along[1])),
           to = dp_min(s->length, dp_max(along[0], along[1]));
    if (!(to - from > TOUCH)) return false;
    out->whole = true;
    const double slope = (off[1] - off[0]) / (along[1] - along[0]);
    const double off_from = off[0] + slope * (from - along[0]),
                 off_to = off[0] + slope * (to - along[0]);
    if (fabs(off_from) > NEAR || fabs(off_to) > NEAR) {
        if (slope == 0) return false;
        const double one = along[0] + (NEAR - off[0]) / slope,
                     two = along[0] + (-NEAR - off[0]) / slope;
        from = dp_max(from, dp_min(one, two)), to = dp_min(to, dp_max(one, two));
        if (!(to - from >= LONG)) return false;
        out->whole = false;
    }
    out->from = from, out->to = to;
    return true;
}

/* Do two segments follow each other in a chain that turns back, and part slowly? */
static bool parting(const grid *g, uint32_t segment, uint32_t part, const range *found) {
    const track *const s = &g->tracks[segment], *const t = &g->tracks[g->kept[part].segment];
    const uint32_t apart = s->place > t->place ? s->place - t->place : t->place - s->place;
    return !found->whole && s->chain == t->chain && apart <= CLOSE;
}

/* Is it known that the line is covered where it runs through this column? */
static bool is_covered(const grid *g) { return g->covered[0] <= g->from && g->covered[1] >= g->to; }

static bool add_range(grid *g, const range *found) {
    if (found->from >= g->covered[0] && found->to <= g->covered[1]) return true;
    if (found->from <= g->covered[1] && found->to >= g->covered[0]) {
        g->covered[0] = dp_min(g->covered[0], found->from);
        g->covered[1] = dp_max(g->covered[1], found->to);
    } else if (found->to > g->covered[1]) {
        g->covered[0] = found->from, g->covered[1] = found->to;
    }
    if (!dp_reserve(g->c->memory, &g->ranges, &g->ranges_cap, g->range_count + 1,
                    sizeof *g->ranges))
        return false;
    g->ranges[g->range_count++] = *found;
    return true;
}

/* Says soon of most parts that they do not lie under a line. */
static bool is_apart(const line *l, const entry *t) {
    const double x = (double)t->b[0] - (double)t->a[0], y = (double)t->b[1] - (double)t->a[1];
    const double turn = l->u[0] * y - l->u[1] * x;
    const double a = ((double)t->a[1] - l->p[1]) * l->u[0] - ((double)t->a[0] - l->p[0]) * l->u[1];
    return (a > ROUGHLY * NEAR && a + turn > ROUGHLY * NEAR) ||
           (a < -ROUGHLY * NEAR && a + turn < -ROUGHLY * NEAR) ||
           fabs(turn) > LEAN * (fabs(x) + fabs(y)) + NEAR;
}

static bool look_way(grid *g, const line *l, int32_t x, int32_t y, int way, uint32_t segment) {
    for (uint32_t e = *head_of(g, x, y, (way + WAYS) % WAYS); e && !is_covered(g);
         e = g->entries[e - 1].next) {
        const uint32_t part = g->entries[e - 1].part;
        range found = {.part = part};
        if (is_apart(l, &g->entries[e - 1])) continue;
        if (g->range_count && g->ranges[g->range_count - 1].part == part) continue;
        const line under = line_of_part(g->c, &g->kept[part]);
        if (!shared(l, &under, &found) || parting(g, segment, part, &found)) continue;
        if (!add_range(g, &found)) return false;
    }
    return true;
}

static bool look(grid *g, const line *l, int32_t x, int32_t y, uint32_t segment) {
    const double way = way_of(l) * (WAYS / 2), rest = way - floor(way),
                 reach = LEAN * 1.01 * (WAYS / 2);
    return look_way(g, l, x, y, (int)way, segment) &&
           (rest >= reach || look_way(g, l, x, y, (int)way - 1, segment)) &&
           (rest <= 1 - reach || look_way(g, l, x, y, (int)way + 1, segment));
}

static int by_start(const void *left, const void *right) {
    const range *const l = left, *const r = right;
    if (l->from != r->from) return l->from < r->from ? -1 : 1;
    if (l->to != r->to) return l->to < r->to ? -1 : 1;
    return (l->part > r->part) - (l->part < r->part);
}

/* ------- what is kept ------- */

static bool keep(grid *g, uint32_t segment, const line *l, double from, double to) {
    if (g->kept_count >= DP_MOST_PARTS || !dp_reserve(g->c->memory, &g->kept, &g->kept_cap,
                                                      g->kept_count + (size_t)1, sizeof *g->kept))
        return false;
    const bool first = from <= 0, last = to >= l->length;
    dp_part *const part = &g->kept[g->kept_count];
    *part = (dp_part){.at = {first ? 0 : from / l->length, last ? 1 : to / l->length},
                      .segment = segment,
                      .cut = (uint8_t)((first ? 0 : 1) | (last ? 0 : 2))};
    const line kept = line_of_part(g->c, part);
    return walk(g, &kept, 1.5 * NEAR, enter, g->kept_count++);
}

/* Keeps what lies between the ranges, but for slivers. */
static bool keep_rest(grid *g, uint32_t segment, const line *l) {
    double at = 0, kept = 0;
    for (size_t i = 0; i <= g->range_count; i++) {
        const bool end = i == g->range_count;
        const double from = end ? l->length : g->ranges[i].from;
        if (from - at > (g->range_count ? NEAR : 0)) {
            if (!keep(g, segment, l, at, from)) return false;
            kept += from - at;
        }
        if (!end) at = dp_max(at, g->ranges[i].to);
    }
    g->c->coincident += l->length - kept;
    return true;
}

static bool take(grid *g, uint32_t segment) {
    const line l = line_of(&g->c->drawn->segments[segment]);
    g->range_count = 0;
    g->covered[0] = g->covered[1] = -1;
    if (!walk(g, &l, 0, look, segment)) return false;
    if (g->range_count) dp_sort(g->ranges, g->range_count, sizeof *g->ranges, by_start);
    return keep_rest(g, segment, &l);
}

/* ------- in which order ------- */

static bool make_grid(grid *g) {
    const dp_cleaning *const c = g->c;
    double length = 0;
    for (uint32_t i = 0; i < c->part_count; i++) length += line_of_part(c, &c->parts[i]).length;
    g->cell = dp_max(LEAST_CELL, length / (8 * (double)c->part_count));
    g->slots = 64;
    while ((double)g->slots < 2 * ((double)c->part_count + length / g->cell)) g->slots *= 2;
    return dp_reserve_zeroed(c->memory, &g->heads, &g->heads_cap, g->slots, sizeof *g->heads) &&
           dp_reserve(c->memory, &g->tracks, &g->tracks_cap, c->drawn->count, sizeof *g->tracks);
}

static bool is_crease(const dp_strand *s) {
    return s->line != DP_LINE_SILHOUETTE && s->line != DP_LINE_BORDER && s->line != DP_LINE_SECTION;
}

static int by_rank(const void *left, const void *right) {
    const dp_strand *const l = left, *const r = right;
    if (l->level != r->level) return l->level < r->level ? -1 : 1;
    if (is_crease(l) != is_crease(r)) return is_crease(l) ? 1 : -1;
    if (l->length != r->length) return l->length > r->length ? -1 : 1;
    return (l->first > r->first) - (l->first < r->first);
}

/* For ink that surfaces may hide in part: what the nearer of two lines lies on hides the other. */
static int by_nearness(const void *left, const void *right) {
    const dp_strand *const l = left, *const r = right;
    if (l->level != r->level) return l->level < r->level ? -1 : 1;
    if (l->nearest != r->nearest) return l->nearest < r->nearest ? -1 : 1;
    return by_rank(left, right);
}

static float nearest_end(const dp_cleaning *c, const dp_strand *s) {
    float nearest = INFINITY;
    uint32_t end = s->start;
    do {
        const dp_segment *const segment = dp_segment_at(c, end);
        nearest = dp_minf(nearest, dp_minf(segment->a[2], segment->b[2]));
        end = c->partner[end ^ 1];
    } while (end != DP_NOWHERE && end != s->start);
    return nearest;
}

static void rank_strands(dp_cleaning *c) {
    for (uint32_t i = 0; i < c->strand_count && c->nearer_first; i++)
        c->strands[i].nearest = nearest_end(c, &c->strands[i]);
    dp_sort(c->strands, c->strand_count, sizeof *c->strands,
            c->nearer_first ? by_nearness : by_rank);
}

static void number_chains(grid *g) {
    const dp_cleaning *const c = g->c;
    for (uint32_t i = 0; i < c->strand_count; i++) {
        uint32_t end = c->strands[i].start, place = 0;
        do {
            g->tracks[c->parts[end / 2].segment] = (track){i, place++};
            end = c->partner[end ^ 1];
        } while (end != DP_NOWHERE && end != c->strands[i].start);
    }
}

static bool take_chains(grid *g) {
    const dp_cleaning *const c = g->c;
    for (uint32_t i = 0; i < c->strand_count; i++) {
        uint32_t end = c->strands[i].start;
        do {
            if (!take(g, c->parts[end / 2].segment)) return false;
            end = c->partner[end ^ 1];
        } while (end != DP_NOWHERE && end != c->strands[i].start);
    }
    return true;
}

static int by_segment(const void *left, const void *right) {
    const dp_part *const l = left, *const r = right;
    if (l->segment != r->segment) return l->segment < r->segment ? -1 : 1;
    return (l->at[0] > r->at[0]) - (l->at[0] < r->at[0]);
}

/* What was kept takes the place of all parts. */
static void exchange(grid *g) {
    dp_cleaning *const c = g->c;
    dp_part *const parts = c->parts;
    const size_t cap = c->parts_cap;
    if (g->kept_count) dp_sort(g->kept, g->kept_count, sizeof *g->kept, by_segment);
    c->parts = g->kept, c->parts_cap = g->kept_cap, c->part_count = g->kept_count;
    g->kept = parts, g->kept_cap = cap;
    c->strand_count = 0;
}

bool dp_drop_coincident(dp_cleaning *c) {
    grid g = {.c = c};
    if (!c->part_count) return true;
    bool ok = dp_join_nodes(c, -2) && dp_find_strands(c) && make_grid(&g);
    if (ok) {
        rank_strands(c);
        number_chains(&g);
        ok = take_chains(&g);
    }
    if (ok) exchange(&g);
    dp_arrays_free(c->memory, &g, DP_ARRAYS(arrays));
    return ok;
}
