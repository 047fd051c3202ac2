/* Cartoon shading: the cosine between normal and light looks up a row of shades, with nearest filtering (Lake
 * et al., NPAR 2000). The jaggies that this makes are smoothed afterwards (cartoon_map.c). */
#include "shade/shade.h"

void dp_shade_toon(const dp_shading_setup *setup, dp_shade_run *run) {
    const float lx = setup->shade.light[0], ly = setup->shade.light[1], lz = setup->shade.light[2];
    const float count = (float)setup->shade_count, last = count - 1;
    int32_t index[DP_TILE];
    for (uint32_t i = 0; i < run->n; i++) {
        const float n_l = run->nx[i] * lx + run->ny[i] * ly + run->nz[i] * lz;
        index[i] = (int32_t)dp_minf(dp_maxf((0.5f + 0.5f * n_l) * count, 0), last);
    }
    for (uint32_t i = 0; i < run->n; i++)
        for (int k = 0; k < 3; k++) run->color[k][i] *= (float)setup->shades[4 * index[i] + k] * (1 / 255.0f);
    dp_shade_highlight(setup, run);
}
