/* Chains are joined over gaps.
 *
 *     find the open ends, their directions, and the lengths of their chains
 *     offer each end those within reach that it may be joined with (grid), the best few
 *     take offers, best first, where both ends are still open
 *
 * The best offer is the nearest, but a turn counts like distance: of two ends beside a third the
 * one that it runs towards is taken. An end may be joined only forwards: what lies across the gap
 * must lie before it, the more so the wider the gap is, so that no hook and no step sideways is
 * drawn; or beside it, SIDEWAYS px off at most, where the way between lies in the ink of both. An end
 * that a cut made goes nowhere: there another line goes on. Only open ends are joined: a line that
 * merely passes has none there.
 *
 * Data structure: `opens`, the open ends; each knows the other end of its chain, and its length.
 * Invariant: the order of everything follows that of the ends. Not handled: of more than SEEN open
 * ends in a cell of the grid only the first are offered. */
#include "vector/join.h"

#include "base/sort.h"

#include <math.h>
#include <string.h>

static const double REACH = 2;       /* px: how much of a chain tells its direction */
static const double SIDEWAYS = 0.25; /* px: how far the other end may lie beside the first or behind
                                        it: what visibility leaves open */
static const double TURN = 1;        /* px that a turn of 90 degrees counts for */
static const double STEP = 30;    /* pixel sizes: ends further apart in depth lie on two surfaces */
static const float ACROSS = 0.7f; /* cosine: over a step of depth lines must go on straight */
static const float STRAIGHT = 0.9f; /* cosine: lines run side by side */
static const double CUT = 0.05;     /* px: where another line takes over, nothing else is joined */
static const double FOLD = 0.02;    /* px: so near, any turn draws nothing new */
enum { SEEN = 64, BEST = 6, LINKS = 16 };

typedef struct open_end {
    float x, y, d; /* px, px, world units */
    float out[2];  /* unit, the way in which the chain would go on */
    uint32_t end;  /* of a part */
    uint32_t far;  /* the other open end of its chain: its number here */
    uint32_t mate; /* that it has been joined with, or DP_NOWHERE */
    float length;  /* px, of its chain */
    uint32_t pen;  /* a hash of it */
} open_end;

/* An open end in its cell. */
typedef struct spot {
    float x, y; /* px */
    uint32_t open;
} spot;

typedef struct bridge {
    float cost, distance; /* px */
    uint32_t from, to;    /* numbers of open ends */
} bridge;

typedef struct gaps {
    dp_cleaning *c;
    double reach; /* px */
    double cell;
    open_end *opens;
    spot *spots;
    uint32_t *heads; /* [slots + 1] where in spots a slot's begin */
    bridge *bridges;
    size_t count, opens_cap, spots_cap, heads_cap, bridges_cap, bridge_count, slots;
} gaps;

static const dp_array arrays[] = {
    DP_ARRAY(gaps, opens, opens_cap), DP_ARRAY(gaps, spots, spots_cap),
    DP_ARRAY(gaps, heads, heads_cap), DP_ARRAY(gaps, bridges, bridges_cap)};

/* ------- open ends ------- */

/* The way in which a chain goes on beyond its end: from a point some px before it. */
static void find_direction(const dp_cleaning *c, open_end *o) {
    uint32_t end = o->end;
    double x = 0, y = 0, length = 0;
    for (int i = 0; i < LINKS; i++) {
        const dp_point p = dp_part_end(c, end ^ 1);
        x = (double)o->x - (double)p.x, y = (double)o->y - (double)p.y;
        length = dp_hypot(x, y);
        if (length >= REACH || c->partner[end ^ 1] == DP_NOWHERE) break;
        end = c->partner[end ^ 1];
    }
    o->out[0] = length > 0 ? (float)(x / length) : 0;
    o->out[1] = length > 0 ? (float)(y / length) : 0;
}

/* The chain's other end, and its length. */
static uint32_t walk(const dp_cleaning *c, uint32_t end, double *length) {
    *length = 0;
    for (;;) {
        const dp_point p = dp_part_end(c, end), q = dp_part_end(c, end ^ 1);
        *length += dp_hypot((double)p.x - (double)q.x, (double)p.y - (double)q.y);
        end ^= 1;
        if (c->partner[end] == DP_NOWHERE) return end;
        end = c->partner[end];
    }
}

static uint32_t pen_of(const gaps *g, uint32_t end) {
    const dp_segment *const s = dp_segment_at(g->c, end);
    uint32_t width;
    memcpy(&width, &s->width, sizeof width);
    const uint32_t line = g->c->desc.join_classes ? 0 : (uint32_t)s->line;
    return (s->color * 0x9e3779b1u ^ width) * 0x85ebca77u + 8 * s->level + line;
}

static uint32_t add_open(gaps *g, uint32_t end) {
    const dp_point p = dp_part_end(g->c, end);
    open_end *const o = &g->opens[g->count];
    *o = (open_end){
        .x = p.x, .y = p.y, .d = p.d, .end = end, .mate = DP_NOWHERE, .pen = pen_of(g, end)};
    find_direction(g->c, o);
    return (uint32_t)g->count++;
}

/* Both ends of each chain, one after the other, in the order of the first ones. */
static bool find_opens(gaps *g) {
    const dp_cleaning *const c = g->c;
    const uint32_t ends = 2 * c->part_count;
    for (uint32_t e = 0; e < ends; e++) {
        double length;
        if (c->partner[e] != DP_NOWHERE) continue;
        const uint32_t other = walk(c, e, &length);
        if (other < e) continue;
        if (!dp_reserve(c->memory, &g->opens, &g->opens_cap, g->count + 2, sizeof *g->opens))
            return false;
        const uint32_t one = add_open(g, e), two = add_open(g, other);
        g->opens[one].far = two, g->opens[two].far = one;
        g->opens[one].length = g->opens[two].length = (float)length;
    }
    return true;
}

/* ------- offers ------- */

static int32_t cell_of(const gaps *g, float px) {
    return (int32_t)floor(dp_max(-1e9, dp_min(1e9, (double)px / g->cell)));
}

static uint32_t *slot_of(const gaps *g, int32_t x, int32_t y) {
    return &g->heads[dp_cell_hash(x, y) & (g->slots - 1)];
}

/* Open ends sorted by the slot of their cell, each slot's in ascending order. */
static bool find_cells(gaps *g) {
    g->slots = 64;
    while (g->slots < g->count) g->slots *= 2;
    if (!dp_reserve_zeroed(g->c->memory, &g->heads, &g->heads_cap, g->slots + 1,
                           sizeof *g->heads) ||
        !dp_reserve(g->c->memory, &g->spots, &g->spots_cap, g->count, sizeof *g->spots))
        return false;
    for (size_t i = 0; i < g->count; i++)
        ++*slot_of(g, cell_of(g, g->opens[i].x), cell_of(g, g->opens[i].y));
    for (size_t s = 0, sum = 0; s <= g->slots; s++) sum += g->heads[s], g->heads[s] = (uint32_t)sum;
    for (size_t i = g->count; i-- > 0;) {
        const open_end *const o = &g->opens[i];
        g->spots[--*slot_of(g, cell_of(g, o->x), cell_of(g, o->y))] =
            (spot){o->x, o->y, (uint32_t)i};
    }
    return true;
}

/* Does a gap lead from one surface to another? */
static bool steps_in_depth(const dp_drawn *drawn, float d, float e) {
    if (!(drawn->focal > 0)) return false;
    const double near = dp_min((double)d, (double)e),
                 size = drawn->perspective ? near / drawn->focal : 1 / drawn->focal;
    return fabs((double)d - (double)e) > STEP * size;
}

static bool may_change_pen(const gaps *g, const open_end *p, const open_end *q) {
    const dp_segment *const s = dp_segment_at(g->c, p->end), *const t = dp_segment_at(g->c, q->end);
    return dp_same_pen(s, t) && (g->c->desc.join_classes || s->line == t->line);
}

/* Is a gap of (x, y) from p to q crossed forwards, or do both run side by side there and the one goes
 * on where the other ends? */
static bool runs_on(const open_end *p, const open_end *q, double x, double y, float turn) {
    const double distance = dp_hypot(x, y), least = 0.5 * distance - SIDEWAYS;
    const double ahead_p = x * (double)p->out[0] + y * (double)p->out[1],
                 ahead_q = -x * (double)q->out[0] - y * (double)q->out[1];
    if (ahead_p >= least && ahead_q >= least) return turn >= DP_SHARPEST + 0.35f * (float)distance;
    const double beside_p = fabs(x * (double)p->out[1] - y * (double)p->out[0]),
                 beside_q = fabs(x * (double)q->out[1] - y * (double)q->out[0]);
    return fabsf(turn) >= STRAIGHT && beside_p <= SIDEWAYS && beside_q <= SIDEWAYS;
}

/* What joining p with q costs, px; below 0: it may not be. */
static double cost_of(const gaps *g, const open_end *p, const open_end *q, double *distance) {
    const double x = (double)q->x - (double)p->x, y = (double)q->y - (double)p->y;
    *distance = dp_hypot(x, y);
    if (*distance > g->reach || p->end / 2 == q->end / 2 || p->pen != q->pen) return -1;
    if ((dp_is_cut(g->c, p->end) || dp_is_cut(g->c, q->end)) && *distance > CUT) return -1;
    const float turn = -(p->out[0] * q->out[0] + p->out[1] * q->out[1]); /* cosine */
    if (*distance > FOLD && !runs_on(p, q, x, y, turn)) return -1;
    if (turn < ACROSS && steps_in_depth(g->c->drawn, p->d, q->d)) return -1;
    return may_change_pen(g, p, q) ? *distance + TURN * (1 - (double)turn) : -1;
}

static void offer(const gaps *g, bridge best[BEST], int *n, uint32_t from, uint32_t to) {
    double distance;
    const double cost = cost_of(g, &g->opens[from], &g->opens[to], &distance);
    if (cost < 0) return;
    int at = *n;
    while (at > 0 && best[at - 1].cost > (float)cost) at--;
    if (at == BEST) return;
    if (*n < BEST) ++*n;
    memmove(best + at + 1, best + at, (size_t)(*n - at - 1) * sizeof *best);
    best[at] = (bridge){(float)cost, (float)distance, from, to};
}

static bool is_near(const gaps *g, uint32_t from, const spot *s) {
    const double x = (double)s->x - (double)g->opens[from].x,
                 y = (double)s->y - (double)g->opens[from].y;
    return s->open != from && x * x + y * y <= 1.01 * g->reach * g->reach;
}

/* An offer comes twice where it is among the best of both. */
static bool offer_bridges(gaps *g, uint32_t from) {
    const int32_t x = cell_of(g, g->opens[from].x), y = cell_of(g, g->opens[from].y);
    bridge best[BEST];
    int n = 0;
    for (int32_t k = 0; k < 9; k++) {
        const uint32_t *const slot = slot_of(g, x + k % 3 - 1, y + k / 3 - 1);
        const uint32_t last = slot[1] - slot[0] > SEEN ? slot[0] + SEEN : slot[1];
        for (uint32_t i = slot[0]; i < last; i++)
            if (is_near(g, from, &g->spots[i])) offer(g, best, &n, from, g->spots[i].open);
    }
    if (!dp_reserve(g->c->memory, &g->bridges, &g->bridges_cap, g->bridge_count + (size_t)n,
                    sizeof *g->bridges))
        return false;
    for (int i = 0; i < n; i++) {
        bridge b = best[i];
        if (b.from > b.to) b.from = best[i].to, b.to = best[i].from;
        g->bridges[g->bridge_count++] = b;
    }
    return true;
}

/* ------- joining ------- */

static int by_cost(const void *left, const void *right) {
    const bridge *const l = left, *const r = right;
    if (l->cost != r->cost) return l->cost < r->cost ? -1 : 1;
    if (l->from != r->from) return l->from < r->from ? -1 : 1;
    return (l->to > r->to) - (l->to < r->to);
}

static void join(gaps *g, const bridge *b) {
    open_end *const p = &g->opens[b->from], *const q = &g->opens[b->to];
    const bool closes = p->far == b->to;
    if (p->mate != DP_NOWHERE || q->mate != DP_NOWHERE) return;
    if (closes && p->length < 4 * b->distance) return; /* rather an open curl than a dot */
    p->mate = b->to, q->mate = b->from;
    g->c->partner[p->end] = q->end, g->c->partner[q->end] = p->end;
    if (b->distance > 0) g->c->joined++;
    g->c->joined_length += (double)b->distance;
    if (closes) return;
    const float length = p->length + q->length + b->distance;
    g->opens[p->far].length = g->opens[q->far].length = length;
    const uint32_t far = p->far;
    g->opens[p->far].far = q->far, g->opens[q->far].far = far;
}

bool dp_join_gaps(dp_cleaning *c) {
    gaps g = {.c = c, .reach = dp_max(0, (double)c->desc.join)};
    if (g.reach == 0 && !c->desc.join_classes) return true;
    g.cell = dp_max(g.reach, 1e-3);
    bool ok = find_opens(&g) && find_cells(&g);
    for (size_t i = 0; ok && i < g.count; i++) ok = offer_bridges(&g, g.spots[i].open);
    if (ok && g.bridge_count > 1) dp_sort(g.bridges, g.bridge_count, sizeof *g.bridges, by_cost);
    for (size_t i = 0; ok && i < g.bridge_count; i++) join(&g, &g.bridges[i]);
    dp_arrays_free(c->memory, &g, DP_ARRAYS(arrays));
    return ok;
}
