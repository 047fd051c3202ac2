/* Hatching and halftoning: priorities and a smooth threshold (Freudenberg, Masuch, Strothotte 2002; Nienhaus
 * and Döllner 2003, 5).
 *
 * The tone is Lambert's; a texel of the stroke texture is inked where the tone lies below its priority, and
 *     ink = clamp(1/2 + SHARPNESS (priority - tone))
 * instead of a step: anti-aliased, and strokes fade in. Strokes lie on the screen, or stick to the surface: along
 * its texture coordinates, or along the one of the three axes that its normal is nearest to. There the
 * texture is scaled by powers of two so that strokes keep their width on the screen, two neighbouring
 * powers mixed, so that nothing jumps. */
#include "shade/shade.h"

static const float SHARPNESS = 5;
static const float TEXELS_PER_PX = 1.0f; /* of the built-in strokes, two to three texels wide */

/* Bilinear, wrapped. u, v in texels. */
static float sample(const dp_strokes_texture *t, float u, float v) {
    const float fu = floorf(u), fv = floorf(v), s = u - fu, r = v - fv;
    const float w = (float)t->width, h = (float)t->height;
    const uint32_t x = (uint32_t)dp_minf(dp_maxf(fu - w * floorf(fu / w), 0), w - 1);
    const uint32_t y = (uint32_t)dp_minf(dp_maxf(fv - h * floorf(fv / h), 0), h - 1);
    const uint32_t x1 = x + 1 < t->width ? x + 1 : 0, y1 = y + 1 < t->height ? y + 1 : 0;
    const uint8_t *const top = t->values + (size_t)y * t->width, *const low = t->values + (size_t)y1 * t->width;
    const float a = (float)top[x] + s * (float)(top[x1] - top[x]), b = (float)low[x] + s * (float)(low[x1] - low[x]);
    return (a + r * (b - a)) * (1 / 255.0f);
}

/* Strokes of constant width: (u, v) in any unit, `texels` texels per unit wanted. */
static float sample_scaled(const dp_strokes_texture *t, float u, float v, float texels) {
    int level;
    const float part = 2 * frexpf(texels, &level) - 1; /* texels = 2^(level - 1) (1 + part) */
    const float low = ldexpf(1, level - 1), high = 2 * low;
    const float fine = sample(t, u * low, v * low), coarse = sample(t, u * high, v * high);
    return fine + (coarse - fine) * part;
}

static dp_vec3 world_direction(const dp_gbuffer *g, float x, float y, float z) {
    const double(*const m)[3] = g->rotation;
    return dp_v3(m[0][0] * x + m[1][0] * y + m[2][0] * z, m[0][1] * x + m[1][1] * y + m[2][1] * z,
                 m[0][2] * x + m[1][2] * y + m[2][2] * z);
}

/* A fringe's surface, too. */
static float distance_at(const dp_shading_setup *s, const dp_shade_run *run, uint32_t i) {
    return run->distance[i] < DP_FAR ? run->distance[i] : s->g->other[(size_t)run->y * s->g->stride + run->x + i];
}

/* Along the axis that the normal is nearest to, in world units; `texels` per unit. */
static float sample_axes(const dp_shading_setup *s, const dp_shade_run *run, uint32_t i, float texels) {
    const dp_gbuffer *const g = s->g;
    const float z = distance_at(s, run, i), on = g->perspective ? z : 1;
    const float rx = ((float)(int32_t)(run->x + i) + 0.5f - g->cx) / g->fx * on, ry = (g->cy - ((float)run->y + 0.5f)) / g->fy * on;
    const dp_vec3 at = dp_add(g->eye, world_direction(g, rx, ry, -z));
    const dp_vec3 n = world_direction(g, run->nx[i], run->ny[i], run->nz[i]);
    const double p[3] = {at.x, at.y, at.z}, a[3] = {fabs(n.x), fabs(n.y), fabs(n.z)};
    double weight[3], sum = 0;
    float value = 0;
    for (int k = 0; k < 3; k++) { /* the sixth power: one axis but for a narrow seam */
        const double w = a[k] * a[k] * a[k];
        sum += weight[k] = w * w;
    }
    for (int k = 0; k < 3; k++) {
        if (!(weight[k] > 0.02 * sum)) continue;
        const double u = p[(k + 1) % 3], v = p[(k + 2) % 3]; /* a turn, so that no axis runs along the strokes */
        const float share = (float)(weight[k] / sum);
        value += share * sample_scaled(&s->strokes, (float)(0.8 * u + 0.6 * v), (float)(0.8 * v - 0.6 * u), texels);
    }
    return value;
}

/* Texture units per px, from the neighbours that show the same group; 0: unknown. */
static float texture_step(const dp_shade_run *run, uint32_t i) {
    const int64_t places[4] = {1, -1, (int64_t)run->stride, -(int64_t)run->stride};
    float most = 0;
    for (int k = 0; k < 4; k++) {
        const int64_t other = (int64_t)i + places[k];
        if (run->id[other] != run->id[i]) continue;
        const float du = run->u[other] - run->u[i], dv = run->v[other] - run->v[i], step = sqrtf(du * du + dv * dv);
        if (step > 0 && (most <= 0 || step < most)) most = step;
    }
    return most;
}

static float sample_surface(const dp_shading_setup *s, const dp_shade_run *run, uint32_t i) {
    const dp_gbuffer *const g = s->g;
    const float wanted = TEXELS_PER_PX / s->shade.stroke_scale; /* texels per px */
    if (run->u && run->u[i] == run->u[i]) {
        const float step = texture_step(run, i);
        if (step > 1e-12f) return sample_scaled(&s->strokes, run->u[i], run->v[i], wanted / step);
    }
    const float px = (g->perspective ? distance_at(s, run, i) : 1) / g->fy;
    return sample_axes(s, run, i, wanted / px);
}

void dp_shade_hatch(const dp_shading_setup *setup, dp_shade_run *run) {
    const dp_shade *const s = &setup->shade;
    const float lx = s->light[0], ly = s->light[1], lz = s->light[2];
    const float scale = TEXELS_PER_PX / s->stroke_scale;
    const float turn[2] = {0.8f * scale, 0.6f * scale}; /* 37 degrees */
    float priority[DP_TILE];
    for (uint32_t i = 0; i < run->n; i++) {
        const float x = (float)(int32_t)(run->x + i), y = (float)run->y;
        priority[i] = s->object_space ? sample_surface(setup, run, i)
                                      : sample(&setup->strokes, turn[0] * x + turn[1] * y, turn[0] * y - turn[1] * x);
    }
    for (uint32_t i = 0; i < run->n; i++) {
        const float n_l = run->nx[i] * lx + run->ny[i] * ly + run->nz[i] * lz;
        const float tone = dp_minf(0.08f + 0.98f * dp_maxf(0.35f * n_l + 0.65f * dp_maxf(n_l, 0) + 0.12f, 0), 1.2f);
        const float ink = priority[i] > 0 ? dp_minf(dp_maxf(0.5f + SHARPNESS * (priority[i] - tone), 0), 1) : 0;
        for (int k = 0; k < 3; k++) run->color[k][i] += (setup->ink[k] - run->color[k][i]) * ink;
    }
}
