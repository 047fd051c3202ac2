/* Splits polygons that are not convex or not planar into triangles, by clipping ears.
 *
 *    a = the first corner
 *    until three corners are left
 *        b, c = the next two
 *        (a, b, c) turns left and holds no other corner: cut b off
 *        else: a = b; after a round without an ear, cut b off all the same
 *
 * Works on the projection along the polygon's mean normal (Newell). Invariant: each cut removes one
 * corner, and n - 2 cuts always end it, also where a polygon crosses itself. Few corners are tested
 * in just this way (clip_few). With many that would take time by the third power of their number,
 * so clip_many, which cuts the same ears in the same order,
 *
 *    asks a tree of boxes which corner lies in a triangle (corner_tree.h);
 *    tests a triangle again only when a corner of it has changed, or the corner that was found in it
 *        is cut off: until then it waits for that one (`waiting`);
 *    finds the next triangle to be tried in a tree of bits (`untried`).
 *
 * Beyond MOST_CORNERS it does not stay at `a` after a cut but goes on to `c`. Triangles then are
 * short in all directions, where those that share `a` would be as many needles through most of the
 * picture's tiles, each of which looks at all of them. */
#include "base/elementary.h"
#include "base/hostile.h"
#include "base/vec.h"
#include "mesh/polygons.h"

#include <string.h>

enum {
    FEW_CORNERS = DP_TUNED(32, 4),
    MOST_CORNERS = 4096 /* … of a polygon that stays whole, too */
};

/* When look-ups have visited so much, all cuts are made as if there were no ear. Ordinary polygons
 * need some 20 to 100 visits per corner. */
static const uint64_t VISITS = 1 << 26, VISITS_PER_CORNER = 512;

/* A polygon is not planar if a corner lies more than this share of its size out of the mean plane:
 * far less than depth shows, far more than float32 rounding. */
static const double PLANAR = 1e-4;

enum { BIT_LEVELS = 6 }; /* 64^6 > 2^32 */

/* A triangle, by its first corner, that waits for a point to be cut off. */
typedef struct dp_waiting {
    uint32_t point;         /* of the tree; NONE: it does not wait */
    uint32_t before, after; /* it in the list of all that wait for the point; NONE: no other */
} dp_waiting;

#define NONE UINT32_MAX

static const dp_array arrays[] = {DP_ARRAY(dp_split_scratch, at, at_cap),
                                  DP_ARRAY(dp_split_scratch, links, links_cap),
                                  DP_ARRAY(dp_split_scratch, triangles, triangles_cap),
                                  DP_ARRAY(dp_split_scratch, waiting, waiting_cap),
                                  DP_ARRAY(dp_split_scratch, previous, previous_cap),
                                  DP_ARRAY(dp_split_scratch, waiters, waiters_cap),
                                  DP_ARRAY(dp_split_scratch, untried, untried_cap)};

static bool reserve_many(dp_split_scratch *s, size_t n, const dp_allocator *memory) {
    const size_t words = n / 63 + BIT_LEVELS; /* n/64 + n/64/64 + …, each rounded up */
    return dp_corner_tree_reserve(&s->tree, n, memory) &&
           dp_reserve(memory, &s->waiting, &s->waiting_cap, n, sizeof *s->waiting) &&
           dp_reserve(memory, &s->previous, &s->previous_cap, n, sizeof *s->previous) &&
           dp_reserve(memory, &s->waiters, &s->waiters_cap, n, sizeof *s->waiters) &&
           dp_reserve(memory, &s->untried, &s->untried_cap, words, sizeof *s->untried);
}

bool dp_split_scratch_reserve(dp_split_scratch *s, size_t n, const dp_allocator *memory) {
    return dp_reserve(memory, &s->at, &s->at_cap, n, sizeof *s->at) &&
           dp_reserve(memory, &s->links, &s->links_cap, n, sizeof *s->links) &&
           dp_reserve(memory, &s->triangles, &s->triangles_cap, n, sizeof *s->triangles) &&
           (n <= FEW_CORNERS || reserve_many(s, n, memory));
}

void dp_split_scratch_free(dp_split_scratch *scratch, const dp_allocator *memory) {
    dp_arrays_free(memory, scratch, DP_ARRAYS(arrays));
    dp_corner_tree_free(&scratch->tree, memory);
}

uint64_t dp_split_scratch_bytes(const dp_split_scratch *scratch) {
    return dp_arrays_bytes(scratch, DP_ARRAYS(arrays)) + dp_corner_tree_bytes(&scratch->tree);
}

static dp_vec3 newell(const float *const *at, uint32_t n, double *size) {
    dp_vec3 sum = {0, 0, 0};
    const dp_vec3 origin = dp_v3f(at[0]);
    *size = 0;
    for (uint32_t i = 0; i < n; i++) {
        const dp_vec3 a = dp_sub(dp_v3f(at[i]), origin);
        const dp_vec3 b = dp_sub(dp_v3f(at[(i + 1) % n]), origin);
        sum = dp_add(sum, dp_cross(a, b));
        *size = fmax(*size, dp_length(a));
    }
    return dp_unit(sum);
}

bool dp_stays_whole(const float *const *at, uint32_t n) {
    if (n > MOST_CORNERS) return false;
    double size, turned = 0;
    const dp_vec3 normal = newell(at, n, &size);
    for (uint32_t i = 0; i < n; i++) {
        const dp_vec3 b = dp_v3f(at[(i + 1) % n]);
        const dp_vec3 in = dp_sub(b, dp_v3f(at[i])), out = dp_sub(dp_v3f(at[(i + 2) % n]), b);
        const double turn = dp_dot(dp_cross(in, out), normal);
        if (turn < -PLANAR * dp_length(in) * dp_length(out)) return false;
        if (fabs(dp_dot(dp_sub(b, dp_v3f(at[0])), normal)) > PLANAR * size) return false;
        turned += dp_atan2(turn, dp_dot(in, out));
    }
    return turned <
           7; /* once around is 2 pi; a pentagram also turns left everywhere, but twice around */
}

static dp_flat flatten(const float *const *at, uint32_t n) {
    double size;
    const dp_vec3 normal = newell(at, n, &size);
    const dp_vec3 axis = fabs(normal.x) < 0.6 ? dp_v3(1, 0, 0) : dp_v3(0, 1, 0);
    dp_flat f = {.at = at, .u = dp_unit(dp_cross(axis, normal))};
    f.v = dp_cross(normal, f.u);
    return f;
}

static void put(dp_split_scratch *s, uint32_t *count, uint32_t a, uint32_t b, uint32_t c) {
    uint32_t *const triangle = s->triangles[(*count)++];
    triangle[0] = a, triangle[1] = b, triangle[2] = c;
}

/* ------- few corners ------- */

/* Corners of a bridge from a hole to the outline come twice. */
static bool coincide(const dp_flat *f, uint32_t a, uint32_t b) {
    return f->at[a][0] == f->at[b][0] && f->at[a][1] == f->at[b][1] && f->at[a][2] == f->at[b][2];
}

/* Does the triangle (a, b, c) turn left, with no other remaining corner in it? */
static bool is_ear(const dp_flat *f, const uint32_t *next, uint32_t a, uint32_t b, uint32_t c) {
    if (!(dp_flat_side(f, a, b, c) > 0)) return false;
    for (uint32_t p = next[c]; p != a; p = next[p])
        if (!coincide(f, p, a) && !coincide(f, p, b) && !coincide(f, p, c) &&
            dp_flat_side(f, a, b, p) >= 0 && dp_flat_side(f, b, c, p) >= 0 &&
            dp_flat_side(f, c, a, p) >= 0)
            return false;
    return true;
}

static uint32_t clip_few(dp_split_scratch *s, const dp_flat *f, uint32_t n, uint32_t *count) {
    uint32_t left = n, a = 0, tries = 0;
    while (left > 3) {
        const uint32_t b = s->links[a], c = s->links[b];
        if (tries <= left && !is_ear(f, s->links, a, b, c)) {
            a = b;
            tries++;
            continue;
        }
        put(s, count, a, b, c);
        s->links[a] = c;
        left--;
        tries = 0;
    }
    return a;
}

/* ------- which triangle is tried next ------- */

/* A set of numbers below n. Bit i of a level says whether word i of the level below has any. */
typedef struct set {
    uint64_t *words[BIT_LEVELS];
    uint32_t length[BIT_LEVELS]; /* words */
    uint32_t levels;             /* the last has one word */
} set;

static set make_full_set(uint64_t *words, uint32_t n) {
    set s = {.levels = 0};
    do {
        const uint32_t length = (n + 63) / 64;
        memset(words, 0xff, length * sizeof *words);
        if (n % 64) words[length - 1] = ((uint64_t)1 << n % 64) - 1;
        s.words[s.levels] = words;
        s.length[s.levels++] = length;
        words += length;
        n = length;
    } while (n > 1);
    return s;
}

static void add(set *s, uint32_t i) {
    for (uint32_t level = 0; level < s->levels; level++, i /= 64)
        s->words[level][i / 64] |= (uint64_t)1 << i % 64;
}

static void drop(set *s, uint32_t i) {
    for (uint32_t level = 0; level < s->levels; level++, i /= 64)
        if (s->words[level][i / 64] &= ~((uint64_t)1 << i % 64)) return;
}

/* The least number that is not below i; NONE: there is none. */
static uint32_t first_from(const set *s, uint32_t i) {
    uint32_t level = 0;
    for (;; level++, i = i / 64 + 1) {
        if (level == s->levels || i / 64 == s->length[level]) return NONE;
        const uint64_t rest = s->words[level][i / 64] & ~(uint64_t)0 << i % 64;
        if (!rest) continue;
        i = i / 64 * 64 + (uint32_t)__builtin_ctzll(rest);
        break;
    }
    while (level--) i = 64 * i + (uint32_t)__builtin_ctzll(s->words[level][i]);
    return i;
}

/* ------- many corners ------- */

typedef struct clipper {
    dp_split_scratch *s;
    set untried; /* triangles, by their first corner, that may be ears */
} clipper;

/* Triangle a is as good as new. */
static void try_again(clipper *c, uint32_t a) {
    dp_waiting *const w = &c->s->waiting[a];
    add(&c->untried, a);
    if (w->point == NONE) return;
    if (w->after != NONE) c->s->waiting[w->after].before = w->before;
    if (w->before != NONE)
        c->s->waiting[w->before].after = w->after;
    else
        c->s->waiters[w->point] = w->after;
    w->point = NONE;
}

static void wait_for(clipper *c, uint32_t a, uint32_t point) {
    uint32_t *const first = &c->s->waiters[point];
    if (*first != NONE) c->s->waiting[*first].before = a;
    c->s->waiting[a] = (dp_waiting){point, NONE, *first};
    *first = a;
}

static void cut_off(clipper *c, uint32_t a) {
    dp_split_scratch *const s = c->s;
    const uint32_t b = s->links[a], point = s->tree.point_of[b];
    s->links[a] = s->links[b];
    s->previous[s->links[b]] = a;
    try_again(c, a);
    try_again(c, s->previous[a]);
    try_again(c, b), drop(&c->untried, b);
    if (!dp_corner_tree_remove(&s->tree, b)) return;
    while (s->waiters[point] != NONE) try_again(c, s->waiters[point]);
}

/* The next triangle from corner a on that is an ear; NONE: there is none. */
static uint32_t next_ear(clipper *c, uint32_t a) {
    dp_split_scratch *const s = c->s;
    for (;;) {
        uint32_t i = first_from(&c->untried, a);
        if (i == NONE) i = first_from(&c->untried, 0);
        if (i == NONE) return NONE;
        const uint32_t b = s->links[i], d = s->links[b];
        drop(&c->untried, i);
        if (!(dp_flat_side(&s->tree.flat, i, b, d) > 0)) continue;
        const uint32_t point = dp_corner_tree_find(&s->tree, i, b, d);
        if (point == NONE) return i;
        wait_for(c, i, point);
    }
}

static uint32_t clip_many(dp_split_scratch *s, const dp_flat *f, uint32_t n, uint32_t *count) {
    clipper c = {s, make_full_set(s->untried, n)};
    const uint64_t most = VISITS + VISITS_PER_CORNER * n;
    dp_corner_tree_build(&s->tree, f, n);
    for (uint32_t i = 0; i < n; i++) {
        s->previous[i] = (i + n - 1) % n;
        s->waiters[i] = NONE;
        s->waiting[i].point = NONE;
    }
    uint32_t a = 0, start = 0;
    for (uint32_t left = n; left > 3; left--) {
        const uint32_t ear = s->tree.visits < most ? next_ear(&c, start) : NONE;
        a = ear == NONE ? s->links[start] : ear;
        put(s, count, a, s->links[a], s->links[s->links[a]]);
        cut_off(&c, a);
        start = n > MOST_CORNERS ? s->links[a] : a;
    }
    return a;
}

uint32_t dp_split_polygon(dp_split_scratch *s, uint32_t n) {
    const dp_flat f = flatten(s->at, n);
    uint32_t count = 0;
    for (uint32_t i = 0; i < n; i++) s->links[i] = (i + 1) % n;
    const uint32_t a = (n > FEW_CORNERS ? clip_many : clip_few)(s, &f, n, &count);
    put(s, &count, a, s->links[a], s->links[s->links[a]]);
    return count;
}
