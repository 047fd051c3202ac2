/* A spur gear, axis z: hub with bore, thin web with six holes, rim, involute teeth.
 *
 * The outline's angles about the axis always grow, so every ring of points uses them and the cells
 * between rings never fold. A sixth of the web is a patch between its edge, divided as its
 * neighbours are, and the circle of a hole.
 *
 * Lengths are in units of the outer radius. Teeth follow the usual proportions: pressure angle 20
 * degrees, addendum one module, dedendum 1.25 modules. */
#include "mesh/models.h"

#include "base/elementary.h"

#include <math.h>

enum { TEETH = 24, SECTORS = 6 };

static const double TURN = 6.283185307179586;
static const double MODULE = 2.0 / (TEETH + 2);
static const double HOLE_AT = 0.51, HOLE_RADIUS = 0.125; /* centre from the axis */

/* What the counts in dp_model.n mean. */
enum { FLANK, TIP, ROOT, PER_TOOTH, AROUND, RADIAL };

/* ---- the outline ---- */

static double involute(double r, double base) {
    return sqrt(r * r / (base * base) - 1) - dp_acos(base / r);
}

/* Half the angle of a tooth at radius r. Below the base circle the flank widens into a fillet. A
 * slight slope keeps angles growing where the involute is radial. */
static double half_tooth(double r) {
    const double pitch = MODULE * TEETH / 2, base = pitch * dp_cos(TURN / 18),
                 root = pitch - 1.25 * MODULE;
    const double at_base = TURN / (4 * TEETH) + involute(pitch, base);
    const double slope = 0.06 * (1 - r);
    if (r >= base) return at_base - involute(r, base) + slope;
    const double u = (base - r) / (base - root);
    return at_base + 0.35 * (TURN / (2 * TEETH) - at_base) * u * u + slope;
}

/* Angle and radius of point k of the outline: up a flank, along the tip, down, along the root. */
static void outline(const dp_model *model, uint32_t k, double *angle, double *radius) {
    const uint32_t *const n = model->n;
    const double root = MODULE * (TEETH / 2.0 - 1.25);
    uint32_t e = k % n[PER_TOOTH];
    const double tooth = TURN * (k / n[PER_TOOTH] % TEETH) / TEETH;
    if (e < n[FLANK]) {
        *radius = root + (1 - root) * e / n[FLANK];
        *angle = tooth - half_tooth(*radius);
    } else if ((e -= n[FLANK]) < n[TIP]) {
        *radius = 1;
        *angle = tooth + half_tooth(1) * (2.0 * e / n[TIP] - 1);
    } else if ((e -= n[TIP]) < n[FLANK]) {
        *radius = 1 - (1 - root) * e / n[FLANK];
        *angle = tooth + half_tooth(*radius);
    } else {
        const double half_gap = TURN / (2 * TEETH) - half_tooth(root);
        *radius = root;
        *angle = tooth + half_tooth(root) + 2 * half_gap * (e - n[FLANK]) / n[ROOT];
    }
}

/* ---- rings, from the bore outwards along the front and back along the rear ---- */

static const double OUTLINE = 0; /* in place of a radius: the outline */

static const struct {
    double radius, z;
} rings[] = {{0.17, -0.30}, {0.17, 0.30},  {0.31, 0.30},    {0.31, 0.08},
             {0.70, 0.08},  {0.70, 0.19},  {OUTLINE, 0.19}, {OUTLINE, -0.19},
             {0.70, -0.19}, {0.70, -0.08}, {0.31, -0.08},   {0.31, -0.30}};
enum { RINGS = 12, WEB_FRONT = 3, WEB_REAR = 9 };

static void ring_point(const dp_model *model, int ring, uint32_t k, double p[3]) {
    double angle, radius;
    outline(model, k, &angle, &radius);
    if (rings[ring].radius > 0) radius = rings[ring].radius;
    p[0] = radius * dp_cos(angle);
    p[1] = radius * dp_sin(angle);
    p[2] = rings[ring].z;
}

/* ---- a sixth of the web ---- */

/* Codes of a sector's lines: 4 * sector + 2 * (rear) + (hole). */
enum { HOLE = 1, REAR = 2 };

/* Point i of the sector's edge: outer arc, inwards, inner arc back, outwards. */
static void sector_edge(const dp_model *model, int code, uint32_t i, double p[3]) {
    const uint32_t arc = model->n[AROUND] / SECTORS, radial = model->n[RADIAL];
    const uint32_t first = (uint32_t)code / 4 * arc;
    const int inner = code & REAR ? WEB_REAR + 1 : WEB_FRONT;
    const int outer = code & REAR ? WEB_REAR : WEB_FRONT + 1;
    i %= 2 * (arc + radial);
    if (i < arc) {
        ring_point(model, outer, first + i, p);
        return;
    }
    i -= arc;
    if (i >= radial && i < radial + arc) {
        ring_point(model, inner, first + arc - (i - radial), p);
        return;
    }
    double a[3], b[3]; /* always from the inside, so that both neighbours get the same points */
    const uint32_t side = i < radial ? first + arc : first;
    const uint32_t from_inside = i < radial ? radial - i : i - radial - arc;
    ring_point(model, inner, side, a);
    ring_point(model, outer, side, b);
    dp_between_points(a, b, from_inside, radial, p);
}

static void sector_curve(const dp_model *model, int code, uint32_t i, double p[3]) {
    sector_edge(model, code, i, p);
    if (!(code & HOLE)) return;
    double start, unused;
    outline(model, 0, &start, &unused);
    const double angle = start + TURN * (code / 4 + 0.5) / SECTORS;
    const double x = HOLE_AT * dp_cos(angle), y = HOLE_AT * dp_sin(angle);
    const double away = sqrt((p[0] - x) * (p[0] - x) + (p[1] - y) * (p[1] - y));
    p[0] = x + HOLE_RADIUS * (p[0] - x) / away;
    p[1] = y + HOLE_RADIUS * (p[1] - y) / away;
}

/* ---- the model ---- */

/* Cells along a length, at least one. */
static uint32_t cells(const dp_model *model, double length) {
    const double n = floor(length * model->fine * 10 + 0.5);
    return n < 1 ? 1 : (uint32_t)n;
}

static void add_sector(dp_model *model, int sector) {
    const uint32_t around = 2 * (model->n[AROUND] / SECTORS + model->n[RADIAL]);
    const int front = 4 * sector, rear = front + REAR;
    const uint32_t deep = cells(model, 0.12);
    dp_model_loft(model, sector_curve, front, front + HOLE, around, deep);
    dp_model_loft(model, sector_curve, rear, rear + HOLE, around, deep)->reversed = true;
    dp_model_loft(model, sector_curve, front + HOLE, rear + HOLE, around, cells(model, 0.16));
}

void dp_build_gear(dp_model *model) {
    uint32_t *const n = model->n;
    n[FLANK] = 2 * model->fine;
    n[TIP] = n[ROOT] = model->fine;
    n[PER_TOOTH] = 2 * n[FLANK] + n[TIP] + n[ROOT];
    n[AROUND] = TEETH * n[PER_TOOTH];
    n[RADIAL] = cells(model, 0.39);
    for (int k = 0; k < RINGS; k++) {
        const int next = (k + 1) % RINGS;
        if (k == WEB_FRONT || k == WEB_REAR) continue;
        const double from = rings[k].radius > 0 ? rings[k].radius : 0.85;
        const double to = rings[next].radius > 0 ? rings[next].radius : 0.85;
        const uint32_t along = cells(model, fabs(from - to) + fabs(rings[k].z - rings[next].z));
        dp_model_loft(model, ring_point, next, k, n[AROUND], along);
    }
    for (int sector = 0; sector < SECTORS; sector++) add_sector(model, sector);
    model->extent = 2;
}
