/* Lambert's law, and Phong's highlight for all who want one. */
#include "shade/shade.h"

void dp_shade_lambert(const dp_shading_setup *setup, dp_shade_run *run) {
    const float lx = setup->shade.light[0], ly = setup->shade.light[1], lz = setup->shade.light[2];
    for (uint32_t i = 0; i < run->n; i++) {
        const float n_l = run->nx[i] * lx + run->ny[i] * ly + run->nz[i] * lz;
        const float lit = 0.3f + 0.7f * dp_maxf(n_l, 0);
        run->color[0][i] *= lit, run->color[1][i] *= lit, run->color[2][i] *= lit;
    }
    dp_shade_highlight(setup, run);
}

void dp_shade_highlight(const dp_shading_setup *setup, dp_shade_run *run) {
    const float strength = setup->shade.highlight;
    const float lx = setup->shade.light[0], ly = setup->shade.light[1], lz = setup->shade.light[2];
    const dp_gbuffer *const g = setup->g;
    const float on = g->perspective, vy = on * -((g->cy - ((float)run->y + 0.5f)) / g->fy);
    if (!(strength > 0)) return;
    for (uint32_t i = 0; i < run->n; i++) {
        const float vx = on * -(((float)(int32_t)(run->x + i) + 0.5f - g->cx) / g->fx);
        const float n_l = run->nx[i] * lx + run->ny[i] * ly + run->nz[i] * lz;
        const float rx = 2 * n_l * run->nx[i] - lx, ry = 2 * n_l * run->ny[i] - ly, rz = 2 * n_l * run->nz[i] - lz;
        const float c = (rx * vx + ry * vy + rz) / sqrtf(vx * vx + vy * vy + 1);
        const float c1 = n_l > 0 ? dp_maxf(c, 0) : 0, c2 = c1 * c1, c4 = c2 * c2, c8 = c4 * c4, c16 = c8 * c8;
        const float s = strength * (c16 * c16 * c16 * c2); /* to the 50th */
        for (int k = 0; k < 3; k++) run->color[k][i] += (1 - run->color[k][i]) * dp_minf(s, 1);
    }
}
