/* Models to be deformed: a flag on its pole, and a torso. Front is +z. */
#include "mesh/models.h"

#include "base/vec.h"

/* ---- flag: a cloth of 3 by 2 in a round pole along y ---- */

static const double POLE = 0.035, FLY = 3, HOIST = 2;   /* radius; the cloth's sides */
static const double POLE_LOW = -0.55, POLE_HIGH = 2.08; /* the cloth's low edge is y = 0 */

static void cloth_point(const dp_model *model, const dp_sheet *sheet, uint32_t i, uint32_t j,
                        double p[3]) {
    (void)model;
    p[0] = FLY * i / sheet->nu;
    p[1] = HOIST * j / sheet->nv;
    p[2] = 0;
}

/* A point (x, z) of the disc of radius 1, turned by half a cell, so that the cloth goes through the
 * middle of the pole's faces. */
static void pole_point(const dp_model *model, int top, double x, double z, double p[3]) {
    double c, s;
    dp_turn(1, 8 * model->n[0], &c, &s);
    p[0] = POLE * (x * c - z * s);
    p[1] = top ? POLE_HIGH : POLE_LOW;
    p[2] = -(POLE * (x * s + z * c));
}

static void pole_curve(const dp_model *model, int top, uint32_t i, double p[3]) {
    double x, z;
    dp_turn(i, 4 * model->n[0], &x, &z);
    pole_point(model, top, x, z, p);
}

static void pole_end_point(const dp_model *model, const dp_sheet *sheet, uint32_t i, uint32_t j,
                           double p[3]) {
    double x, z;
    dp_disc(i, j, sheet->nu, &x, &z);
    pole_point(model, sheet->from, x, z, p);
}

/* The two ends of something that goes round in 4 n cells. */
static void add_ends(dp_model *model, uint32_t n,
                     void (*point)(const dp_model *model, const dp_sheet *sheet, uint32_t i,
                                   uint32_t j, double p[3])) {
    for (int top = 0; top < 2; top++) {
        dp_sheet *const end = dp_model_add(model, n, n);
        end->point = point;
        end->from = top;
        end->reversed = !top;
    }
}

void dp_build_flag(dp_model *model) {
    const uint32_t n = model->fine, around = n / 16 + 2;
    model->n[0] = around;
    dp_model_add(model, 3 * n, 2 * n)->point = cloth_point;
    dp_model_loft(model, pole_curve, 0, 1, 4 * around, n);
    add_ends(model, around, pole_end_point);
    model->extent = FLY + POLE;
    model->centre[0] = (FLY - POLE) / 2;
    model->centre[1] = (POLE_LOW + POLE_HIGH) / 2;
}

/* ---- torso: ellipses along y, m, from hip to neck ---- */

/* Height, half width, half depth, and how far the middle lies to the front. */
static const double rings[][4] = {
    {0.000, 0.158, 0.110, 0.000},  {0.080, 0.170, 0.120, 0.000},  {0.160, 0.160, 0.112, 0.004},
    {0.240, 0.143, 0.101, 0.010},  {0.320, 0.143, 0.102, 0.013},  {0.400, 0.156, 0.113, 0.013},
    {0.480, 0.173, 0.120, 0.008},  {0.553, 0.180, 0.108, -0.002}, {0.608, 0.146, 0.084, -0.008},
    {0.642, 0.089, 0.067, -0.008}, {0.690, 0.060, 0.058, -0.002}, {0.755, 0.057, 0.056, 0.004},
};
enum { RINGS = sizeof rings / sizeof *rings };

/* Through the rings, t from 0 to 1 (Catmull and Rom 1974); at both ends exactly theirs. */
static void ring_at(double t, double ring[4]) {
    const double at = t * (RINGS - 1);
    const int k = at < RINGS - 2 ? (int)at : RINGS - 2;
    const double u = at - k;
    const double *const a = rings[k ? k - 1 : 0], *const b = rings[k], *const c = rings[k + 1],
                        *const d = rings[k + 2 < RINGS ? k + 2 : RINGS - 1];
    for (int i = 0; i < 4; i++) {
        const double from = (c[i] - a[i]) / 2, to = (d[i] - b[i]) / 2, step = c[i] - b[i];
        ring[i] = b[i] + u * (from + u * (3 * step - 2 * from - to + u * (from + to - 2 * step)));
    }
    if (u == 1) ring[0] = c[0], ring[1] = c[1], ring[2] = c[2], ring[3] = c[3];
}

/* A smooth hill of height 1 and radius 1. */
static double hill(double x, double y) {
    const double falls = dp_max(1 - x * x - y * y, 0);
    return falls * falls;
}

static void torso_point(const dp_model *model, const dp_sheet *sheet, uint32_t i, uint32_t j,
                        double p[3]) {
    double ring[4], c, s;
    (void)model;
    ring_at((double)j / sheet->nv, ring);
    dp_turn(i, sheet->nu, &c, &s);
    const double y = ring[0], corners = 2 * c * s;
    const double broad = 1 + 0.1 * corners * corners * hill((y - 0.35) / 0.34, 0);
    p[0] = ring[1] * c * broad;
    p[1] = y;
    p[2] = ring[3] - ring[2] * s * broad;
    if (s < 0) /* the front */
        p[2] += 0.034 * (hill((p[0] - 0.083) / 0.092, (y - 0.45) / 0.088) +
                         hill((p[0] + 0.083) / 0.092, (y - 0.45) / 0.088));
}

static void torso_end_point(const dp_model *model, const dp_sheet *sheet, uint32_t i, uint32_t j,
                            double p[3]) {
    const double *const ring = rings[sheet->from ? RINGS - 1 : 0];
    (void)model;
    dp_disc(i, j, sheet->nu, &p[0], &p[2]);
    p[0] *= ring[1];
    p[1] = ring[0];
    p[2] = ring[3] - ring[2] * p[2];
}

void dp_build_torso(dp_model *model) {
    const uint32_t n = model->fine + 1;
    dp_model_add(model, 4 * n, 5 * n)->point = torso_point;
    add_ends(model, n, torso_end_point);
    model->extent = rings[RINGS - 1][0];
    model->centre[1] = model->extent / 2;
}
