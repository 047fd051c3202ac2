/* A bearing bracket: a base with two holes, an upright plate with a round top and a boss with a
 * bore, and a fillet between them. Base along z, plate along y, width along x.
 *
 * A face with a hole is a patch between its edge and a circle about the hole, whose points lie in
 * the directions of the edge's points. Lengths are sixteenths, which are exact, so that
 * neighbouring faces compute the same points. */
#include "mesh/models.h"

#include <math.h>
#include <string.h>

#define SIXTEENTHS(x) ((x) / 16.0)
static const double THICK = SIXTEENTHS(5);  /* base and plate */
static const double INNER = SIXTEENTHS(10); /* where the fillet ends: thickness + radius */
static const double FILLET = SIXTEENTHS(5);
static const double DEEP = SIXTEENTHS(30); /* the base's end along z */
static const double AXIS = SIXTEENTHS(27); /* the bore's height */
static const double BORE = SIXTEENTHS(7), BOSS = SIXTEENTHS(11);
static const double BOSS_END = SIXTEENTHS(9); /* its front along z */
static const double HOLE = 0.21;              /* of the base; a half each side of the middle */

/* Numbers of cells: half the width; the plate's straight side and half circle; the base's side;
 * half the fillet; the thickness. */
enum { WIDE, TALL, ROUND, LONG, BEND, THROUGH };

static double between(double a, double b, uint32_t k, uint32_t n) {
    return a * ((double)(n - k) / n) + b * ((double)k / n);
}

/* x of point k across the width. */
static double across(const dp_model *model, uint32_t k) {
    return between(-1, 1, k, 2 * model->n[WIDE]);
}

/* ---- lines of the base; frames go round counter-clockwise seen from above ---- */

enum base_line { FRAME = 0, RING = 1, RIGHT = 2, BELOW = 4 }; /* bits */

static uint32_t frame_points(const dp_model *model) {
    return 2 * (model->n[WIDE] + model->n[LONG]);
}

static void base_line(const dp_model *model, int line, uint32_t i, double p[3]) {
    const uint32_t w = model->n[WIDE], l = model->n[LONG], left = line & RIGHT ? w : 0;
    i %= frame_points(model);
    p[1] = line & BELOW ? 0 : THICK;
    if (i < w)
        p[0] = across(model, left + i), p[2] = DEEP;
    else if (i < w + l)
        p[0] = across(model, left + w), p[2] = between(DEEP, INNER, i - w, l);
    else if (i < 2 * w + l)
        p[0] = across(model, left + 2 * w + l - i), p[2] = INNER;
    else
        p[0] = across(model, left), p[2] = between(INNER, DEEP, i - 2 * w - l, l);
    if (!(line & RING)) return;
    const double x = line & RIGHT ? 0.5 : -0.5, z = 0.5 * (INNER + DEEP);
    const double away = sqrt((p[0] - x) * (p[0] - x) + (p[2] - z) * (p[2] - z));
    p[0] = x + HOLE * (p[0] - x) / away;
    p[2] = z + HOLE * (p[2] - z) / away;
}

/* ---- lines of the plate, counter-clockwise seen from the front ---- */

enum plate_line { PLATE_BACK, PLATE_FRONT, BOSS_BASE, BOSS_FRONT, BORE_FRONT, BORE_BACK };

static uint32_t plate_points(const dp_model *model) {
    return 2 * model->n[TALL] + model->n[ROUND] + 2 * model->n[WIDE];
}

/* The edge: up the right side, over the half circle, down the left, along the foot. */
static void plate_edge(const dp_model *model, uint32_t i, double p[3]) {
    const uint32_t tall = model->n[TALL], round = model->n[ROUND];
    i %= plate_points(model);
    if (i < tall)
        p[0] = 1, p[1] = between(INNER, AXIS, i, tall);
    else if (i <= tall + round) {
        dp_turn(i - tall, 2 * round, &p[0], &p[1]);
        p[1] = AXIS + p[1];
    } else if (i < 2 * tall + round)
        p[0] = -1, p[1] = between(AXIS, INNER, i - tall - round, tall);
    else
        p[0] = across(model, i - 2 * tall - round), p[1] = INNER;
}

static void plate_line(const dp_model *model, int line, uint32_t i, double p[3]) {
    static const double z[] = {0, THICK, THICK, BOSS_END, BOSS_END, 0};
    static const double radius[] = {0, 0, BOSS, BOSS, BORE, BORE};
    plate_edge(model, i, p);
    p[2] = z[line];
    if (radius[line] <= 0) return;
    const double away = sqrt(p[0] * p[0] + (p[1] - AXIS) * (p[1] - AXIS));
    p[0] = radius[line] * p[0] / away;
    p[1] = AXIS + radius[line] * (p[1] - AXIS) / away;
}

/* ---- lines across the width: where strips of the whole width begin and end ---- */

enum width_line { FOOT_FRONT, TOE, FOOT_INNER, HEEL, BACK_INNER };

static void width_line(const dp_model *model, int line, uint32_t i, double p[3]) {
    static const double yz[][2] = {{0, DEEP}, {THICK, DEEP}, {0, INNER}, {0, 0}, {INNER, 0}};
    p[0] = across(model, i);
    p[1] = yz[line][0];
    p[2] = yz[line][1];
}

/* ---- lines of the sides: code 2 * line + (right) ---- */

enum side_line { SIDE_LOW, SIDE_HIGH, CORNER, ARC };

static void arc_point(const dp_model *model, uint32_t k, double p[3]) {
    double c, s;
    dp_turn(k, 8 * model->n[BEND], &c, &s);
    p[1] = INNER - FILLET * c;
    p[2] = INNER - FILLET * s;
}

static void side_line(const dp_model *model, int code, uint32_t i, double p[3]) {
    const uint32_t bend = model->n[BEND];
    p[0] = code & 1 ? 1 : -1;
    p[1] = p[2] = 0;
    switch ((enum side_line)(code / 2)) {
    case SIDE_LOW:
        p[2] = between(DEEP, INNER, i, model->n[LONG]);
        break;
    case SIDE_HIGH:
        p[1] = THICK, p[2] = between(DEEP, INNER, i, model->n[LONG]);
        break;
    case CORNER:
        if (i <= bend)
            p[2] = between(INNER, 0, i, bend);
        else
            p[1] = between(0, INNER, i - bend, bend);
        break;
    case ARC:
        arc_point(model, i, p);
        break;
    }
}

static void fillet_point(const dp_model *model, const dp_sheet *sheet, uint32_t i, uint32_t j,
                         double p[3]) {
    (void)sheet;
    p[0] = across(model, i);
    arc_point(model, j, p);
}

/* ---- the model ---- */

static uint32_t cells(const dp_model *model, double length) {
    const double n = floor(length * model->fine + 0.5);
    return n < 1 ? 1 : (uint32_t)n;
}

static void add_base(dp_model *model, int side) {
    const uint32_t around = frame_points(model), in = cells(model, 0.3);
    dp_model_loft(model, base_line, side, side | RING, around, in);
    dp_model_loft(model, base_line, side | BELOW, side | RING | BELOW, around, in)->reversed = true;
    dp_model_loft(model, base_line, side | RING, side | RING | BELOW, around, model->n[THROUGH]);
}

static void add_plate(dp_model *model) {
    const uint32_t around = plate_points(model), wall = cells(model, BOSS_END - THICK);
    dp_model_loft(model, plate_line, PLATE_BACK, PLATE_FRONT, 2 * model->n[TALL] + model->n[ROUND],
                  model->n[THROUGH]);
    dp_model_loft(model, plate_line, PLATE_FRONT, BOSS_BASE, around, cells(model, 0.3));
    dp_model_loft(model, plate_line, BOSS_BASE, BOSS_FRONT, around, wall);
    dp_model_loft(model, plate_line, BOSS_FRONT, BORE_FRONT, around, cells(model, BOSS - BORE));
    dp_model_loft(model, plate_line, BORE_FRONT, BORE_BACK, around, cells(model, BOSS_END));
    dp_model_loft(model, plate_line, PLATE_BACK, BORE_BACK, around, cells(model, 0.5))->reversed =
        true;
}

static void add_strips(dp_model *model) {
    const uint32_t wide = 2 * model->n[WIDE], bend = model->n[BEND];
    dp_model_loft(model, width_line, FOOT_FRONT, TOE, wide, model->n[THROUGH]);
    dp_model_loft(model, width_line, HEEL, FOOT_INNER, wide, bend);
    dp_model_loft(model, width_line, HEEL, BACK_INNER, wide, bend)->reversed = true;
    dp_model_add(model, wide, 2 * bend)->point = fillet_point;
}

static void add_side(dp_model *model, int right) {
    const uint32_t through = model->n[THROUGH];
    dp_sheet *const wall = dp_model_loft(model, side_line, 2 * SIDE_LOW + right,
                                         2 * SIDE_HIGH + right, model->n[LONG], through);
    dp_sheet *const corner = dp_model_loft(model, side_line, 2 * CORNER + right, 2 * ARC + right,
                                           2 * model->n[BEND], through);
    wall->reversed = corner->reversed = !right;
}

void dp_build_bracket(dp_model *model) {
    uint32_t *const n = model->n;
    n[WIDE] = cells(model, 1);
    n[TALL] = cells(model, AXIS - INNER);
    n[ROUND] = cells(model, 3.2);
    n[LONG] = cells(model, DEEP - INNER);
    n[BEND] = cells(model, 0.5);
    n[THROUGH] = cells(model, THICK);
    add_base(model, 0);
    add_base(model, RIGHT);
    add_plate(model);
    add_strips(model);
    add_side(model, 0);
    add_side(model, 1);
    model->extent = AXIS + 1;
    model->centre[1] = 0.5 * (AXIS + 1);
    model->centre[2] = 0.5 * DEEP;
}
