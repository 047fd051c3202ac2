/* The paper's first variant: four diagonal samples, one pass. See detect.h; every loop here runs over plain
 * floats without branches, so that compilers make vectors of it. */
#include "gbuffer/detect.h"

#include "base/vec.h"

void dp_diagonal_normals(dp_rows nx, dp_rows ny, dp_rows nz, int radius, uint32_t n, float *restrict i_n) {
    const float *restrict const ax = nx.above - radius, *restrict const cx = nx.above + radius;
    const float *restrict const fx = nx.below - radius, *restrict const hx = nx.below + radius;
    const float *restrict const ay = ny.above - radius, *restrict const cy = ny.above + radius;
    const float *restrict const fy = ny.below - radius, *restrict const hy = ny.below + radius;
    const float *restrict const az = nz.above - radius, *restrict const cz = nz.above + radius;
    const float *restrict const fz = nz.below - radius, *restrict const hz = nz.below + radius;
    for (uint32_t i = 0; i < n; i++) {
        const float ah = ax[i] * hx[i] + ay[i] * hy[i] + az[i] * hz[i];
        const float cf = cx[i] * fx[i] + cy[i] * fy[i] + cz[i] * fz[i];
        i_n[i] = 0.5f * (ah + cf);
    }
}

/* (1 - a/2)^2 (1 - b/2)^2 */
static inline float together(float a, float b) {
    const float p = 1 - 0.5f * a, q = 1 - 0.5f * b;
    return p * p * (q * q);
}

void dp_diagonal_depth_printed(dp_rows z, const dp_depth_measure *m, int radius, uint32_t n, float *restrict i_z) {
    const float *restrict const a = z.above - radius, *restrict const c = z.above + radius;
    const float *restrict const f = z.below - radius, *restrict const h = z.below + radius;
    const float scale = m->scale;
    for (uint32_t i = 0; i < n; i++)
        i_z[i] = together(dp_minf(scale * fabsf(a[i] - h[i]), 1), dp_minf(scale * fabsf(c[i] - f[i]), 1));
}

/* What the slope does not explain of a pair's difference, as a share of a whole step, in [0, 1]; the first third of
 * it does not count: so far a fold reaches. `second` tells its side. */
static inline float unexplained(float p, float x, float q, float scale, float *second) {
    *second = p + q - 2 * x;
    const float first = dp_minf(fabsf(p - x), fabsf(q - x));
    return dp_maxf(dp_minf((fabsf(*second) - 1.75f * first) * scale * 1.5f - 0.5f, 1), 0);
}

void dp_diagonal_scaled(dp_rows nx, dp_rows ny, dp_rows nz, dp_rows d, const dp_depth_measure *m, int radius, uint32_t n,
                        float *restrict i_n, float *restrict i_z) {
    const float *restrict const a = d.above - radius, *restrict const c = d.above + radius;
    const float *restrict const f = d.below - radius, *restrict const h = d.below + radius;
    const float *restrict const x = d.at;
    const float *restrict const ax = nx.above - radius, *restrict const cx = nx.above + radius;
    const float *restrict const fx = nx.below - radius, *restrict const hx = nx.below + radius;
    const float *restrict const ay = ny.above - radius, *restrict const cy = ny.above + radius;
    const float *restrict const fy = ny.below - radius, *restrict const hy = ny.below + radius;
    const float *restrict const az = nz.above - radius, *restrict const cz = nz.above + radius;
    const float *restrict const fz = nz.below - radius, *restrict const hz = nz.below + radius;
    const float further = m->both_sides, scale = m->scale;
    const float grows = m->perspective, still = m->perspective ? 0 : 1; /* px sizes */
    for (uint32_t i = 0; i < n; i++) {
        const float per_px = scale / (grows * x[i] + still);
        float side_ah, side_cf;
        const float step_ah = unexplained(a[i], x[i], h[i], per_px, &side_ah);
        const float step_cf = unexplained(c[i], x[i], f[i], per_px, &side_cf);
        const float ah = ax[i] * hx[i] + ay[i] * hy[i] + az[i] * hz[i];
        const float cf = cx[i] * fx[i] + cy[i] * fy[i] + cz[i] * fz[i];
        i_z[i] = together(step_ah * (side_ah < 0 ? 1 : further), step_cf * (side_cf < 0 ? 1 : further));
        i_n[i] = 1 - 0.5f * ((1 - ah) * (1 - step_ah) + (1 - cf) * (1 - step_cf));
    }
}
