/* Models of plane faces: cube, tetrahedron, two crossing boxes, stairs. Finer models have more
 * triangles in the same planes. Sides are divided evenly, so that neighbours share every point. */
#include "mesh/models.h"

#include "base/elementary.h"

#include <math.h>
#include <string.h>

/* ---- boxes ---- */

/* A box's corner `bits` (1: +x, 2: +y, 4: +z), turned by `turn` (columns are its axes). */
static void box_corner(const double half[3], const double turn[3][3], unsigned bits, double p[3]) {
    for (int c = 0; c < 3; c++) {
        p[c] = 0;
        for (int k = 0; k < 3; k++) p[c] += (bits >> k & 1 ? half[k] : -half[k]) * turn[k][c];
    }
}

/* Each side's corners, counter-clockwise from outside. */
static const unsigned sides[6][4] = {{1, 3, 7, 5}, {0, 4, 6, 2}, {2, 6, 7, 3},
                                     {0, 1, 5, 4}, {4, 5, 7, 6}, {0, 2, 3, 1}};

/* cells[k]: along axis k. */
static void add_box(dp_model *model, const double half[3], const double turn[3][3],
                    const uint32_t cells[3]) {
    for (int s = 0; s < 6; s++) {
        double corners[4][3];
        for (int c = 0; c < 4; c++) box_corner(half, turn, sides[s][c], corners[c]);
        uint32_t n[2];
        for (int k = 0; k < 2; k++) { /* the axis along which the side's first two edges run */
            const unsigned axis = sides[s][k] ^ sides[s][k + 1];
            n[k] = cells[axis / 2];
        }
        dp_model_quad(model, corners, n[0], n[1]);
    }
}

static const double upright[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

void dp_build_cube(dp_model *model) {
    const double half[3] = {1, 1, 1};
    const uint32_t n = model->fine;
    add_box(model, half, upright, (uint32_t[3]){n, n, n});
    model->extent = 2;
}

/* A bar through a block, both turned so that no two faces are parallel. */
void dp_build_boxes(dp_model *model) {
    const double block[3] = {0.5, 0.62, 0.55}, bar[3] = {1, 0.27, 0.3};
    const double c = dp_cos(0.35), s = dp_sin(0.35), d = dp_cos(0.25), t = dp_sin(0.25);
    const double turn[3][3] = {{c * d, s, -c * t}, {-s * d, c, s * t}, {t, 0, d}};
    const uint32_t n = model->fine;
    add_box(model, block, upright, (uint32_t[3]){n, n, n});
    add_box(model, bar, turn, (uint32_t[3]){2 * n, n, n});
    for (int k = 0; k < 3; k++) { /* the bar sticks out along x */
        const double reach =
            fabs(bar[0] * turn[0][k]) + fabs(bar[1] * turn[1][k]) + fabs(bar[2] * turn[2][k]);
        model->extent = fmax(model->extent, 2 * reach);
    }
}

/* ---- tetrahedron ---- */

void dp_build_tetrahedron(dp_model *model) {
    static const double corner[4][3] = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
    static const int faces[4][3] = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
    for (int f = 0; f < 4; f++) {
        double corners[3][3];
        for (int c = 0; c < 3; c++) memcpy(corners[c], corner[faces[f][c]], sizeof corners[c]);
        dp_model_triangle(model, corners, model->fine);
    }
    model->extent = 2;
}

/* ---- stairs ---- */

/* Steps rise away from the viewer (towards -z). Points lie on a lattice of unit step / fine, so
 * that the long sides and the short steps share every point. */
enum { STEPS = 10, STEP_RISE = 17, STEP_RUN = 27, STEP_WIDTH = 200 }; /* cm, rule-of-thumb stairs */

enum stair_part { TREAD, RISER, LEFT, RIGHT, BACK, BOTTOM };

/* Lattice coordinates: x along the width, y up, z in steps from the front. */
static void stair_lattice(const dp_sheet *sheet, uint32_t fine, uint32_t i, uint32_t j,
                          uint32_t at[3]) {
    const uint32_t step = (uint32_t)sheet->to, wide = sheet->nu, deep = STEPS * fine;
    switch ((enum stair_part)sheet->from) {
    case TREAD:
        at[0] = i, at[1] = (step + 1) * fine, at[2] = step * fine + j;
        break;
    case RISER:
        at[0] = i, at[1] = step * fine + j, at[2] = step * fine;
        break;
    case LEFT:
        at[0] = 0, at[1] = j, at[2] = (step + 1) * fine - i;
        break;
    case RIGHT:
        at[0] = 4 * fine, at[1] = j, at[2] = step * fine + i;
        break;
    case BACK:
        at[0] = wide - i, at[1] = j, at[2] = deep;
        break;
    case BOTTOM:
        at[0] = i, at[1] = 0, at[2] = deep - j;
        break;
    }
}

static void stair_point(const dp_model *model, const dp_sheet *sheet, uint32_t i, uint32_t j,
                        double p[3]) {
    uint32_t at[3] = {0};
    stair_lattice(sheet, model->fine, i, j, at);
    p[0] = (double)at[0] * STEP_WIDTH / (4 * model->fine);
    p[1] = (double)at[1] * STEP_RISE / model->fine;
    p[2] = -((double)at[2] * STEP_RUN / model->fine);
}

static void stair_sheet(dp_model *model, enum stair_part part, uint32_t step, uint32_t nu,
                        uint32_t nv) {
    dp_sheet *const sheet = dp_model_add(model, nu, nv);
    sheet->point = stair_point;
    sheet->from = (int)part;
    sheet->to = (int)step;
}

void dp_build_stairs(dp_model *model) {
    const uint32_t n = model->fine;
    for (uint32_t step = 0; step < STEPS; step++) {
        stair_sheet(model, TREAD, step, 4 * n, n);
        stair_sheet(model, RISER, step, 4 * n, n);
        stair_sheet(model, LEFT, step, n, (step + 1) * n);
        stair_sheet(model, RIGHT, step, n, (step + 1) * n);
    }
    stair_sheet(model, BACK, 0, 4 * n, STEPS * n);
    stair_sheet(model, BOTTOM, 0, 4 * n, STEPS * n);
    model->extent = STEPS * STEP_RUN;
    model->centre[0] = STEP_WIDTH / 2.0;
    model->centre[1] = STEPS * STEP_RISE / 2.0;
    model->centre[2] = -STEPS * STEP_RUN / 2.0;
}
