/* Twins of a scene. Each step goes through all polygons and adds what becomes of them to the next
 * soup. */
#include "twin.h"

#include <stdlib.h>
#include <string.h>

#define HERE              .place = {.scale = 1}
#define MOVED(dx, dy, dz) .place = {.scale = 1, .offset = {dx, dy, dz}}

/* clang-format off */
const twin_kind twin_kinds[] = {
    {.name = "reverse-all",  .steps = TWIN_REVERSE_ALL, HERE},
    {.name = "reverse-some", .steps = TWIN_REVERSE_SOME, HERE},
    {.name = "double-all",   .steps = TWIN_DOUBLE_ALL, HERE},
    {.name = "double-some",  .steps = TWIN_DOUBLE_SOME, HERE},
    {.name = "collinear",    .steps = TWIN_COLLINEAR, HERE},
    {.name = "fan",          .steps = TWIN_FAN, HERE},
    {.name = "star",         .steps = TWIN_STAR, HERE},
    {.name = "cut",          .steps = TWIN_CUT, HERE},
    {.name = "shuffle",      .steps = TWIN_SHUFFLE, HERE},
    {.name = "soup",         .place = {.scale = 1, .sharing = SOUP_NONE}},
    {.name = "weld",         .place = {.scale = 1, .sharing = SOUP_ALL}},
    {.name = "far-1e3",      MOVED(1000, -1000, 500)},
    {.name = "far-5e5",      MOVED(500000, 540000, 200), .exact_only = true},
    {.name = "small",        .place = {.scale = 1e-3}},
    {.name = "big",          .place = {.scale = 1e3}},
    {.name = "streamed",     HERE, .streamed = true},
    {.name = "table-off",    HERE, .table_off = true},
    {.name = "adjacency",    HERE, .adjacency = true},
    {.name = "mixed",
     .steps = TWIN_CUT | TWIN_COLLINEAR | TWIN_FAN | TWIN_DOUBLE_SOME | TWIN_REVERSE_SOME | TWIN_SHUFFLE,
     .place = {.scale = 1, .sharing = SOUP_NONE}},
    {.name = "mixed-streamed",
     .steps = TWIN_CUT | TWIN_FAN | TWIN_DOUBLE_SOME | TWIN_REVERSE_SOME | TWIN_SHUFFLE,
     .place = {.scale = 1, .sharing = SOUP_NONE}, .streamed = true},
};
/* clang-format on */
const size_t twin_kind_count = sizeof twin_kinds / sizeof *twin_kinds;

const twin_kind *twin_kind_named(const char *name) {
    for (size_t i = 0; i < twin_kind_count; i++)
        if (!strcmp(twin_kinds[i].name, name)) return &twin_kinds[i];
    return NULL;
}

typedef void step(dice *d, const v3 *p, uint32_t n, uint32_t part, soup *out);

static bool some(dice *d) { return dice_chance(d, 0.4); }

static void keep(dice *d, const v3 *p, uint32_t n, uint32_t part, soup *out) {
    (void)d;
    soup_add(out, p, n, part);
}

static void reverse(dice *d, const v3 *p, uint32_t n, uint32_t part, soup *out) {
    v3 q[TWIN_CORNERS];
    (void)d;
    for (uint32_t i = 0; i < n; i++) q[i] = p[n - 1 - i];
    soup_add(out, q, n, part);
}

static void twice(dice *d, const v3 *p, uint32_t n, uint32_t part, soup *out) {
    keep(d, p, n, part, out);
    reverse(d, p, n, part, out);
}

static void reverse_some(dice *d, const v3 *p, uint32_t n, uint32_t part, soup *out) {
    (some(d) ? reverse : keep)(d, p, n, part, out);
}

static void twice_some(dice *d, const v3 *p, uint32_t n, uint32_t part, soup *out) {
    (some(d) ? twice : keep)(d, p, n, part, out);
}

/* From a point of one edge to a point of another; neighbours get no corner there. */
static void cut(dice *d, const v3 *p, uint32_t n, uint32_t part, soup *out) {
    v3 side[2][TWIN_CORNERS];
    uint32_t count[2] = {0};
    if (!some(d)) {
        keep(d, p, n, part, out);
        return;
    }
    const uint32_t i = dice_below(d, n - 1), j = i + 1 + dice_below(d, n - 1 - i);
    const v3 from = v3_mix(p[i], p[(i + 1) % n], (1 + dice_below(d, 7)) / 8.0);
    const v3 to = v3_mix(p[j], p[(j + 1) % n], (1 + dice_below(d, 7)) / 8.0);
    for (uint32_t k = 0; k < n; k++) {
        const int s = k > i && k <= j;
        side[s][count[s]++] = p[k];
        if (k == i) {
            side[0][count[0]++] = from, side[0][count[0]++] = to;
            side[1][count[1]++] = from;
        }
        if (k == j) side[1][count[1]++] = to;
    }
    for (int s = 0; s < 2; s++) soup_add(out, side[s], count[s], part);
}

static void add_collinear(dice *d, const v3 *p, uint32_t n, uint32_t part, soup *out) {
    v3 q[TWIN_CORNERS];
    uint32_t count = 0;
    for (uint32_t i = 0; i < n; i++) {
        q[count++] = p[i];
        if (some(d)) q[count++] = v3_mix(p[i], p[(i + 1) % n], 0.5);
    }
    soup_add(out, q, count, part);
}

/* Has a triangle no area, being of corners on one line? */
static bool straight(const v3 *t) {
    const v3 a = v3_sub(t[1], t[0]), b = v3_sub(t[2], t[0]);
    return v3_len(v3_cross(a, b)) < 1e-9 * (v3_dot(a, a) + v3_dot(b, b));
}

static void fan(dice *d, const v3 *p, uint32_t n, uint32_t part, soup *out) {
    const uint32_t first = dice_below(d, n);
    for (uint32_t i = 1; i + 1 < n; i++) {
        const v3 t[] = {p[first], p[(first + i) % n], p[(first + i + 1) % n]};
        if (!straight(t)) soup_add(out, t, 3, part);
    }
}

static void star(dice *d, const v3 *p, uint32_t n, uint32_t part, soup *out) {
    v3 inside = {0, 0, 0};
    double weights = 0;
    for (uint32_t i = 0; i < n; i++) {
        const double weight = dice_between(d, 0.2, 1);
        inside = v3_add(inside, v3_mul(p[i], weight));
        weights += weight;
    }
    inside = v3_mul(inside, 1 / weights);
    for (uint32_t i = 0; i < n; i++) {
        const v3 t[] = {inside, p[i], p[(i + 1) % n]};
        soup_add(out, t, 3, part);
    }
}

static void run_step(dice *d, step *what, soup *s) {
    soup out = {0};
    for (size_t i = 0; i < s->polygon_count; i++) {
        const soup_polygon *const polygon = &s->polygons[i];
        what(d, s->points + polygon->first, polygon->count, polygon->part, &out);
    }
    soup_free(s);
    *s = out;
}

/* Polygons, without regard to their parts, in another order and from another corner on. */
static void shuffle(dice *d, soup *s) {
    soup out = {0};
    for (size_t i = s->polygon_count; i > 0; i--) {
        const uint32_t k = dice_below(d, (uint32_t)i);
        const soup_polygon polygon = s->polygons[k];
        const uint32_t first = dice_below(d, polygon.count);
        v3 p[TWIN_CORNERS];
        for (uint32_t c = 0; c < polygon.count; c++)
            p[c] = s->points[polygon.first + (first + c) % polygon.count];
        soup_add(&out, p, polygon.count, polygon.part);
        s->polygons[k] = s->polygons[i - 1];
    }
    soup_free(s);
    *s = out;
}

void twin_make(const scene *s, uint64_t seed, const twin_kind *kind, soup *out) {
    static const struct {
        unsigned bit;
        step *what;
    } steps[] = {
        {TWIN_CUT, cut},
        {TWIN_COLLINEAR, add_collinear},
        {TWIN_FAN, fan},
        {TWIN_STAR, star},
        {TWIN_DOUBLE_ALL, twice},
        {TWIN_DOUBLE_SOME, twice_some},
        {TWIN_REVERSE_ALL, reverse},
        {TWIN_REVERSE_SOME, reverse_some},
    };
    dice d = {seed * UINT64_C(0x2545F4914F6CDD1D) + kind->steps};
    for (size_t i = 0; i < s->soup.polygon_count; i++) {
        const soup_polygon *const polygon = &s->soup.polygons[i];
        if (2 * polygon->count > TWIN_CORNERS) abort();
        soup_add(out, s->soup.points + polygon->first, polygon->count, polygon->part);
    }
    for (size_t i = 0; i < sizeof steps / sizeof *steps; i++)
        if (kind->steps & steps[i].bit) run_step(&d, steps[i].what, out);
    if (kind->steps & TWIN_SHUFFLE) shuffle(&d, out);
}
