/* Parts are joined where their ends are equal.
 *
 *     put ends with equal bits, class, level and pen into one node (hash table)
 *     in each node: pair the two ends that go on straightest, again and again
 *
 * Data structure: `next` links the ends of a node, in ascending order. Invariant: who is paired
 * with whom follows the order of the parts, never that of the hash. In nodes of more than CROWD
 * ends each end is offered to a few only: those that come next to it as lines sorted by direction,
 * and leave on the other side; so 100,000 ends in one point are sorted once. */
#include "vector/join.h"

#include "base/sort.h"

#include <math.h>
#include <string.h>

enum { CROWD = 12, OFFERS = 4 };

typedef struct offer {
    float straight;
    uint32_t e, f;
} offer;

typedef struct spoke {
    float way; /* direction of the line, in [0, 2); as 1 - x / (|x| + |y|) in the upper half */
    bool down;
    uint32_t end;
} spoke;

typedef struct nodes {
    dp_cleaning *c;
    float sharpest; /* cosine */
    uint32_t *slots, *next;
    offer *offers;
    spoke *spokes;
    size_t slots_cap, next_cap, offers_cap, spokes_cap, slot_count;
} nodes;

static const dp_array arrays[] = {
    DP_ARRAY(nodes, slots, slots_cap), DP_ARRAY(nodes, next, next_cap),
    DP_ARRAY(nodes, offers, offers_cap), DP_ARRAY(nodes, spokes, spokes_cap)};

/* -0 is 0. */
static uint32_t bits_of(float x) {
    uint32_t bits;
    x += 0.0f;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static uint32_t hash_of(const dp_cleaning *c, uint32_t end) {
    const dp_point p = dp_part_end(c, end);
    const dp_segment *const s = dp_segment_at(c, end);
    uint32_t h = bits_of(p.x) * 0x9e3779b1u ^ bits_of(p.y) * 0x85ebca77u ^
                 bits_of(p.d) * 0xc2b2ae3du ^ ((uint32_t)s->line + 8 * s->level);
    h ^= h >> 15, h *= 0x2c1b3c6du;
    return h ^ h >> 13;
}

static bool same_node(const dp_cleaning *c, uint32_t e, uint32_t f) {
    const dp_point p = dp_part_end(c, e), q = dp_part_end(c, f);
    const dp_segment *const s = dp_segment_at(c, e), *const t = dp_segment_at(c, f);
    return p.x == q.x && p.y == q.y && p.d == q.d && s->line == t->line && dp_same_pen(s, t);
}

/* Ends into lists by node, each in ascending order. */
static void find_nodes(const nodes *n) {
    const size_t mask = n->slot_count - 1;
    for (uint32_t e = 2 * n->c->part_count; e-- > 0;) {
        size_t s = hash_of(n->c, e) & mask;
        while (n->slots[s] && !same_node(n->c, n->slots[s] - 1, e)) s = (s + 1) & mask;
        n->next[e] = n->slots[s] ? n->slots[s] - 1 : DP_NOWHERE;
        n->slots[s] = e + 1;
    }
}

/* Cosine of the turn between coming in through `e` and leaving through `f`. */
static float straightness(const dp_cleaning *c, uint32_t e, uint32_t f) {
    const dp_point p = dp_part_end(c, e), from = dp_part_end(c, e ^ 1), to = dp_part_end(c, f ^ 1);
    const double ax = (double)p.x - (double)from.x, ay = (double)p.y - (double)from.y,
                 bx = (double)to.x - (double)p.x, by = (double)to.y - (double)p.y;
    const double length = sqrt((ax * ax + ay * ay) * (bx * bx + by * by));
    return length > 0 ? (float)((ax * bx + ay * by) / length) : 1;
}

static void pair(const dp_cleaning *c, uint32_t e, uint32_t f) {
    c->partner[e] = f, c->partner[f] = e;
}

static int straightest_first(const void *left, const void *right) {
    const offer *const l = left, *const r = right;
    if (l->straight != r->straight) return l->straight > r->straight ? -1 : 1;
    if (l->e != r->e) return l->e < r->e ? -1 : 1;
    return (l->f > r->f) - (l->f < r->f);
}

static bool add_offer(nodes *n, size_t *count, uint32_t e, uint32_t f) {
    const float straight = straightness(n->c, e, f);
    if (e / 2 == f / 2 || !(straight >= n->sharpest)) return true;
    if (!dp_reserve(n->c->memory, &n->offers, &n->offers_cap, *count + 1, sizeof *n->offers))
        return false;
    n->offers[(*count)++] = (offer){straight, e < f ? e : f, e < f ? f : e};
    return true;
}

static void take_offers(nodes *n, size_t count) {
    if (count > 1) dp_sort(n->offers, count, sizeof *n->offers, straightest_first);
    for (size_t i = 0; i < count; i++) {
        const offer *const o = &n->offers[i];
        if (n->c->partner[o->e] == DP_NOWHERE && n->c->partner[o->f] == DP_NOWHERE)
            pair(n->c, o->e, o->f);
    }
}

static bool pair_few(nodes *n, uint32_t first) {
    size_t count = 0;
    for (uint32_t e = first; e != DP_NOWHERE; e = n->next[e])
        for (uint32_t f = n->next[e]; f != DP_NOWHERE; f = n->next[f])
            if (!add_offer(n, &count, e, f)) return false;
    take_offers(n, count);
    return true;
}

static int by_way(const void *left, const void *right) {
    const spoke *const l = left, *const r = right;
    if (l->way != r->way) return l->way < r->way ? -1 : 1;
    return (l->end > r->end) - (l->end < r->end);
}

static spoke spoke_of(const dp_cleaning *c, uint32_t end) {
    const dp_point p = dp_part_end(c, end), q = dp_part_end(c, end ^ 1);
    double x = (double)q.x - (double)p.x, y = (double)q.y - (double)p.y;
    const bool down = y < 0 || (y == 0 && x < 0);
    if (down) x = -x, y = -y;
    return (spoke){fabs(x) + y > 0 ? (float)(1 - x / (fabs(x) + y)) : 0, down, end};
}

static bool pair_crowd(nodes *n, uint32_t first, size_t count) {
    size_t at = 0, offers = 0;
    if (!dp_reserve(n->c->memory, &n->spokes, &n->spokes_cap, count, sizeof *n->spokes))
        return false;
    for (uint32_t e = first; e != DP_NOWHERE; e = n->next[e]) n->spokes[at++] = spoke_of(n->c, e);
    dp_sort(n->spokes, count, sizeof *n->spokes, by_way);
    for (size_t i = 0; i < count; i++)
        for (size_t k = 1; k <= OFFERS; k++) {
            const spoke *const s = &n->spokes[i], *const t = &n->spokes[(i + k) % count];
            if ((i + k < count) == (s->down == t->down))
                continue; /* round the end ways are turned */
            if (!add_offer(n, &offers, s->end, t->end)) return false;
        }
    take_offers(n, offers);
    return true;
}

static bool pair_node(nodes *n, uint32_t first) {
    size_t count = 0;
    for (uint32_t e = first; e != DP_NOWHERE; e = n->next[e]) count++;
    if (count < 2) return true;
    return count <= CROWD ? pair_few(n, first) : pair_crowd(n, first, count);
}

bool dp_join_nodes(dp_cleaning *c, float sharpest) {
    nodes n = {.c = c, .sharpest = sharpest, .slot_count = 64};
    const size_t ends = 2 * (size_t)c->part_count;
    if (!dp_reserve(c->memory, &c->partner, &c->partner_cap, ends, sizeof *c->partner))
        return false;
    for (size_t e = 0; e < ends; e++) c->partner[e] = DP_NOWHERE;
    while (n.slot_count < 2 * ends) n.slot_count *= 2;
    bool ok = dp_reserve_zeroed(c->memory, &n.slots, &n.slots_cap, n.slot_count, sizeof *n.slots) &&
              dp_reserve(c->memory, &n.next, &n.next_cap, ends, sizeof *n.next);
    if (ok) find_nodes(&n);
    for (size_t s = 0; ok && s < n.slot_count; s++)
        if (n.slots[s]) ok = pair_node(&n, n.slots[s] - 1);
    dp_arrays_free(c->memory, &n, DP_ARRAYS(arrays));
    return ok;
}
