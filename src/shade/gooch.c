/* Cool to warm: Gooch, Gooch, Shirley, Cohen, A Non-Photorealistic Lighting Model for Automatic Technical
 * Illustration (SIGGRAPH 1998), equation 2:
 *     I = (1 + L·N)/2 k_warm + (1 - (1 + L·N)/2) k_cool,
 *     k_cool = k_blue + alpha k_d,  k_warm = k_yellow + beta k_d,
 * blue = (0, 0, b), yellow = (y, y, 0), k_d the surface's colour, or grey without it. */
#include "shade/shade.h"

void dp_shade_gooch(const dp_shading_setup *setup, dp_shade_run *run) {
    const dp_shade *const s = &setup->shade;
    const float lx = s->light[0], ly = s->light[1], lz = s->light[2];
    const float cool[3] = {0, 0, s->gooch_blue}, warm[3] = {s->gooch_yellow, s->gooch_yellow, 0};
    for (uint32_t i = 0; i < run->n; i++) {
        const float n_l = run->nx[i] * lx + run->ny[i] * ly + run->nz[i] * lz, t = 0.5f + 0.5f * n_l;
        for (int k = 0; k < 3; k++) {
            const float kd = s->gooch_plain ? 0.5f : run->color[k][i];
            const float c = cool[k] + s->gooch_alpha * kd, w = warm[k] + s->gooch_beta * kd;
            run->color[k][i] = dp_minf(dp_maxf(c + (w - c) * t, 0), 1);
        }
    }
    dp_shade_highlight(setup, run);
}
