/* Joining segments end to end.
 *
 *     put ends with equal bits, class, level and colour into one node (hash table)
 *     in each node: pair the two ends that go on straightest, again and again
 *     over small gaps: pair open ends, nearest first (grid)
 *     walk from partner to partner: each walk is a chain
 *
 * Data structure: segment i has two ends, 2 i at a and 2 i + 1 at b; `partner` of each end.
 * Invariant: partner[partner[e]] == e. The order of everything follows the order of the segments,
 * never the hash. */
#include "strokes/chain.h"

#include "base/sort.h"

#include <string.h>

enum { NONE = UINT32_MAX, MOST_AT_NODE = 12, MOST_OFFERS = 64, SHORT = 64 /* links */ };

/* A way over a gap between two open ends. */
typedef struct dp_bridge {
    float distance;
    uint32_t e, f;
} bridge;

static const dp_array arrays[] = {
    DP_ARRAY(dp_chain_store, links, links_cap), DP_ARRAY(dp_chain_store, chains, chains_cap),
    DP_ARRAY(dp_chain_store, scratch, scratch_cap), DP_ARRAY(dp_chain_store, bridges, bridges_cap)};

void dp_chain_store_free(dp_chain_store *store, const dp_allocator *memory) {
    dp_arrays_free(memory, store, DP_ARRAYS(arrays));
    store->chain_count = 0;
}

uint64_t dp_chain_store_bytes(const dp_chain_store *store) {
    return dp_arrays_bytes(store, DP_ARRAYS(arrays));
}

typedef struct chaining {
    const dp_stroke *strokes;
    const dp_chain_rule *rule;
    uint32_t count;
    uint32_t *slots, *next, *partner,
        *visited;             /* slots: 1 + first end of a node; next: of the node, or NONE */
    uint32_t *cells, *beside; /* the same of cells */
    size_t slot_count;
} chaining;

static dp_point end_point(const chaining *c, uint32_t end) {
    const dp_stroke *const s = &c->strokes[end / 2];
    return end & 1 ? s->b : s->a;
}

static bool one_line(const chaining *c, const dp_stroke *s, const dp_stroke *t) {
    return c->rule->any_class ||
           (s->line == t->line && (c->rule->any_color || s->color == t->color));
}

static bool same_node(const chaining *c, uint32_t e, uint32_t f) {
    const dp_point p = end_point(c, e), q = end_point(c, f);
    const dp_stroke *const s = &c->strokes[e / 2], *const t = &c->strokes[f / 2];
    return p.x == q.x && p.y == q.y && p.d == q.d && s->level == t->level && one_line(c, s, t);
}

static uint32_t node_hash(const chaining *c, uint32_t end) {
    const dp_point p = end_point(c, end);
    uint32_t bits[3];
    memcpy(bits, &p, sizeof bits);
    uint32_t h = bits[0] * 0x9e3779b1u ^ bits[1] * 0x85ebca77u ^ bits[2] * 0xc2b2ae3du ^
                 (c->rule->any_class ? 0 : c->strokes[end / 2].line);
    h ^= h >> 15, h *= 0x2c1b3c6du;
    return h ^ h >> 13;
}

static size_t node_slot(const chaining *c, uint32_t end) {
    size_t s = node_hash(c, end) & (c->slot_count - 1);
    while (c->slots[s] && !same_node(c, c->slots[s] - 1, end)) s = (s + 1) & (c->slot_count - 1);
    return s;
}

/* Ends into lists by node, each in ascending order. */
static void find_nodes(const chaining *c) {
    memset(c->slots, 0, c->slot_count * sizeof *c->slots);
    for (uint32_t i = 2 * c->count; i-- > 0;) {
        const size_t s = node_slot(c, i);
        c->next[i] = c->slots[s] ? c->slots[s] - 1 : NONE;
        c->slots[s] = i + 1;
        c->partner[i] = NONE;
    }
}

/* Cosine of the turn between coming in through `e` and leaving through `f`. */
static float straightness(const chaining *c, uint32_t e, uint32_t f) {
    const dp_point p = end_point(c, e), from = end_point(c, e ^ 1), to = end_point(c, f ^ 1);
    const float ax = p.x - from.x, ay = p.y - from.y, bx = to.x - p.x, by = to.y - p.y;
    const float length = sqrtf((ax * ax + ay * ay) * (bx * bx + by * by));
    return length > 0 ? (ax * bx + ay * by) / length : 1;
}

static int8_t side_at(const chaining *c, uint32_t end) {
    return c->rule->side ? c->rule->side[end / 2] : 0;
}

static bool may_join(const chaining *c, uint32_t e, uint32_t f) {
    if (e / 2 == f / 2) return false;
    if (!side_at(c, e)) return straightness(c, e, f) >= c->rule->sharpest;
    /* entered at b one goes from a to b, left at a as well: then the sides must agree */
    const bool along = (e & 1) != (f & 1);
    return along == (side_at(c, e) == side_at(c, f));
}

static void partner_node(const chaining *c, uint32_t first) {
    uint32_t ends[MOST_AT_NODE], n = 0;
    for (uint32_t e = first; e != NONE && n < MOST_AT_NODE; e = c->next[e]) ends[n++] = e;
    for (;;) {
        float best = -2;
        uint32_t p = NONE, q = NONE;
        for (uint32_t i = 0; i < n; i++)
            for (uint32_t k = i + 1; k < n; k++) {
                if (c->partner[ends[i]] != NONE || c->partner[ends[k]] != NONE ||
                    !may_join(c, ends[i], ends[k]))
                    continue;
                const float s = straightness(c, ends[i], ends[k]);
                if (s > best) best = s, p = ends[i], q = ends[k];
            }
        if (p == NONE) return;
        c->partner[p] = q, c->partner[q] = p;
    }
}

/* ------- over gaps ------- */

static int by_distance(const void *left, const void *right) {
    const bridge *const l = left, *const r = right;
    if (l->distance != r->distance) return l->distance < r->distance ? -1 : 1;
    if (l->e != r->e) return l->e < r->e ? -1 : 1;
    return (l->f > r->f) - (l->f < r->f);
}

static size_t cell_slot(const chaining *c, int32_t x, int32_t y) {
    const uint32_t h = ((uint32_t)x * 0x9e3779b1u) ^ ((uint32_t)y * 0x85ebca77u);
    return (h ^ h >> 15) & (c->slot_count - 1);
}

/* Cells are as wide as the gap, or a pixel. */
static int32_t cell_of(const chaining *c, float px) {
    return (int32_t)floorf(px / dp_maxf(c->rule->gap, 1));
}

/* Is it an end from which a chain may go on over a gap? */
static bool is_open(const chaining *c, uint32_t end) {
    return c->partner[end] == NONE && c->strokes[end / 2].turn >= c->rule->sharp;
}

/* Open ends into lists by grid cell; cells that share a slot share a list. */
static void find_cells(const chaining *c) {
    memset(c->cells, 0, c->slot_count * sizeof *c->cells);
    for (uint32_t i = 2 * c->count; i-- > 0;) {
        if (!is_open(c, i)) continue;
        const dp_point p = end_point(c, i);
        uint32_t *const slot = &c->cells[cell_slot(c, cell_of(c, p.x), cell_of(c, p.y))];
        c->beside[i] = *slot ? *slot - 1 : NONE;
        *slot = i + 1;
    }
}

static bool may_bridge(const chaining *c, uint32_t e, uint32_t f, float *distance) {
    const dp_stroke *const s = &c->strokes[e / 2], *const t = &c->strokes[f / 2];
    const dp_point p = end_point(c, e), q = end_point(c, f);
    *distance = dp_hypotf(q.x - p.x, q.y - p.y);
    return *distance <= (side_at(c, e) ? c->rule->side_gap : c->rule->gap) &&
           fabsf(p.d - q.d) <= c->rule->step && s->level == t->level && one_line(c, s, t) &&
           may_join(c, e, f);
}

/* Ways from an open end to those of higher numbers. From a crowd of ends, as of a model that is a dot, only
 * some are offered: all pairs would take a square of the time and memory. */
static bool offer_bridges(const chaining *c, uint32_t e, const dp_allocator *memory,
                          dp_chain_store *store, size_t *n) {
    const size_t most = *n + MOST_OFFERS;
    const dp_point p = end_point(c, e);
    const float gap = c->rule->gap;
    const int32_t x0 = cell_of(c, p.x - gap), x1 = cell_of(c, p.x + gap),
                  y0 = cell_of(c, p.y - gap), y1 = cell_of(c, p.y + gap), columns = x1 - x0 + 1;
    for (int32_t k = 0; k < columns * (y1 - y0 + 1); k++) {
        const uint32_t head = c->cells[cell_slot(c, x0 + k % columns, y0 + k / columns)];
        for (uint32_t f = head ? head - 1 : NONE; f != NONE; f = c->beside[f]) {
            float distance;
            if (f <= e || !may_bridge(c, e, f, &distance)) continue;
            if (!dp_reserve(memory, &store->bridges, &store->bridges_cap, *n + 1,
                            sizeof *store->bridges))
                return false;
            store->bridges[(*n)++] = (bridge){distance, e, f};
            if (*n == most) return true;
        }
    }
    return true;
}

/* Would mating the ends close a chain of a few segments? */
static bool closes_short(const chaining *c, uint32_t e, uint32_t f) {
    uint32_t end = e ^ 1;
    for (int i = 0; i < SHORT; i++) {
        if (end == f) return true;
        if (c->partner[end] == NONE) return false;
        end = c->partner[end] ^ 1;
    }
    return false;
}

static bool bridge_gaps(const chaining *c, const dp_allocator *memory, dp_chain_store *store) {
    size_t n = 0;
    if (!(c->rule->gap > 0)) return true;
    find_cells(c);
    for (uint32_t e = 0; e < 2 * c->count; e++)
        if (is_open(c, e) && !offer_bridges(c, e, memory, store, &n)) return false;
    if (n) dp_sort(store->bridges, n, sizeof *store->bridges, by_distance);
    for (size_t i = 0; i < n; i++) {
        const uint32_t e = store->bridges[i].e, f = store->bridges[i].f;
        if (c->partner[e] == NONE && c->partner[f] == NONE && !closes_short(c, e, f))
            c->partner[e] = f, c->partner[f] = e;
    }
    return true;
}

/* ------- walking ------- */

/* The end at which the chain through a segment begins; that of the segment itself where it is
 * closed. */
static uint32_t find_start(const chaining *c, uint32_t segment, bool *closed) {
    uint32_t end = 2 * segment; /* going backwards, out of a */
    *closed = false;
    while (c->partner[end] != NONE) {
        end = c->partner[end] ^ 1;
        if (end == 2 * segment) {
            *closed = true;
            return end;
        }
    }
    return end;
}

static void walk(const chaining *c, uint32_t start, dp_chain_store *store, dp_chain *chain,
                 uint32_t *links) {
    uint32_t end = start;
    for (;;) {
        store->links[(*links)++] = (dp_link){end / 2, end & 1};
        c->visited[end / 2] = 1;
        chain->count++;
        const uint32_t next = c->partner[end ^ 1];
        if (next == NONE || c->visited[next / 2]) return;
        end = next;
    }
}

bool dp_make_chains(const dp_stroke *strokes, uint32_t count, const dp_chain_rule *rule,
                    const dp_allocator *memory, dp_chain_store *store) {
    chaining c = {.strokes = strokes, .rule = rule, .count = count, .slot_count = 64};
    while (c.slot_count < 4 * (size_t)count) c.slot_count *= 2;
    store->chain_count = 0;
    store->slot_count = c.slot_count;
    const size_t cells = rule->gap > 0 ? c.slot_count + 2 * (size_t)count : 0;
    if (!dp_reserve(memory, &store->scratch, &store->scratch_cap,
                    c.slot_count + 5 * (size_t)count + cells, sizeof(uint32_t)) ||
        !dp_reserve(memory, &store->links, &store->links_cap, count, sizeof *store->links) ||
        !dp_reserve(memory, &store->chains, &store->chains_cap, count, sizeof *store->chains))
        return false;
    c.slots = store->scratch, c.next = c.slots + c.slot_count,
    c.partner = c.next + 2 * (size_t)count;
    c.visited = c.partner + 2 * (size_t)count;
    c.cells = c.visited + count, c.beside = c.cells + c.slot_count;
    if (count) memset(c.visited, 0, count * sizeof *c.visited);
    find_nodes(&c);
    for (size_t s = 0; s < c.slot_count; s++)
        if (c.slots[s]) partner_node(&c, c.slots[s] - 1);
    if (!bridge_gaps(&c, memory, store)) return false;
    uint32_t links = 0;
    for (uint32_t i = 0; i < count; i++) {
        if (c.visited[i]) continue;
        dp_chain *const chain = &store->chains[store->chain_count++];
        *chain = (dp_chain){.first = links};
        walk(&c, find_start(&c, i, &chain->closed), store, chain, &links);
    }
    return true;
}

uint32_t dp_first_end_at(const dp_chain_store *store, const dp_stroke *strokes, uint32_t count,
                         const dp_chain_rule *rule, uint32_t end) {
    const chaining c = {.strokes = strokes,
                        .rule = rule,
                        .count = count,
                        .slots = store->scratch,
                        .slot_count = store->slot_count};
    return c.slots[node_slot(&c, end)] - 1;
}
