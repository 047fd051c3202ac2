/* Round models: sphere, torus, cylinder, and a terrain of fractal noise. Points lie on the true
 * surface; the fineness sets how many there are. */
#include "mesh/models.h"

#include <math.h>
#include <string.h>

/* ---- sphere: an icosahedron's triangles, subdivided and pushed out ---- */

static void sphere_point(const dp_model *model, const dp_sheet *sheet, uint32_t i, uint32_t j,
                         double p[3]) {
    const double n = sheet->nu, u = i / n, v = j / n, w = (sheet->nu - i - j) / n;
    (void)model;
    for (int c = 0; c < 3; c++)
        p[c] = sheet->corner[0][c] * w + sheet->corner[1][c] * u + sheet->corner[2][c] * v;
    const double length = sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
    for (int c = 0; c < 3; c++) p[c] /= length;
}

/* Twelve corners: a cyclic permutation of (0, +-1, +-golden). */
static void icosahedron_corner(unsigned k, double p[3]) {
    const double golden = 1.618033988749895;
    const unsigned axis = k / 4;
    p[axis] = 0;
    p[(axis + 1) % 3] = k & 1 ? 1 : -1;
    p[(axis + 2) % 3] = k & 2 ? golden : -golden;
}

void dp_build_sphere(dp_model *model) {
    static const unsigned char faces[20][3] = {
        {0, 4, 1},   {0, 1, 6},   {0, 8, 4}, {0, 6, 9},  {0, 9, 8}, {1, 4, 10}, {1, 11, 6},
        {1, 10, 11}, {2, 3, 5},   {2, 7, 3}, {2, 5, 8},  {2, 9, 7}, {2, 8, 9},  {3, 10, 5},
        {3, 7, 11},  {3, 11, 10}, {4, 8, 5}, {4, 5, 10}, {6, 7, 9}, {6, 11, 7}};
    for (int f = 0; f < 20; f++) {
        double corners[3][3];
        for (int c = 0; c < 3; c++) icosahedron_corner(faces[f][c], corners[c]);
        dp_model_triangle(model, corners, model->fine)->point = sphere_point;
    }
    model->extent = 2;
}

/* ---- torus ---- */

static const double TUBE = 0.38; /* of the ring's radius */

static void torus_point(const dp_model *model, const dp_sheet *sheet, uint32_t i, uint32_t j,
                        double p[3]) {
    double cu, su, cv, sv;
    (void)model;
    dp_turn(i, sheet->nu, &cu, &su);
    dp_turn(j, sheet->nv, &cv, &sv);
    const double r = 1 + TUBE * cv;
    p[0] = r * cu;
    p[1] = TUBE * sv;
    p[2] = -(r * su);
}

void dp_build_torus(dp_model *model) {
    const uint32_t n = model->fine + 2; /* 2.5 times as far round the ring as round the tube */
    dp_model_add(model, (5 * n + 1) / 2, n)->point = torus_point;
    model->extent = 2 * (1 + TUBE);
}

/* ---- cylinder, along y ---- */

static const double CYLINDER_HEIGHT = 2.4; /* radii */

static void cylinder_curve(const dp_model *model, int top, uint32_t i, double p[3]) {
    dp_turn(i, 4 * model->n[0], &p[0], &p[2]);
    p[1] = top ? CYLINDER_HEIGHT / 2 : -CYLINDER_HEIGHT / 2;
    p[2] = -p[2];
}

static void cap_point(const dp_model *model, const dp_sheet *sheet, uint32_t i, uint32_t j,
                      double p[3]) {
    (void)model;
    dp_disc(i, j, sheet->nu, &p[0], &p[2]);
    p[1] = sheet->from ? CYLINDER_HEIGHT / 2 : -CYLINDER_HEIGHT / 2;
    p[2] = -p[2];
}

void dp_build_cylinder(dp_model *model) {
    const uint32_t n = model->fine + 1;
    model->n[0] = n;
    dp_model_loft(model, cylinder_curve, 0, 1, 4 * n, (3 * n + 1) / 2);
    for (int top = 0; top < 2; top++) {
        dp_sheet *const cap = dp_model_add(model, n, n);
        cap->point = cap_point;
        cap->from = top;
        cap->reversed = !top;
    }
    model->extent = CYLINDER_HEIGHT;
}

/* ---- terrain: ridged gradient noise, an open sheet ---- */

static uint32_t scramble(uint32_t x) {
    x = (x ^ x >> 16) * 0x7FEB352Du;
    x = (x ^ x >> 15) * 0x846CA68Bu;
    return x ^ x >> 16;
}

/* Gradient of the noise at a lattice point (one of 16 directions), times the offset of (x, y). */
static double slope(uint32_t seed, int32_t ix, int32_t iy, double x, double y) {
    static const double direction[8] = {1, 0.9238795325,  0.7071067812,  0.3826834324,
                                        0, -0.3826834324, -0.7071067812, -0.9238795325};
    const uint32_t hash = scramble(scramble((uint32_t)ix + seed * 0x9E3779B9u) + (uint32_t)iy);
    const double c = direction[hash & 7], s = direction[(hash + 4) & 7];
    return hash & 8 ? c * x + s * y : -(c * x + s * y);
}

static double smooth(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }

/* Perlin's gradient noise, about -0.7 … 0.7. */
static double noise(uint32_t seed, double x, double y) {
    const double fx = floor(x), fy = floor(y);
    const int32_t ix = (int32_t)fx, iy = (int32_t)fy;
    const double u = x - fx, v = y - fy, su = smooth(u), sv = smooth(v);
    const double low =
        slope(seed, ix, iy, u, v) * (1 - su) + slope(seed, ix + 1, iy, u - 1, v) * su;
    const double high = slope(seed, ix, iy + 1, u, v - 1) * (1 - su) +
                        slope(seed, ix + 1, iy + 1, u - 1, v - 1) * su;
    return low * (1 - sv) + high * sv;
}

/* Octaves of folded noise, each weighted by the one before: crests above smooth valley floors. */
static double height(uint32_t seed, double x, double y) {
    enum { OCTAVES = 7 };
    double sum = 0, amplitude = 1, frequency = 2.6, weight = 1;
    for (uint32_t k = 0; k < OCTAVES; k++) {
        const double n = noise(seed + k, (x + 7.37) * frequency, (y + 5.61) * frequency);
        const double folded = 1 - sqrt(n * n + 0.004) / 0.7; /* a crest rounded a little */
        const double crest = folded * folded * weight;
        weight = crest < 0 ? 0 : crest > 1 ? 1 : crest;
        sum += crest * amplitude;
        amplitude *= 0.42;
        frequency *= 2.03;
    }
    return sum;
}

static void terrain_point(const dp_model *model, const dp_sheet *sheet, uint32_t i, uint32_t j,
                          double p[3]) {
    const double x = (double)i / sheet->nu, y = (double)j / sheet->nv;
    p[0] = 2 * x - 1;
    p[1] = 0.3 * height(model->seed, x, y);
    p[2] = 1 - 2 * y;
}

void dp_build_terrain(dp_model *model) {
    dp_model_add(model, model->fine, model->fine)->point = terrain_point;
    model->extent = 2;
    model->centre[1] = 0.21; /* about; the box depends on the seed */
}
