/* Random scenes: a first part or a ground plate, then two to seven parts more, each placed by one of
 * those before it: standing on it, flush with it, along its edge, crossing it, nested in it, apart.
 * A third of the scenes is straight, a third turned about z, a third anyhow, so that parts touch
 * only up to rounding. */
#include "scene.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef enum shape { BOX, PLATE, TRAY, SHEET, WEDGE, PRISM } shape;
typedef enum relation { STAND, FLUSH, EDGE, CROSS, NEST, APART, FIRST } relation;
static const char *const shape_names[] = {"box", "plate", "tray", "sheet", "wedge", "prism"};
static const char *const relation_names[] = {"stand", "flush", "edge", "cross",
                                             "nest",  "apart", "first"};

enum { PARTS = 9, RING = 8 };
static const double pi = 3.14159265358979323846;

typedef struct block {
    double low[3], high[3];
} block;

typedef struct builder {
    soup *out;
    dice dice;
    block blocks[PARTS];
    shape shapes[PARTS];
    uint32_t count;
    char *about;
    size_t about_room;
} builder;

/* A multiple of 1/8 in [least, most]. */
static double eighths(dice *d, double least, double most) {
    const int from = (int)(8 * least), to = (int)(8 * most);
    return to <= from ? least : (from + (int)dice_below(d, (uint32_t)(to - from + 1))) / 8.0;
}

/* ------- parts, wound outwards ------- */

/* Axes in cyclic order: (u, v) spans the ring, seen counter-clockwise from +w. */
static v3 on_axes(double u, double v, double w, int axis) {
    return axis == 2 ? (v3){u, v, w} : axis == 1 ? (v3){v, w, u} : (v3){w, u, v};
}

/* A prism over a ring, from `low` to `high` along an axis; open at its high end without a lid. */
static void extrude(builder *b, double (*ring)[2], uint32_t n, double low, double high, int axis,
                    bool lid) {
    v3 bottom[RING] = {{0}}, top[RING] = {{0}};
    for (uint32_t i = 0; i < n; i++) {
        bottom[n - 1 - i] = on_axes(ring[i][0], ring[i][1], low, axis);
        top[i] = on_axes(ring[i][0], ring[i][1], high, axis);
    }
    soup_add(b->out, bottom, n, b->count);
    if (lid) soup_add(b->out, top, n, b->count);
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t j = (i + 1) % n;
        const v3 side[] = {bottom[n - 1 - i], bottom[n - 1 - j], top[j], top[i]};
        soup_add(b->out, side, 4, b->count);
    }
}

static void add_box(builder *b, const block *k, bool lid) {
    double ring[][2] = {{k->low[0], k->low[1]},
                        {k->high[0], k->low[1]},
                        {k->high[0], k->high[1]},
                        {k->low[0], k->high[1]}};
    extrude(b, ring, 4, k->low[2], k->high[2], 2, lid);
}

/* A triangle in z and x, along y: a ramp either way, or one that stands on an edge. */
static void add_wedge(builder *b, const block *k) {
    const double middle = (k->low[0] + k->high[0]) / 2;
    const uint32_t which = dice_below(&b->dice, 3);
    double ring[][2] = {{k->low[2], which == 2 ? middle : k->low[0]},
                        {k->high[2], which == 1 ? k->high[0] : k->low[0]},
                        {which == 2 ? k->high[2] : k->low[2], k->high[0]}};
    extrude(b, ring, 3, k->low[1], k->high[1], 1, true);
}

static void add_prism(builder *b, const block *k) {
    static const uint32_t sides[] = {3, 5, 6, 7, 8};
    const uint32_t n = sides[dice_below(&b->dice, 5)];
    const double turn = dice_between(&b->dice, 0, 2 * pi);
    const double w = k->high[0] - k->low[0], d = k->high[1] - k->low[1], r = fmin(w, d) / 2;
    double ring[RING][2];
    for (uint32_t i = 0; i < n; i++) {
        ring[i][0] = k->low[0] + w / 2 + r * cos(turn + 2 * pi * i / n);
        ring[i][1] = k->low[1] + d / 2 + r * sin(turn + 2 * pi * i / n);
    }
    extrude(b, ring, n, k->low[2], k->high[2], 2, true);
}

/* Upright, from corner to corner or along a side; or lying. */
static void add_sheet(builder *b, const block *k) {
    const uint32_t which = dice_below(&b->dice, 4);
    const double y1 = which == 2 ? k->low[1] : k->high[1];
    const v3 upright[] = {{k->low[0], k->low[1], k->low[2]},
                          {k->high[0], y1, k->low[2]},
                          {k->high[0], y1, k->high[2]},
                          {k->low[0], k->low[1], k->high[2]}};
    const v3 lying[] = {{k->low[0], k->low[1], k->high[2]},
                        {k->high[0], k->low[1], k->high[2]},
                        {k->high[0], k->high[1], k->high[2]},
                        {k->low[0], k->high[1], k->high[2]}};
    soup_add(b->out, which == 3 ? lying : upright, 4, b->count);
}

static void turn_points(v3 *p, size_t count, double angle, int axis, v3 about) {
    const double c = cos(angle), s = sin(angle);
    for (size_t i = 0; i < count; i++) {
        const v3 q = v3_sub(p[i], about);
        const double u = v3_axis(q, (axis + 1) % 3), v = v3_axis(q, (axis + 2) % 3);
        p[i] = v3_add(about, on_axes(c * u - s * v, s * u + c * v, v3_axis(q, axis), axis));
    }
}

static void add_part(builder *b, shape kind, const block *k, relation how, double angle) {
    const size_t before = b->out->point_count;
    switch (kind) {
    case BOX:
    case PLATE:
        add_box(b, k, true);
        break;
    case TRAY:
        add_box(b, k, false);
        break;
    case SHEET:
        add_sheet(b, k);
        break;
    case WEDGE:
        add_wedge(b, k);
        break;
    case PRISM:
        add_prism(b, k);
        break;
    }
    const v3 middle = {(k->low[0] + k->high[0]) / 2, (k->low[1] + k->high[1]) / 2,
                       (k->low[2] + k->high[2]) / 2};
    if (angle != 0)
        turn_points(b->out->points + before, b->out->point_count - before, angle, 2, middle);
    b->blocks[b->count] = *k;
    b->shapes[b->count++] = kind;
    const size_t used = strlen(b->about);
    snprintf(b->about + used, b->about_room - used, "%s:%s, ", shape_names[kind],
             relation_names[how]);
}

/* ------- how a part is placed by an earlier one ------- */

/* On the host's top; in a tray on its floor. `low` and `size` are the new part's. */
static void place_on(builder *b, uint32_t host, double *low, double *size) {
    if (b->shapes[host] == WEDGE || b->shapes[host] == SHEET) host = 0; /* those have no top */
    const block *const h = &b->blocks[host];
    if (b->shapes[host] == TRAY) {
        for (int k = 0; k < 2; k++) {
            low[k] = h->low[k] + 0.125;
            size[k] = fmax(0.25, (h->high[k] - h->low[k]) / 2);
        }
        low[2] = h->low[2];
        return;
    }
    for (int k = 0; k < 2; k++)
        low[k] = b->shapes[host] == PRISM
                     ? (h->low[k] + h->high[k] - size[k]) / 2
                     : eighths(&b->dice, h->low[k], fmax(h->low[k], h->high[k] - size[k]));
    low[2] = h->high[2];
}

static void place_within(const block *h, double *low, double *size) {
    for (int k = 0; k < 3; k++) {
        const double gap = k < 2 ? 0.125 : 0.0625;
        low[k] = h->low[k] + gap;
        size[k] = fmax(gap, h->high[k] - h->low[k] - 2 * gap);
    }
}

static double place(builder *b, relation how, double *low, double *size) {
    dice *const d = &b->dice;
    const uint32_t host = dice_below(d, b->count);
    const block *const h = &b->blocks[host];
    double angle = 0, right = 0;
    switch (how) {
    case STAND:
        place_on(b, host, low, size);
        break;
    case FLUSH:
        low[0] = h->high[0], low[1] = h->low[1], low[2] = h->low[2];
        if (dice_chance(d, 0.5)) size[2] = h->high[2] - h->low[2];
        break;
    case EDGE:
        low[0] = h->high[0], low[1] = eighths(d, h->low[1], h->high[1]), low[2] = h->high[2];
        break;
    case CROSS:
        for (int k = 0; k < 3; k++) low[k] = dice_between(d, h->low[k], h->high[k]) - size[k] / 2;
        angle = dice_between(d, 0, 3);
        break;
    case NEST:
        place_within(h, low, size);
        break;
    case APART:
    case FIRST:
        for (uint32_t i = 0; i < b->count; i++) right = fmax(right, b->blocks[i].high[0]);
        low[0] = right + 0.25, low[1] = eighths(d, -1, 1), low[2] = 0;
        break;
    }
    return angle;
}

static void add_first(builder *b) {
    static const shape firsts[] = {BOX, TRAY, PRISM};
    dice *const d = &b->dice;
    if (dice_chance(d, 0.5)) {
        add_part(b, PLATE, &(block){{-3, -3, -0.25}, {3, 3, 0}}, FIRST, 0);
        return;
    }
    block k = {{-1, -1, 0}, {0, 0, 0}};
    for (int i = 0; i < 3; i++) k.high[i] = eighths(d, 0.5, 2);
    add_part(b, firsts[dice_below(d, 3)], &k, FIRST, 0);
}

static void add_another(builder *b) {
    static const shape shapes[] = {BOX, BOX, BOX, PRISM, WEDGE, TRAY, PLATE, SHEET};
    static const relation relations[] = {STAND, STAND, FLUSH, EDGE, CROSS, NEST, APART};
    dice *const d = &b->dice;
    const shape kind = shapes[dice_below(d, sizeof shapes / sizeof *shapes)];
    const relation how = relations[dice_below(d, sizeof relations / sizeof *relations)];
    double size[3], low[3] = {0};
    for (int i = 0; i < 3; i++) size[i] = eighths(d, 0.5, 1.75);
    if (kind == PLATE) size[2] = 0.125;
    const double angle = place(b, how, low, size);
    block k;
    for (int i = 0; i < 3; i++) k.low[i] = low[i], k.high[i] = low[i] + size[i];
    add_part(b, kind, &k, how, angle);
}

/* ------- the whole ------- */

static void turn_scene(builder *b) {
    const v3 origin = {0, 0, 0};
    const uint32_t how = dice_below(&b->dice, 3);
    soup *const s = b->out;
    if (how > 0)
        turn_points(s->points, s->point_count, dice_between(&b->dice, 0, 2 * pi), 2, origin);
    if (how > 1) turn_points(s->points, s->point_count, 0.4, 0, origin);
    if (how > 1) turn_points(s->points, s->point_count, 0.25, 1, origin);
    const size_t used = strlen(b->about);
    snprintf(b->about + used, b->about_room - used, "%s",
             how == 0   ? "straight"
             : how == 1 ? "about z"
                        : "anyhow");
}

/* A quarter of the scenes is seen without perspective. */
static void look_at(scene *out, dice *d) {
    v3 low = out->soup.points[0], high = low;
    for (size_t i = 1; i < out->soup.point_count; i++) {
        low = v3_min(low, out->soup.points[i]);
        high = v3_max(high, out->soup.points[i]);
    }
    const double azimuth = dice_between(d, 0, 2 * pi), elevation = dice_between(d, 0.31, 0.87);
    const v3 direction = {cos(azimuth) * cos(elevation), sin(azimuth) * cos(elevation),
                          sin(elevation)};
    out->fov_y = 35;
    out->radius = v3_len(v3_sub(high, low)) / 2;
    out->target = v3_mix(low, high, 0.5);
    out->up = (v3){0, 0, 1};
    const double distance = out->radius / sin(out->fov_y * pi / 360);
    out->eye = v3_add(out->target, v3_mul(direction, distance));
    out->height = dice_chance(d, 0.25) ? 2 * out->radius : 0;
}

void scene_make(uint64_t seed, scene *out) {
    *out = (scene){0};
    builder b = {.out = &out->soup, .about = out->about, .about_room = sizeof out->about};
    b.dice.state = seed * UINT64_C(0xD1342543DE82EF95) + 1;
    add_first(&b);
    for (uint32_t left = 2 + dice_below(&b.dice, 6); left > 0; left--) add_another(&b);
    turn_scene(&b);
    look_at(out, &b.dice);
}

void scene_free(scene *s) { soup_free(&s->soup); }

dp_camera scene_camera(const scene *s, const soup_place *place, double aspect) {
    dp_camera camera = {{0}, {0}};
    const v3 eye = v3_add(v3_mul(s->eye, place->scale), place->offset);
    const v3 target = v3_add(v3_mul(s->target, place->scale), place->offset);
    const double distance = v3_len(v3_sub(eye, target)), reach = 1.01 * s->radius * place->scale;
    if (dp_camera_look_at(&camera, (double[]){eye.x, eye.y, eye.z},
                          (double[]){target.x, target.y, target.z},
                          (double[]){s->up.x, s->up.y, s->up.z}) != DP_OK)
        abort();
    if (s->height > 0)
        dp_camera_orthographic(&camera, s->height * place->scale, aspect, distance - reach,
                               distance + reach);
    else
        dp_camera_perspective(&camera, s->fov_y, aspect, distance - reach, distance + reach);
    return camera;
}
