/* Fills the G-buffer: a tile's samples become one surface per pixel (Nienhaus and Döllner 2003,
 * 4.1.1, which has one sample per pixel).
 *
 *     for each row:      pick       each pixel: the polygon it shows, or that it is mixed
 *         mixed pixels   put_part   the largest part of the samples that lie on one surface (near
 *                                     in depth, or on one plane); the nearer of two halves
 *     one row later:     touch      prefetch corner normals
 *     two rows later:    collect    planes, weights, interpolated normals
 *         odd pixels     collect_odd
 *                        finish     distance at the pixel's centre, unit normals -> planes
 *                        share      mixed pixels: share of the surface, distance of the rest, so
 *                                     that colours can be mixed later
 *
 * That is multisampling at one shading per pixel. The normal is interpolated (in perspective) at a
 * sample that the polygon covers. The distance is the plane's at the pixel's centre, so that
 * neighbours differ as the surface does, not as their samples' places do.
 *
 * Most pixels go through the kernels (fill.inc). Here: mixed pixels, and odd ones, whose polygon
 * was clipped or has more than three corners. */
#include "core/piece.h"
#include "gbuffer/fill.h"

#include <string.h>

/* What a pixel shows. */
typedef struct picked {
    uint32_t polygon; /* of the tile */
    float x, y, d;    /* where it is sampled, tile space */
    uint8_t share;
    float other; /* depth of the rest; DP_DEPTH_EMPTY: paper */
} picked;

static float step_at(const dp_fill *f, float d) {
    return f->g->perspective ? f->step * d : f->step;
}

/* The set of samples that lie on the surface of sample `s`. */
static uint32_t samples_with(const dp_fill *f, size_t lane, uint32_t s, float px, float py) {
    const dp_tile *const w = f->w;
    const uint32_t n = w->frame->target.samples, *const winner = w->winner + lane;
    const float *const d = w->depth + lane;
    const dp_tile_polygon *const p = &w->polygons[winner[s]];
    const float near = DP_SAME_SURFACE * step_at(f, d[s]);
    uint32_t set = 0;
    for (uint32_t i = 0; i < n; i++) {
        if (winner[i] == UINT32_MAX) continue;
        const float x = px + w->sampling.x[i / 4][i % 4], y = py + w->sampling.y[i / 4][i % 4];
        if (fabsf(d[i] - d[s]) <= near || fabsf(d[i] - dp_plane_at(p, x, y)) <= near)
            set |= 1u << i;
    }
    return set;
}

/* Picks the surface of a mixed pixel: that of the larger of its first two parts. */
static void pick_part(const dp_fill *f, size_t lane, float px, float py, picked *out) {
    const dp_tile *const w = f->w;
    const uint32_t n = w->frame->target.samples, *const winner = w->winner + lane;
    uint32_t s = 0, t = 0;
    while (winner[s] == UINT32_MAX) s++;
    uint32_t set = samples_with(f, lane, s, px, py);
    const uint32_t count = (uint32_t)__builtin_popcount(set);
    for (t = s + 1; t < n && 2 * count <= n; t++) {
        if (winner[t] == UINT32_MAX || set >> t & 1) continue;
        const uint32_t rest = samples_with(f, lane, t, px, py);
        const uint32_t more = (uint32_t)__builtin_popcount(rest);
        if (more > count || (more == count && w->depth[lane + t] > w->depth[lane + s]))
            set = rest, s = t;
        break;
    }
    const uint32_t left = ~set & ((1u << n) - 1);
    *out = (picked){.polygon = winner[s],
                    .d = w->depth[lane + s],
                    .x = px + w->sampling.x[s / 4][s % 4],
                    .y = py + w->sampling.y[s / 4][s % 4],
                    .share = (uint8_t)(255 * (uint32_t)__builtin_popcount(set) >>
                                       __builtin_ctz(n)), /* n is 4, 8 or 16 */
                    .other = DP_DEPTH_EMPTY};
    if (left && winner[__builtin_ctz(left)] != UINT32_MAX)
        out->other = w->depth[lane + (uint32_t)__builtin_ctz(left)];
}

/* Puts a mixed pixel into the row. */
static void put_part(const dp_fill *f, uint32_t x, dp_fill_row *r) {
    picked p;
    pick_part(f, dp_pixel_lane(&f->w->sampling, x, r->y), (float)x, (float)r->y, &p);
    r->polygon[x] = p.polygon;
    r->x[x] = p.x, r->y_at[x] = p.y, r->d[x] = p.d;
    r->share[x] = p.share, r->other[x] = p.other;
}

/* As the kernel `pick`, for any number of samples. */
static void pick_row(const dp_fill *f, dp_fill_row *r) {
    const dp_tile *const w = f->w;
    const uint32_t n = w->frame->target.samples;
    r->mask = r->whole = r->mixed = 0;
    for (uint32_t x = 0; x < DP_TILE; x++) {
        const uint32_t *const winner = w->winner + dp_pixel_lane(&w->sampling, x, r->y);
        bool same = true;
        for (uint32_t i = 1; i < n; i++) same &= winner[i] == winner[0];
        r->polygon[x] = winner[0];
        if (same && winner[0] == UINT32_MAX) continue;
        r->mask |= (uint64_t)1 << x;
        *(same ? &r->whole : &r->mixed) |= (uint64_t)1 << x;
    }
}

/* ------- corners' weights ------- */

typedef struct weights {
    uint32_t corner[3]; /* of the frame's polygons */
    float weight[3];    /* none below zero */
} weights;

static float cross2(dp_vertex a, dp_vertex b, float x, float y) {
    return (a.x - x) * (b.y - y) - (a.y - y) * (b.x - x);
}

/* Weights in the triangle (0, i - 1, i) of the polygon's fan that holds the point, or is nearest:
 * areas on the screen, in perspective times depth; up to a common factor. */
static void screen_weights(const dp_tile *w, const dp_tile_polygon *p, float x, float y,
                           weights *out) {
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

/* The same in space, for a clipped polygon, whose points are not its corners. */
static void space_weights(const dp_tile *w, const dp_tile_polygon *p, float x, float y, float d,
                          weights *out) {
    const dp_polygons *const polygons = &w->frame->polygons;
    const uint32_t first = dp_first_corner(polygons, p->id), n = dp_corner_count(polygons, p->id);
    const dp_vec3 q =
        dp_unproject(&w->frame->view, (dp_pointd){(double)x + w->tile_x, (double)y + w->tile_y, d});
    const dp_vec3 normal = dp_polygon_normal(w->frame, p->id);
    const dp_vec3 a =
        dp_sub(dp_v3f(dp_vertex_position(polygons, dp_corner_vertex(polygons, first))), q);
    double best = -INFINITY;
    for (uint32_t i = 2; i < n; i++) {
        const dp_vec3 b = dp_sub(
            dp_v3f(dp_vertex_position(polygons, dp_corner_vertex(polygons, first + i - 1))), q);
        const dp_vec3 c =
            dp_sub(dp_v3f(dp_vertex_position(polygons, dp_corner_vertex(polygons, first + i))), q);
        const double e[3] = {dp_dot(dp_cross(b, c), normal), dp_dot(dp_cross(c, a), normal),
                             dp_dot(dp_cross(a, b), normal)};
        const double least = dp_min(e[0], dp_min(e[1], e[2])),
                     sum = fabs(e[0]) + fabs(e[1]) + fabs(e[2]);
        if (i > 2 && !(least > best)) continue;
        best = least;
        *out = (weights){{first, first + i - 1, first + i}, {0}};
        for (int k = 0; k < 3; k++) out->weight[k] = sum > 0 ? (float)(dp_max(e[k], 0) / sum) : 0;
    }
}

/* The weighted sum of the corners' normals; 0 if there are none. */
static void sum_normals(const dp_fill *f, const weights *at, float sign, float out[3]) {
    const dp_polygons *const polygons = &f->w->frame->polygons;
    const int16_t *n[3];
    for (int k = 0; k < 3; k++)
        n[k] = dp_fill_normal(f, at->corner[k], dp_corner_vertex(polygons, at->corner[k]));
    for (int k = 0; k < 3; k++)
        out[k] = sign * (at->weight[0] * (float)n[0][k] + at->weight[1] * (float)n[1][k] +
                         at->weight[2] * (float)n[2][k]);
}

static void put_texcoord(const dp_fill *f, const weights *at, size_t pixel) {
    const dp_polygons *const p = &f->w->frame->polygons;
    float sum = 0, uv[2] = {0, 0};
    f->g->u[pixel] = f->g->v[pixel] = NAN;
    for (int k = 0; k < 3; k++) {
        const uint32_t i =
            dp_attribute_number(&p->texcoords, at->corner[k], dp_corner_vertex(p, at->corner[k]));
        if (i == UINT32_MAX) return;
        const float *const t = dp_attribute_value(&p->texcoords, i);
        uv[0] += at->weight[k] * t[0], uv[1] += at->weight[k] * t[1];
        sum += at->weight[k];
    }
    if (sum > 0) f->g->u[pixel] = uv[0] / sum, f->g->v[pixel] = uv[1] / sum;
}

/* The colour that a pixel of a polygon of the frame has instead of its group's: that of a section's
 * face, or the model's, interpolated as it is encoded. */
static void put_color(const dp_fill *f, uint32_t polygon, const weights *at, size_t pixel) {
    const dp_polygons *const p = &f->w->frame->polygons;
    float sum = 0, rgba[4] = {0, 0, 0, 0};
    const dp_style *const style = dp_polygon_style(f->w->frame, polygon);
    f->g->color[pixel] = 0;
    if (style->section && p->edge_flags && p->edge_flags[at->corner[0]] == DP_EDGE_FACE) {
        f->g->color[pixel] = style->section;
        return;
    }
    if (!p->colors || !style->shade.model_colors || style->shade.shading == DP_SHADING_PAPER)
        return;
    for (int k = 0; k < 3; k++) {
        const uint32_t color = p->colors[dp_corner_vertex(p, at->corner[k])];
        if (!color) return;
        for (int c = 0; c < 4; c++)
            rgba[c] += at->weight[k] * (float)(color >> (24 - 8 * c) & 0xff);
        sum += at->weight[k];
    }
    for (int c = 0; c < 4 && sum > 0; c++)
        f->g->color[pixel] |= (uint32_t)(rgba[c] / sum + 0.5f) << (24 - 8 * c);
}

/* What is interpolated besides normals. */
static void put_more(const dp_fill *f, uint32_t polygon, const weights *at, size_t pixel) {
    if (f->g->textured) put_texcoord(f, at, pixel);
    if (f->g->colored) put_color(f, polygon, at, pixel);
}

/* `collect` for a pixel whose polygon's points are not its three corners. */
static void collect_odd(const dp_fill *f, uint32_t x, size_t pixel, dp_fill_row *r) {
    const dp_tile *const w = f->w;
    const dp_tile_polygon *const p = &w->polygons[r->polygon[x]];
    weights at = {{0}, {0}};
    float normal[3] = {0, 0, 0};
    if (p->flags & DP_POLYGON_CLIPPED)
        space_weights(w, p, r->x[x], r->y_at[x], r->d[x], &at);
    else
        screen_weights(w, p, r->x[x], r->y_at[x], &at);
    if (!f->facets) sum_normals(f, &at, p->flags & DP_POLYGON_FRONT ? 1 : -1, normal);
    r->wx[x] = normal[0], r->wy[x] = normal[1], r->wz[x] = normal[2];
    put_more(f, p->id, &at, pixel);
}

static void put_more_of_row(const dp_fill *f, const dp_fill_row *r, size_t pixel) {
    for (uint64_t bits = r->mask & ~r->odd; bits; bits &= bits - 1) {
        const uint32_t x = (uint32_t)__builtin_ctzll(bits);
        const weights at = {{r->first[x], r->first[x] + 1, r->first[x] + 2},
                            {r->weight[0][x], r->weight[1][x], r->weight[2][x]}};
        put_more(f, f->w->polygons[r->polygon[x]].id, &at, pixel + x);
    }
}

/* ------- rows ------- */

static uint16_t id_of(const dp_polygons *polygons, uint32_t polygon) {
    const uint16_t group = polygons->groups[polygon];
    return group < UINT16_MAX ? (uint16_t)(1 + group) : UINT16_MAX;
}

/* Writes groups, and polygons if asked for. */
static void put_ids(const dp_fill *f, const dp_fill_row *r, uint32_t x0, uint32_t n, size_t pixel) {
    const dp_polygons *const polygons = &f->w->frame->polygons;
    const dp_gbuffer *const g = f->g;
    uint16_t *const id = g->id + pixel;
    if (polygons->groups)
        for (uint32_t i = 0; i < n; i++)
            id[i] = r->mask >> (x0 + i) & 1 ? id_of(polygons, r->id[x0 + i]) : 0;
    else
        for (uint32_t i = 0; i < n; i++) id[i] = (uint16_t)r->in[x0 + i];
    if (!g->polygon) return;
    for (uint64_t bits = r->mask; bits; bits &= bits - 1) {
        const uint32_t x = (uint32_t)__builtin_ctzll(bits);
        g->polygon[pixel - x0 + x] = r->id[x];
    }
}

/* After `finish`: writes a mixed pixel's share and the distance of the rest. If most of it is
 * paper, it becomes a partial pixel. */
static void share_pixel(const dp_fill *f, float other, uint8_t share, size_t pixel) {
    dp_gbuffer *const g = f->g;
    const bool paper = other <= DP_DEPTH_EMPTY;
    g->share[pixel] = share;
    g->other[pixel] = paper ? DP_FAR : (float)dp_distance(&f->w->frame->view, other);
    if (share >= 128 || !paper) return;
    g->other[pixel] = g->distance[pixel]; /* partial pixel */
    g->distance[pixel] = DP_FAR;
    g->depth[pixel] = dp_gbuffer_empty_depth(g->perspective);
}

static void fill_background(dp_gbuffer *g, size_t pixel, uint32_t n) {
    const float empty = dp_gbuffer_empty_depth(g->perspective);
    float *const distance = g->distance + pixel, *const depth = g->depth + pixel;
    for (uint32_t i = 0; i < n; i++) distance[i] = DP_FAR;
    for (uint32_t i = 0; i < n; i++) depth[i] = empty;
    memset(g->id + pixel, 0, n * sizeof *g->id);
    memset(g->nx + pixel, 0, n * sizeof(float));
    memset(g->ny + pixel, 0, n * sizeof(float));
    memset(g->nz + pixel, 0, n * sizeof(float));
}

static size_t row_place(const dp_fill *f, uint32_t y) {
    return (size_t)(f->w->tile_y + y) * f->g->stride + f->w->tile_x;
}

/* Finds what each pixel of row y shows; writes background where that is nothing. */
static void begin_row(const dp_fill *f, uint32_t y, uint32_t width, dp_fill_row *r) {
    const size_t row = row_place(f, y);
    r->y = y, r->x0 = r->x1 = 0;
    if (f->w->frame->target.samples == 4)
        f->g->fillers->pick(f, r);
    else
        pick_row(f, r);
    r->mask &= ~(uint64_t)0 >> (64 - width);
    if (!r->mask) {
        fill_background(f->g, row, width);
        return;
    }
    r->x0 = (uint32_t)__builtin_ctzll(r->mask) / DP_GBUFFER_STRIP * DP_GBUFFER_STRIP;
    r->x1 = (63 - (uint32_t)__builtin_clzll(r->mask)) / DP_GBUFFER_STRIP * DP_GBUFFER_STRIP +
            DP_GBUFFER_STRIP;
    if (r->x0) fill_background(f->g, row, r->x0);
    if (r->x1 < width) fill_background(f->g, row + r->x1, width - r->x1);
    for (uint64_t bits = r->mixed & r->mask; bits; bits &= bits - 1)
        put_part(f, (uint32_t)__builtin_ctzll(bits), r);
    f->g->fillers->find(f, r);
}

/* Writes the mixed pixels' shares; returns the pixels that are shared. */
static uint64_t share_pixels(const dp_fill *f, const dp_fill_row *r, size_t row) {
    uint64_t shared = 0;
    for (uint64_t bits = r->mixed & r->mask; bits; bits &= bits - 1) {
        const uint32_t x = (uint32_t)__builtin_ctzll(bits);
        if (r->share[x] == 255) continue;
        shared |= (uint64_t)1 << x;
        share_pixel(f, r->other[x], r->share[x], row + x);
    }
    return shared;
}

static void end_row(const dp_fill *f, dp_fill_row *r) {
    dp_gbuffer *const g = f->g;
    const size_t row = row_place(f, r->y), at = (size_t)f->w->index * DP_TILE + r->y;
    if (!r->mask) return;
    g->fillers->collect(f, r);
    for (uint64_t bits = f->weighted ? r->odd : 0; bits; bits &= bits - 1) {
        const uint32_t x = (uint32_t)__builtin_ctzll(bits);
        collect_odd(f, x, row + x, r);
    }
    g->fillers->finish(f, r, row);
    put_ids(f, r, r->x0, r->x1 - r->x0, row + r->x0);
    g->mask[at] = r->mask;
    g->shared[at] = share_pixels(f, r, row);
    if (g->textured || g->colored) put_more_of_row(f, r, row);
}

/* Rows are begun two rows ahead: polygons, corners and normals come from memory, one after the
 * other, and waiting for them would take most of the time. */
static void fill_rows(const dp_fill *f, uint32_t width, uint32_t height) {
    enum { AHEAD = 2, KEPT = AHEAD + 1 };
    dp_fill_row rows[KEPT];
    memset(rows, 0, sizeof rows); /* unused lanes must be numbers too */
    for (uint32_t y = 0; y < height + AHEAD; y++) {
        if (y < height) begin_row(f, y, width, &rows[y % KEPT]);
        if (y > 0 && y <= height && !f->facets) f->g->fillers->touch(f, &rows[(y - 1) % KEPT]);
        if (y >= AHEAD) end_row(f, &rows[(y - AHEAD) % KEPT]);
    }
}

void dp_gbuffer_clear(dp_gbuffer *g, uint32_t tile) {
    const uint32_t tile_x = tile % g->tiles_x * DP_TILE, tile_y = tile / g->tiles_x * DP_TILE;
    const uint32_t width = g->width - tile_x < DP_TILE ? g->width - tile_x : DP_TILE;
    const size_t first = (size_t)tile * DP_TILE;
    memset(g->mask + first, 0, DP_TILE * sizeof *g->mask);
    memset(g->shared + first, 0, DP_TILE * sizeof *g->shared);
    if (g->clean[tile]) return; /* background is written already */
    for (uint32_t y = tile_y; y < tile_y + DP_TILE && y < g->height; y++)
        fill_background(g, (size_t)y * g->stride + tile_x, width);
    g->clean[tile] = 1; /* the margin beside it is not written yet */
}

void dp_gbuffer_fill(dp_gbuffer *g, const dp_tile *w, dp_normals normals) {
    uint64_t *const mask = g->mask + (size_t)w->index * DP_TILE;
    const uint32_t width = g->width - w->tile_x < DP_TILE ? g->width - w->tile_x : DP_TILE;
    const uint32_t height = g->height - w->tile_y < DP_TILE ? g->height - w->tile_y : DP_TILE;
    const bool facets = normals == DP_NORMALS_FACET || !g->normals;
    const dp_fill f = {.g = g,
                       .w = w,
                       .facets = facets,
                       .weighted = !facets || g->textured || g->colored,
                       .step = (float)(1 / w->frame->view.focal)};
    if (w->frame->tile_pieces[w->index].empty) {
        dp_gbuffer_clear(g, w->index);
        return;
    }
    memset(mask, 0, DP_TILE * sizeof *mask);
    memset(g->shared + (size_t)w->index * DP_TILE, 0, DP_TILE * sizeof *mask);
    fill_rows(&f, width, height);
    g->clean[w->index] = 0;
}
