/* A chunk's triangles placed on the screen and sifted, before anything is binned.
 *
 * In a model larger than memory nearly all triangles are far below a sample: what they cost is decided
 * here. Equal positions are found first (a bare soup names each vertex six times), so that each is
 * transformed once and an edge is a pair of small numbers. Then a triangle is dropped that lies
 * outside the picture, or well behind what is already known of the surface; and one whose box holds no
 * sample point covers nothing, but may still have edges.
 *
 * Data structure: open addressing over the bits of positions. Invariant: at most half of the slots are
 * used; vertices are numbered in order of first use. Not handled here: clipping (triangles that reach
 * beyond the guarded frustum count as covering samples and go through the ordinary stages). */
#include "stream/chunk.h"

#include <string.h>

/* Lines and samples are looked for this far outside the picture (px), as bins are widened. */
static const float MARGIN = 2;
/* A triangle hides behind the surface when it lies this much further in the blocks around it (pixel
 * sizes), as in cull.c. */
static const double SLACK = 6;
/* Rounding of places on the screen, px. */
static const float ROUNDING = 1.0f / 512;

static uint32_t hash_of(const uint32_t bits[3]) {
    const uint64_t h = ((uint64_t)bits[0] * 0x9e3779b97f4a7c15u) ^ ((uint64_t)bits[1] * 0xc2b2ae3d27d4eb4fu) ^
                       ((uint64_t)bits[2] * 0x165667b19e3779f9u);
    return (uint32_t)((h * 0xff51afd7ed558ccdu) >> 40);
}

/* The number of the vertex at p. */
static uint16_t find_vertex(dp_chunk *chunk, const float p[3]) {
    uint32_t bits[3];
    memcpy(bits, p, sizeof bits);
    for (uint32_t s = hash_of(bits) & (DP_CHUNK_SLOTS - 1);; s = (s + 1) & (DP_CHUNK_SLOTS - 1)) {
        const uint16_t found = chunk->slots[s];
        if (!found) {
            chunk->slots[s] = (uint16_t)(chunk->vertex_count + 1);
            memcpy(chunk->position[chunk->vertex_count], p, sizeof bits);
            return (uint16_t)chunk->vertex_count++;
        }
        if (!memcmp(chunk->position[found - 1], bits, sizeof bits)) return (uint16_t)(found - 1);
    }
}

static void place_vertex(dp_chunk *chunk, uint32_t v, const dp_view *view) {
    const dp_clip_point c = dp_to_clip(view, dp_v3f(chunk->position[v]));
    chunk->outcode[v] = (uint8_t)(isfinite(c.x + c.y + c.z + c.w) ? dp_outcode(view, c) : DP_NOT_FINITE);
    if (chunk->outcode[v]) {
        chunk->screen[v] = (dp_point){NAN, 0, 0};
        return;
    }
    const dp_pointd s = dp_to_screen(view, c);
    chunk->screen[v] = (dp_point){(float)s.x, (float)s.y, (float)s.d};
}

void dp_chunk_place(dp_chunk *chunk, const dp_triangles *triangles, const dp_view *view) {
    memset(chunk->slots, 0, sizeof chunk->slots);
    chunk->count = triangles->count;
    chunk->vertex_count = 0;
    const uint8_t *from = triangles->corners;
    for (uint32_t t = 0; t < triangles->count; t++, from += triangles->stride) {
        float p[9];
        memcpy(p, from, sizeof p);
        for (int i = 0; i < 9; i++) p[i] += 0.0f; /* -0 is 0 */
        for (int i = 0; i < 3; i++) chunk->corner[3 * t + (uint32_t)i] = find_vertex(chunk, p + 3 * i);
    }
    for (uint32_t v = 0; v < chunk->vertex_count; v++) place_vertex(chunk, v, view);
}

/* ------- facing ------- */

/* In double precision, for triangles that are thin or seen nearly edge-on. */
static bool slow_facing(const dp_view *view, dp_vec3 a, dp_vec3 b, dp_vec3 c, float normal[4], uint8_t *state) {
    const dp_vec3 u = dp_sub(b, a), v = dp_sub(c, a), n = dp_cross(u, v);
    const double size = dp_max(dp_dot(u, u), dp_dot(v, v));
    if (dp_length(n) <= 1e-12 * size) return false; /* as dp_polygon_has_no_area */
    const dp_vec3 unit = dp_unit(n);
    const double sine = dp_dot(unit, dp_view_vector(view, a));
    *state = sine < -1e-6 ? DP_TRIANGLE_FRONT : sine > 1e-6 ? DP_TRIANGLE_BACK : 0;
    normal[0] = (float)unit.x, normal[1] = (float)unit.y, normal[2] = (float)unit.z, normal[3] = 1;
    return true;
}

bool dp_triangle_facing(const dp_view *view, const float *a, const float *b, const float *c, float normal[4],
                        uint8_t *state) {
    const float ux = b[0] - a[0], uy = b[1] - a[1], uz = b[2] - a[2];
    const float vx = c[0] - a[0], vy = c[1] - a[1], vz = c[2] - a[2];
    const float nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
    const float n2 = nx * nx + ny * ny + nz * nz, u2 = ux * ux + uy * uy + uz * uz, v2 = vx * vx + vy * vy + vz * vz;
    const float ex = view->perspective ? a[0] - (float)view->eye.x : (float)view->forward.x;
    const float ey = view->perspective ? a[1] - (float)view->eye.y : (float)view->forward.y;
    const float ez = view->perspective ? a[2] - (float)view->eye.z : (float)view->forward.z;
    const float along = nx * ex + ny * ey + nz * ez, e2 = ex * ex + ey * ey + ez * ez;
    if (!(n2 > 1e-6f * u2 * v2) || !(n2 > FLT_MIN) || !(along * along > 1e-6f * n2 * e2) || !isfinite(n2 * e2))
        return slow_facing(view, dp_v3f(a), dp_v3f(b), dp_v3f(c), normal, state);
    normal[0] = nx, normal[1] = ny, normal[2] = nz, normal[3] = n2;
    *state = along < 0 ? DP_TRIANGLE_FRONT : DP_TRIANGLE_BACK;
    return true;
}

bool dp_edge_is_plain(uint8_t state_a, const float normal_a[4], uint8_t state_b, const float normal_b[4],
                      float flat_cosine) {
    const uint8_t both = state_a & state_b;
    if (both & DP_TRIANGLE_BACK) return true;
    if (!(both & DP_TRIANGLE_FRONT) || flat_cosine > 1) return false;
    if (flat_cosine < 0) return true;
    const float dot = normal_a[0] * normal_b[0] + normal_a[1] * normal_b[1] + normal_a[2] * normal_b[2];
    return dot > 0 && dot * dot > flat_cosine * flat_cosine * (normal_a[3] * normal_b[3]);
}

/* ------- sifting ------- */

typedef struct box {
    float x0, y0, x1, y1; /* px */
    float nearest;        /* d */
} box;

static box box_of(dp_point a, dp_point b, dp_point c) {
    return (box){dp_minf(a.x, dp_minf(b.x, c.x)), dp_minf(a.y, dp_minf(b.y, c.y)),
                 dp_maxf(a.x, dp_maxf(b.x, c.x)), dp_maxf(a.y, dp_maxf(b.y, c.y)),
                 dp_maxf(a.d, dp_maxf(b.d, c.d))};
}

static bool is_outside(const box *b, const dp_view *view) {
    return b->x1 < -MARGIN || b->y1 < -MARGIN || b->x0 > (float)view->width + MARGIN ||
           b->y0 > (float)view->height + MARGIN;
}

/* Well behind the surface in every block around it. */
static bool is_hidden(const box *b, const dp_chunk_view *v) {
    const float x0 = b->x0 - 1, y0 = b->y0 - 1, x1 = b->x1 + 1, y1 = b->y1 + 1;
    if (!(x0 >= 0 && y0 >= 0 && x1 < (float)(v->tiles_x * DP_TILE) && y1 < (float)(v->tiles_y * DP_TILE))) return false;
    const uint32_t bx0 = (uint32_t)x0 / DP_BLOCK, bx1 = (uint32_t)x1 / DP_BLOCK;
    const uint32_t by0 = (uint32_t)y0 / DP_BLOCK, by1 = (uint32_t)y1 / DP_BLOCK;
    if (bx1 - bx0 > 16 || by1 - by0 > 16) return false;
    const float nearest = b->nearest + (float)fabs(dp_depth_step(v->view, b->nearest, SLACK));
    for (uint32_t by = by0; by <= by1; by++)
        for (uint32_t bx = bx0; bx <= bx1; bx++) {
            const size_t tile = (size_t)(by / DP_BLOCKS) * v->tiles_x + bx / DP_BLOCKS;
            const size_t block = (size_t)(by % DP_BLOCKS) * DP_BLOCKS + bx % DP_BLOCKS;
            if (!(nearest < v->farthest[tile * DP_BLOCKS * DP_BLOCKS + block])) return false;
        }
    return true;
}

bool dp_triangle_is_hidden(const dp_chunk_view *view, const float *a, const float *b, const float *c) {
    const float *const corners[3] = {a, b, c};
    dp_point at[3];
    for (int i = 0; i < 3; i++) {
        const dp_clip_point p = dp_to_clip(view->view, dp_v3f(corners[i]));
        if (!isfinite(p.x + p.y + p.z + p.w) || dp_outcode(view->view, p)) return false;
        const dp_pointd s = dp_to_screen(view->view, p);
        at[i] = (dp_point){(float)s.x, (float)s.y, (float)s.d};
    }
    const box b0 = box_of(at[0], at[1], at[2]);
    return is_hidden(&b0, view);
}

/* Does the box hold a sample point? Also true for boxes of more than two pixels' side. */
static bool holds_sample(const box *b, const dp_sampling *s) {
    const float x0 = b->x0 - ROUNDING, y0 = b->y0 - ROUNDING, x1 = b->x1 + ROUNDING, y1 = b->y1 + ROUNDING;
    const float px0 = floorf(x0), py0 = floorf(y0), px1 = floorf(x1), py1 = floorf(y1);
    if (px1 - px0 > 1 || py1 - py0 > 1) return true;
    const bool single = s->samples == 1;
    for (float py = py0; py <= py1; py++)
        for (float px = px0; px <= px1; px++)
            for (uint32_t i = 0; i < s->vectors; i++) {
                const dp_f4 half = dp_splat(0.5f);
                const dp_f4 x = dp_splat(px) + (single ? half : s->x[i]), y = dp_splat(py) + (single ? half : s->y[i]);
                if (dp_any((x >= dp_splat(x0)) & (x <= dp_splat(x1)) & (y >= dp_splat(y0)) & (y <= dp_splat(y1)))) return true;
            }
    return false;
}

/* Does the box touch one of the pixels? */
static bool holds_pixel(const box *b, const dp_chunk_view *v, const uint64_t *pixels) {
    const float w = (float)(v->tiles_x * DP_TILE - 1), h = (float)(v->tiles_y * DP_TILE - 1);
    const uint32_t x0 = (uint32_t)dp_minf(dp_maxf(b->x0 - ROUNDING, 0), w), x1 = (uint32_t)dp_minf(dp_maxf(b->x1 + ROUNDING, 0), w);
    const uint32_t y0 = (uint32_t)dp_minf(dp_maxf(b->y0 - ROUNDING, 0), h), y1 = (uint32_t)dp_minf(dp_maxf(b->y1 + ROUNDING, 0), h);
    for (uint32_t y = y0; y <= y1; y++)
        for (uint32_t tile = x0 / DP_TILE; tile <= x1 / DP_TILE; tile++) {
            const uint64_t row = pixels[((size_t)(y / DP_TILE) * v->tiles_x + tile) * DP_TILE + y % DP_TILE];
            const uint32_t from = tile == x0 / DP_TILE ? x0 % DP_TILE : 0;
            const uint32_t to = tile == x1 / DP_TILE ? x1 % DP_TILE : DP_TILE - 1;
            if (row >> from & (~(uint64_t)0 >> (63 - (to - from)))) return true;
        }
    return false;
}

uint32_t dp_chunk_pixel(const dp_chunk *chunk, uint32_t t, const dp_chunk_view *view) {
    const dp_point a = chunk->screen[chunk->corner[3 * t]], b = chunk->screen[chunk->corner[3 * t + 1]];
    const dp_point c = chunk->screen[chunk->corner[3 * t + 2]];
    const box at = box_of(a, b, c);
    const uint32_t x = (uint32_t)dp_minf(dp_maxf(at.x0, 0), (float)(view->tiles_x * DP_TILE - 1)); /* NaN gives 0 */
    const uint32_t y = (uint32_t)dp_minf(dp_maxf(at.y0, 0), (float)(view->tiles_y * DP_TILE - 1));
    return ((y / DP_TILE * view->tiles_x + x / DP_TILE) * DP_TILE + y % DP_TILE) * DP_TILE + x % DP_TILE;
}

void dp_chunk_sift(dp_chunk *chunk, const dp_chunk_view *view, dp_stats *stats) {
    for (uint32_t t = 0; t < chunk->count; t++) {
        const uint16_t a = chunk->corner[3 * t], b = chunk->corner[3 * t + 1], c = chunk->corner[3 * t + 2];
        const int any = chunk->outcode[a] | chunk->outcode[b] | chunk->outcode[c];
        chunk->state[t] = 0;
        if (any & DP_NOT_FINITE) {
            stats->dropped_finite++;
            continue;
        }
        if (chunk->outcode[a] & chunk->outcode[b] & chunk->outcode[c]) continue;
        const box at = box_of(chunk->screen[a], chunk->screen[b], chunk->screen[c]);
        if (!any && is_outside(&at, view->view)) continue;
        if (view->wanted) { /* few pixels are: this is the sieve that counts then */
            const uint8_t state = (any || holds_pixel(&at, view, view->wanted) ? DP_TRIANGLE_COVERS : 0) |
                                  (any || holds_pixel(&at, view, view->crowded) ? DP_TRIANGLE_CROWD : 0);
            if (state && (any || !is_hidden(&at, view))) chunk->state[t] = state;
            continue;
        }
        if (!any && is_hidden(&at, view)) continue;
        uint8_t facing;
        if (!dp_triangle_facing(view->view, chunk->position[a], chunk->position[b], chunk->position[c], chunk->normal[t], &facing)) {
            stats->dropped_area++;
            continue;
        }
        chunk->state[t] = facing | DP_TRIANGLE_LIVE;
        if (any || holds_sample(&at, &view->sampling)) chunk->state[t] |= DP_TRIANGLE_COVERS;
    }
}

/* ------- edges ------- */

static uint32_t edge_slot(uint32_t ends) { return (ends * 0x9e3779b1u) >> 8 & (DP_CHUNK_SLOTS - 1); }

static void meet(dp_chunk *chunk, dp_chunk_edge *e, uint32_t t, uint32_t edge, bool ascending) {
    if (e->met == 1 && ascending != e->ascending) {
        e->b = (uint16_t)t, e->edge_b = (uint8_t)edge, e->met = 2;
        return;
    }
    if (e->met < 3) { /* a fan: the whole picture must decide */
        chunk->lines[e->a] |= (uint8_t)(1u << e->edge_a);
        if (e->met == 2) chunk->lines[e->b] |= (uint8_t)(1u << e->edge_b);
        e->met = 3;
    }
    chunk->lines[t] |= (uint8_t)(1u << edge);
}

static void add_edge(dp_chunk *chunk, uint32_t t, uint32_t edge) {
    const uint32_t a = chunk->corner[3 * t + edge], b = chunk->corner[3 * t + (edge + 1) % 3];
    if (a == b) return;
    const bool ascending = a < b;
    const uint32_t ends = ascending ? a << 16 | b : b << 16 | a;
    for (uint32_t s = edge_slot(ends);; s = (s + 1) & (DP_CHUNK_SLOTS - 1)) {
        const uint16_t found = chunk->slots[s];
        if (!found) {
            chunk->edges[chunk->edge_count] = (dp_chunk_edge){ends, (uint16_t)t, 0, (uint8_t)edge, 0, ascending, 1};
            chunk->slots[s] = (uint16_t)++chunk->edge_count;
            return;
        }
        if (chunk->edges[found - 1].ends != ends) continue;
        meet(chunk, &chunk->edges[found - 1], t, edge, ascending);
        return;
    }
}

/* An edge that lies outside the picture is no line. */
static bool may_be_seen(const dp_chunk *chunk, uint32_t ends, const dp_view *view) {
    const dp_point a = chunk->screen[ends >> 16], b = chunk->screen[ends & 0xffff];
    if (isnan(a.x) || isnan(b.x)) return true;
    const box at = box_of(a, b, b);
    return !is_outside(&at, view);
}

void dp_chunk_edges(dp_chunk *chunk, const dp_triangles *triangles, const dp_chunk_view *view) {
    memset(chunk->slots, 0, sizeof chunk->slots);
    memset(chunk->lines, 0, chunk->count);
    memset(chunk->alone, 0, chunk->count);
    chunk->edge_count = 0;
    for (uint32_t t = 0; t < chunk->count; t++) {
        const uint32_t flags = triangles->flags ? triangles->flags[t] : 7;
        if (!(chunk->state[t] & DP_TRIANGLE_LIVE)) continue;
        for (uint32_t e = 0; e < 3; e++)
            if (flags >> e & 1) add_edge(chunk, t, e);
    }
    for (uint32_t i = 0; i < chunk->edge_count; i++) {
        const dp_chunk_edge *const e = &chunk->edges[i];
        if (e->met == 2) {
            if (dp_edge_is_plain(chunk->state[e->a], chunk->normal[e->a], chunk->state[e->b], chunk->normal[e->b], view->flat_cosine)) continue;
            chunk->lines[e->a] |= (uint8_t)(1u << e->edge_a);
            chunk->lines[e->b] |= (uint8_t)(1u << e->edge_b);
        } else if (e->met == 1 && may_be_seen(chunk, e->ends, view->view)) {
            chunk->alone[e->a] |= (uint8_t)(1u << e->edge_a);
        }
    }
}
