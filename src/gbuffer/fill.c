/* The first pass: what the samples of a tile hold becomes one surface per pixel.
 *
 * A pixel's samples that lie on one surface (near each other in depth, or on one plane) are taken together; the
 * greatest such part is the pixel's surface, the nearer one of two halves. How great it is (`share`) and how far
 * away the rest lies (`other`) is kept, so that colours can be put together again later: this is what
 * multisampling resolves, at the price of one shading per pixel.
 *
 * The normal is interpolated, right in perspective, at a sample that the polygon covers; the distance is that of
 * the polygon's plane at the pixel's centre, so that neighbours differ as the surface does and not as their
 * samples' places do. What the polygons give is first collected for a row; turning, facing and normalizing
 * then run over the row in plain loops. */
#include "gbuffer/gbuffer.h"

#include <string.h>

static const float SAME_SURFACE = 3; /* pixel sizes between samples of one surface */
static const float REACH = 8;        /* pixel sizes that a plane may differ between a sample and the centre */

typedef struct fill {
    dp_gbuffer *g;
    const dp_tile_worker *w;
    bool facets;
    float step; /* change of depth over a pixel size, per depth (perspective) or as such */
} fill;

/* One row of the tile, as its polygons give it. Zero where there is none. */
typedef struct row {
    float wx[DP_TILE], wy[DP_TILE], wz[DP_TILE]; /* normals in world space, not unit, 0 for the facet's */
    float d0[DP_TILE], dx[DP_TILE], dy[DP_TILE]; /* planes; tile space */
    float nearest[DP_TILE];                      /* depth that a polygon does not exceed */
    float d[DP_TILE];                            /* depth where it was sampled; 0: no surface */
    float in[DP_TILE];                           /* 1: there is a surface */
} row;

/* What a pixel shows. */
typedef struct picked {
    uint32_t polygon; /* of the tile */
    float x, y, d;    /* where it is sampled */
    uint8_t share;
    float other;      /* depth of the rest; DP_DEPTH_EMPTY: paper */
} picked;

static float step_at(const fill *f, float d) { return f->g->perspective ? f->step * d : f->step; }

/* Which of the samples lie on the surface that sample `s` shows, as a set. */
static uint32_t samples_with(const fill *f, size_t lane, uint32_t s, float px, float py) {
    const dp_tile_worker *const w = f->w;
    const uint32_t n = w->frame->target.samples, *const winner = w->winner + lane;
    const float *const d = w->depth + lane;
    const dp_tile_polygon *const p = &w->polygons[winner[s]];
    const float near = SAME_SURFACE * step_at(f, d[s]);
    uint32_t set = 0;
    for (uint32_t i = 0; i < n; i++) {
        if (winner[i] == UINT32_MAX) continue;
        const float x = px + w->sampling.x[i / 4][i % 4], y = py + w->sampling.y[i / 4][i % 4];
        if (fabsf(d[i] - d[s]) <= near || fabsf(d[i] - dp_plane_at(p, x, y)) <= near) set |= 1u << i;
    }
    return set;
}

/* The pixel holds more than one polygon, or not only polygons. */
static void pick_part(const fill *f, size_t lane, float px, float py, picked *out) {
    const dp_tile_worker *const w = f->w;
    const uint32_t n = w->frame->target.samples, *const winner = w->winner + lane;
    uint32_t s = 0, t = 0;
    while (winner[s] == UINT32_MAX) s++;
    uint32_t set = samples_with(f, lane, s, px, py);
    const uint32_t count = (uint32_t)__builtin_popcount(set);
    for (t = s + 1; t < n && 2 * count <= n; t++) {
        if (winner[t] == UINT32_MAX || set >> t & 1) continue;
        const uint32_t rest = samples_with(f, lane, t, px, py);
        const uint32_t more = (uint32_t)__builtin_popcount(rest);
        if (more > count || (more == count && w->depth[lane + t] > w->depth[lane + s])) set = rest, s = t;
        break;
    }
    const uint32_t left = ~set & ((1u << n) - 1);
    *out = (picked){.polygon = winner[s], .d = w->depth[lane + s],
                  .x = px + w->sampling.x[s / 4][s % 4], .y = py + w->sampling.y[s / 4][s % 4],
                  .share = (uint8_t)(255 * (uint32_t)__builtin_popcount(set) >> __builtin_ctz(n)), /* n is 4, 8 or 16 */
                  .other = DP_DEPTH_EMPTY};
    if (left && winner[__builtin_ctz(left)] != UINT32_MAX) out->other = w->depth[lane + (uint32_t)__builtin_ctz(left)];
}

static bool pick_at_centre(const fill *f, uint32_t polygon, uint32_t x, uint32_t y, picked *out) {
    const float cx = (float)x + 0.5f, cy = (float)y + 0.5f;
    *out = (picked){.polygon = polygon, .x = cx, .y = cy, .d = dp_plane_at(&f->w->polygons[polygon], cx, cy), .share = 255};
    return true;
}

static bool all_same(dp_i4 v) { return !dp_any(v ^ (dp_i4){v[1], v[2], v[3], v[0]}); }

/* Four samples, as there mostly are. Small polygons: several, and still one surface. */
static bool pick_of_four(const fill *f, uint32_t x, uint32_t y, picked *out) {
    const dp_tile_worker *const w = f->w;
    const size_t lane = dp_pixel_lane(&w->sampling, x, y);
    const dp_i4 winner = *(const dp_i4 *)(const void *)(w->winner + lane);
    if (all_same(winner)) return winner[0] == -1 ? false : pick_at_centre(f, (uint32_t)winner[0], x, y, out);
    const dp_f4 d = *(const dp_f4 *)(const void *)(w->depth + lane);
    const dp_f4 near = dp_splat(SAME_SURFACE * step_at(f, d[0])), off = d - dp_splat(d[0]);
    if (dp_any((winner == -1) | (off > near) | (off < -near))) {
        pick_part(f, lane, (float)x, (float)y, out);
        return true;
    }
    *out = (picked){.polygon = (uint32_t)winner[0], .d = d[0], .share = 255, .x = (float)x + w->sampling.x[0][0],
                    .y = (float)y + w->sampling.y[0][0]};
    return true;
}

/* False: nothing but paper. */
static bool pick_surface(const fill *f, uint32_t x, uint32_t y, picked *out) {
    const dp_tile_worker *const w = f->w;
    const uint32_t n = w->frame->target.samples;
    if (n == 4) return pick_of_four(f, x, y, out);
    const size_t lane = dp_pixel_lane(&w->sampling, x, y);
    const uint32_t *const winner = w->winner + lane;
    bool same = true;
    for (uint32_t i = 1; i < n; i++) same &= winner[i] == winner[0];
    if (same) return winner[0] == UINT32_MAX ? false : pick_at_centre(f, winner[0], x, y, out);
    pick_part(f, lane, (float)x, (float)y, out);
    return true;
}

/* ------- corners' weights ------- */

typedef struct weights {
    uint32_t corner[3]; /* of the frame's polygons */
    float weight[3];    /* none below zero */
} weights;

static float cross2(dp_vertex a, dp_vertex b, float x, float y) { return (a.x - x) * (b.y - y) - (a.y - y) * (b.x - x); }

/* Of the triangles (0, i - 1, i) of the polygon's fan the one that holds the point, or comes nearest to it. Areas
 * on the screen times depth are weights in space (perspective), but for a common factor. */
static void screen_weights(const dp_tile_worker *w, const dp_tile_polygon *p, float x, float y, weights *out) {
    const dp_vertex *const at = w->points + p->point;
    const uint32_t first = dp_first_corner(&w->frame->polygons, p->id);
    const bool perspective = w->frame->view.perspective;
    float best = -INFINITY;
    for (uint32_t i = 2; i < p->points; i++) {
        const dp_vertex a = at[0], b = at[i - 1], c = at[i];
        float e[3] = {cross2(b, c, x, y), cross2(c, a, x, y), cross2(a, b, x, y)};
        if (e[0] + e[1] + e[2] < 0)
            for (int k = 0; k < 3; k++) e[k] = -e[k];
        const float least = dp_minf(e[0], dp_minf(e[1], e[2]));
        if (i > 2 && !(least > best)) continue;
        best = least;
        *out = (weights){{first, first + i - 1, first + i}, {0}};
        const float d[3] = {a.d, b.d, c.d};
        for (int k = 0; k < 3; k++) out->weight[k] = dp_maxf(e[k], 0) * (perspective ? d[k] : 1);
    }
}

/* The same of a triangle: no search. */
static inline void triangle_weights(const dp_tile_worker *w, const dp_tile_polygon *p, bool perspective, float x, float y, weights *out) {
    const dp_vertex *const at = w->points + p->point;
    const dp_vertex a = at[0], b = at[1], c = at[2];
    const uint32_t first = dp_first_corner(&w->frame->polygons, p->id);
    const float ea = cross2(b, c, x, y), eb = cross2(c, a, x, y), ec = cross2(a, b, x, y);
    const float sign = ea + eb + ec < 0 ? -1.0f : 1.0f;
    out->corner[0] = first, out->corner[1] = first + 1, out->corner[2] = first + 2;
    out->weight[0] = dp_maxf(sign * ea, 0) * (perspective ? a.d : 1);
    out->weight[1] = dp_maxf(sign * eb, 0) * (perspective ? b.d : 1);
    out->weight[2] = dp_maxf(sign * ec, 0) * (perspective ? c.d : 1);
}

/* The same in space, for a polygon whose points are not its corners any more. */
static void space_weights(const dp_tile_worker *w, const dp_tile_polygon *p, const picked *pick, weights *out) {
    const dp_polygons *const polygons = &w->frame->polygons;
    const uint32_t first = dp_first_corner(polygons, p->id), n = dp_corner_count(polygons, p->id);
    const dp_vec3 q = dp_unproject(&w->frame->view, (dp_pointd){(double)pick->x + w->tile_x, (double)pick->y + w->tile_y, pick->d});
    const dp_vec3 normal = dp_polygon_normal(w->frame, p->id);
    const dp_vec3 a = dp_sub(dp_v3f(dp_vertex_position(polygons, dp_corner_vertex(polygons, first))), q);
    double best = -INFINITY;
    for (uint32_t i = 2; i < n; i++) {
        const dp_vec3 b = dp_sub(dp_v3f(dp_vertex_position(polygons, dp_corner_vertex(polygons, first + i - 1))), q);
        const dp_vec3 c = dp_sub(dp_v3f(dp_vertex_position(polygons, dp_corner_vertex(polygons, first + i))), q);
        const double e[3] = {dp_dot(dp_cross(b, c), normal), dp_dot(dp_cross(c, a), normal), dp_dot(dp_cross(a, b), normal)};
        const double least = dp_min(e[0], dp_min(e[1], e[2])), sum = fabs(e[0]) + fabs(e[1]) + fabs(e[2]);
        if (i > 2 && !(least > best)) continue;
        best = least;
        *out = (weights){{first, first + i - 1, first + i}, {0}};
        for (int k = 0; k < 3; k++) out->weight[k] = sum > 0 ? (float)(dp_max(e[k], 0) / sum) : 0;
    }
}

static const int16_t *corner_normal(const fill *f, uint32_t corner) {
    const int16_t *const shared = f->g->normals->vertex[dp_corner_vertex(&f->w->frame->polygons, corner)];
    return shared[3] ? f->g->normals->corner[corner] : shared;
}

/* The weighted sum of the corners' normals; 0 where there are none. */
static void sum_normals(const fill *f, const weights *at, float sign, float out[3]) {
    const int16_t *const a = corner_normal(f, at->corner[0]), *const b = corner_normal(f, at->corner[1]);
    const int16_t *const c = corner_normal(f, at->corner[2]);
    for (int k = 0; k < 3; k++)
        out[k] = sign * (at->weight[0] * (float)a[k] + at->weight[1] * (float)b[k] + at->weight[2] * (float)c[k]);
}

static void put_texcoord(const fill *f, const weights *at, size_t pixel) {
    const dp_polygons *const p = &f->w->frame->polygons;
    float sum = 0, uv[2] = {0, 0};
    f->g->u[pixel] = f->g->v[pixel] = NAN;
    for (int k = 0; k < 3; k++) {
        const uint32_t i = dp_attribute_number(&p->texcoords, at->corner[k], dp_corner_vertex(p, at->corner[k]));
        if (i == UINT32_MAX) return;
        const float *const t = dp_attribute_value(&p->texcoords, i);
        uv[0] += at->weight[k] * t[0], uv[1] += at->weight[k] * t[1];
        sum += at->weight[k];
    }
    if (sum > 0) f->g->u[pixel] = uv[0] / sum, f->g->v[pixel] = uv[1] / sum;
}

/* ------- rows ------- */

static uint16_t id_of(const dp_polygons *polygons, uint32_t polygon) {
    const uint16_t group = polygons->groups ? polygons->groups[polygon] : 0;
    return group < UINT16_MAX ? (uint16_t)(1 + group) : UINT16_MAX;
}

static inline void fill_pixel(const fill *f, uint32_t x, const picked *pick, size_t pixel, row *r) {
    const dp_tile_worker *const w = f->w;
    dp_gbuffer *const g = f->g;
    const dp_tile_polygon *const p = &w->polygons[pick->polygon];
    float normal[3] = {0, 0, 0};
    if (!f->facets || g->textured) {
        weights at = {{0}, {0}};
        if (p->flags & DP_POLYGON_CLIPPED) space_weights(w, p, pick, &at);
        else if (p->points == 3) triangle_weights(w, p, g->perspective, pick->x, pick->y, &at);
        else screen_weights(w, p, pick->x, pick->y, &at);
        if (!f->facets) sum_normals(f, &at, p->flags & DP_POLYGON_FRONT ? 1 : -1, normal);
        if (g->textured) put_texcoord(f, &at, pixel);
    }
    r->wx[x] = normal[0], r->wy[x] = normal[1], r->wz[x] = normal[2];
    r->d0[x] = p->d0, r->dx[x] = p->dx, r->dy[x] = p->dy;
    r->nearest[x] = p->nearest, r->d[x] = pick->d, r->in[x] = 1;
    g->id[pixel] = id_of(&w->frame->polygons, p->id);
    if (g->polygon) g->polygon[pixel] = p->id;
    if (pick->share < 255) g->share[pixel] = pick->share;
}

/* Pixels that surfaces share: what lies beside, and which are fringes. After finish_row. */
static void share_pixel(const fill *f, const picked *pick, size_t pixel) {
    dp_gbuffer *const g = f->g;
    const bool paper = pick->other <= DP_DEPTH_EMPTY;
    g->other[pixel] = paper ? DP_FAR : (float)dp_distance(&f->w->frame->view, pick->other);
    if (pick->share >= 128 || !paper) return;
    g->other[pixel] = g->distance[pixel]; /* fringe */
    g->distance[pixel] = DP_FAR;
    g->depth[pixel] = dp_gbuffer_empty_depth(g->perspective);
}

static void fill_background(dp_gbuffer *g, size_t pixel, uint32_t n) {
    const float empty = dp_gbuffer_empty_depth(g->perspective);
    float *const distance = g->distance + pixel, *const depth = g->depth + pixel;
    for (uint32_t i = 0; i < n; i++) distance[i] = DP_FAR;
    for (uint32_t i = 0; i < n; i++) depth[i] = empty;
    memset(g->id + pixel, 0, n * sizeof *g->id);
    memset(g->share + pixel, 255, n);
    memset(g->nx + pixel, 0, n * sizeof(float));
    memset(g->ny + pixel, 0, n * sizeof(float));
    memset(g->nz + pixel, 0, n * sizeof(float));
}

/* Depth of each polygon's plane at the pixels' centres, kept near what was sampled: a plane that is seen edge-on
 * must not shoot away. */
static void finish_depths(const fill *f, const row *r, uint32_t y, size_t pixel, uint32_t n) {
    const dp_gbuffer *const g = f->g;
    float *restrict const distance = g->distance + pixel, *restrict const depth = g->depth + pixel;
    const float cy = (float)y + 0.5f, grows = g->perspective, still = 1 - grows, reach = REACH * f->step;
    const float empty = dp_gbuffer_empty_depth(g->perspective);
    for (uint32_t x = 0; x < n; x++) {
        const float cx = (float)(int32_t)x + 0.5f, at = r->d[x], away = reach * (grows * at + still);
        const float plane = r->d0[x] + r->dx[x] * cx + r->dy[x] * cy;
        const float d = dp_minf(dp_maxf(plane, at - away), dp_minf(at + away, dp_maxf(r->nearest[x], at)));
        depth[x] = r->in[x] > 0 ? d : empty;
        distance[x] = r->in[x] > 0 ? grows / dp_maxf(d, still) - still * d : DP_FAR; /* 1 / d or -d */
    }
}

/* World to camera space, unit length, and facing as the visible side of the polygon does. A normal that lies
 * clearly on the other side contradicts the winding: it is turned round. One that is missing is the polygon's, from
 * its plane's gradient. */
static void finish_normals(const fill *f, const row *r, size_t pixel, uint32_t n) {
    const dp_gbuffer *const g = f->g;
    float *restrict const nx = g->nx + pixel, *restrict const ny = g->ny + pixel, *restrict const nz = g->nz + pixel;
    const float cx = g->cx - (float)f->w->tile_x, cy = g->cy - (float)f->w->tile_y; /* where the axis meets the screen */
    const float on = g->perspective, off = 1 - on;
    float m[3][3];
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) m[i][k] = (float)g->rotation[i][k];
    for (uint32_t x = 0; x < n; x++) {
        const float wx = r->wx[x], wy = r->wy[x], wz = r->wz[x];
        const float length2 = wx * wx + wy * wy + wz * wz;
        const float fx = -g->fx * r->dx[x], fy = g->fy * r->dy[x];
        const float fz = on * (r->d0[x] + r->dx[x] * cx + r->dy[x] * cy) + off * r->in[x];
        const float facet2 = fx * fx + fy * fy + fz * fz;
        const float facet = facet2 > 0 ? 1 / sqrtf(facet2) : 0;
        const float unit = length2 > 1e-30f && length2 < 1e30f ? 1 / sqrtf(length2) : 0;
        const float ex = unit * (m[0][0] * wx + m[0][1] * wy + m[0][2] * wz);
        const float ey = unit * (m[1][0] * wx + m[1][1] * wy + m[1][2] * wz);
        const float ez = unit * (m[2][0] * wx + m[2][1] * wy + m[2][2] * wz);
        const float toward = facet * (ex * fx + ey * fy + ez * fz);
        const float sign = toward < -0.25f ? -1.0f : 1.0f, own = unit > 0 ? 0 : facet;
        nx[x] = sign * ex + own * fx, ny[x] = sign * ey + own * fy, nz[x] = sign * ez + own * fz;
    }
}

/* Which polygons a row shows is known before their normals are needed: nearly all the time goes into waiting. */
static void prefetch_normals(const fill *f, const dp_tile_polygon *p) {
    if (f->facets) return;
    const dp_polygons *const polygons = &f->w->frame->polygons;
    const uint32_t first = dp_first_corner(polygons, p->id);
    for (uint32_t k = 0; k < 3; k++) __builtin_prefetch(f->g->normals->vertex[dp_corner_vertex(polygons, first + k)]);
}

static uint64_t fill_row(const fill *f, uint32_t y, uint32_t width) {
    dp_gbuffer *const g = f->g;
    const dp_tile_worker *const w = f->w;
    const size_t pixel = (size_t)(w->tile_y + y) * g->stride + w->tile_x;
    row r;
    picked picks[DP_TILE];
    uint64_t mask = 0;
    for (uint32_t x = 0; x < width; x++) {
        if (!pick_surface(f, x, y, &picks[x])) continue;
        mask |= (uint64_t)1 << x;
        prefetch_normals(f, &w->polygons[picks[x].polygon]);
    }
    if (!mask) {
        fill_background(g, pixel, width);
        return 0;
    }
    if (mask != ~(uint64_t)0 >> (64 - width)) {
        memset(g->id + pixel, 0, width * sizeof *g->id);
        memset(&r, 0, sizeof r);
    }
    memset(g->share + pixel, 255, width);
    for (uint64_t bits = mask; bits; bits &= bits - 1) {
        const uint32_t x = (uint32_t)__builtin_ctzll(bits);
        fill_pixel(f, x, &picks[x], pixel + x, &r);
    }
    finish_depths(f, &r, y, pixel, width);
    finish_normals(f, &r, pixel, width);
    for (uint64_t bits = mask; bits; bits &= bits - 1) {
        const uint32_t x = (uint32_t)__builtin_ctzll(bits);
        if (picks[x].share < 255) share_pixel(f, &picks[x], pixel + x);
    }
    return mask;
}

void dp_gbuffer_fill(dp_gbuffer *g, const dp_tile_worker *w, dp_normals normals) {
    uint64_t *const mask = g->mask + (size_t)w->tile * DP_TILE;
    const uint32_t width = g->width - w->tile_x < DP_TILE ? g->width - w->tile_x : DP_TILE;
    const uint32_t height = g->height - w->tile_y < DP_TILE ? g->height - w->tile_y : DP_TILE;
    const bool bare = w->frame->tile_pieces[w->tile].bare;
    const dp_view *const view = &w->frame->view;
    const fill f = {.g = g, .w = w, .facets = normals == DP_NORMALS_FACET || !g->normals,
                    .step = (float)(1 / view->focal)};
    memset(mask, 0, DP_TILE * sizeof *mask);
    if (bare && g->clean[w->tile]) return; /* it still holds background */
    for (uint32_t y = 0; y < height; y++) {
        if (bare) fill_background(g, (size_t)(w->tile_y + y) * g->stride + w->tile_x, width);
        else mask[y] = fill_row(&f, y, width);
    }
    g->clean[w->tile] = bare; /* the margin beside it is not yet */
}
