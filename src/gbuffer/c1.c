/* The paper's second variant: the C1-discontinuity operator of Saito and Takahashi, in the three accumulating
 * passes that four texture units allow. See detect.h. */
#include "gbuffer/detect.h"

#include "base/vec.h"

/* The samples of a pass and their weights; the second one of pass 1 counts nothing. */
typedef struct taps {
    const float *at[3];
    float weight[3];
} taps;

static taps taps_of(dp_rows z, int pass, int radius) {
    const float *const row = pass == 0 ? z.above : pass == 1 ? z.at : z.below;
    return (taps){{row - radius, row, row + radius},
                  {pass == 1 ? 0.25f : 0.125f, pass == 1 ? 0 : 0.25f, pass == 1 ? 0.25f : 0.125f}};
}

void dp_c1_printed(dp_rows z, const dp_depth_measure *m, int pass, int radius, uint32_t n, float *restrict i_z) {
    const taps t = taps_of(z, pass, radius);
    const float *restrict const p = t.at[0], *restrict const q = t.at[1], *restrict const r = t.at[2];
    const float *restrict const x = z.at;
    const float scale = m->scale, wp = t.weight[0], wq = t.weight[1], wr = t.weight[2];
    for (uint32_t i = 0; i < n; i++) {
        const float dp = dp_minf(scale * fabsf(p[i] - x[i]), 1), dq = dp_minf(scale * fabsf(q[i] - x[i]), 1);
        const float dr = dp_minf(scale * fabsf(r[i] - x[i]), 1);
        i_z[i] += wp * dp + wq * dq + wr * dr;
    }
}

static inline float beyond(float neighbour, float x, float scale, float explained, float sides) {
    const float d = x - neighbour; /* behind: positive */
    return dp_maxf(dp_minf(dp_maxf(d, -sides * d) * scale - explained, 1), 0);
}

void dp_c1_scaled(dp_rows d, const float *restrict slope, const dp_depth_measure *m, int pass, int radius, uint32_t n,
                  float *restrict i_z) {
    const taps t = taps_of(d, pass, radius);
    const float *restrict const p = t.at[0], *restrict const q = t.at[1], *restrict const r = t.at[2];
    const float *restrict const x = d.at;
    const float sides = m->both_sides, scale = m->scale, wp = t.weight[0], wq = t.weight[1], wr = t.weight[2];
    const float grows = m->perspective, still = m->perspective ? 0 : 1;
    for (uint32_t i = 0; i < n; i++) {
        const float per_px = scale / (grows * x[i] + still);
        const float explained = slope[i];
        i_z[i] += wp * beyond(p[i], x[i], per_px, explained, sides) + wq * beyond(q[i], x[i], per_px, explained, sides) +
                  wr * beyond(r[i], x[i], per_px, explained, sides);
    }
}

/* Below this cosine to the line of sight a surface's slope says nothing any more. */
static const float LEAST_COSINE = 1e-4f;

void dp_c1_slope(const dp_rays *rays, const float *restrict nx, const float *restrict ny, const float *restrict nz, uint32_t x,
                 uint32_t y, uint32_t n, float *restrict slope) {
    const float on = rays->perspective, ry = on * (rays->cy - ((float)y + 0.5f)) / rays->fy;
    for (uint32_t i = 0; i < n; i++) {
        const float rx = on * ((float)(int32_t)(x + i) + 0.5f - rays->cx) / rays->fx;
        const float along = nz[i] - nx[i] * rx - ny[i] * ry, length2 = 1 + rx * rx + ry * ry;
        const float c = dp_maxf(along / sqrtf(length2), LEAST_COSINE);
        slope[i] = sqrtf(dp_maxf(1 - c * c, 0)) / c;
    }
}
