/* The G-buffer's planes: memory, background, margin, the range of distances.
 *
 * All planes lie in one block, each (tiles' width + 2 margins) x (height + 2 margins). Rows are
 * padded to 16 floats, as tiles are filled in whole vectors. */
#include "gbuffer/gbuffer.h"

#include "gbuffer/detect.h"
#include "gbuffer/fill.h"
#include "base/kernels.h"

#include <string.h>

static const dp_array arrays[] = {DP_ARRAY(dp_gbuffer, block, block_cap),
                                  DP_ARRAY(dp_gbuffer, mask, mask_cap),
                                  DP_ARRAY(dp_gbuffer, clean, clean_cap)};

void dp_gbuffer_free(dp_gbuffer *g, const dp_allocator *memory) {
    dp_arrays_free(memory, g, DP_ARRAYS(arrays));
    *g = (dp_gbuffer){0};
}

uint64_t dp_gbuffer_bytes(const dp_gbuffer *g) { return dp_arrays_bytes(g, DP_ARRAYS(arrays)); }

/* Planes of four bytes per pixel. */
static size_t wide_planes(const dp_gbuffer *g) {
    return (g->textured ? 8u : 6u) + (g->colored ? 1u : 0u);
}

static bool reserve(dp_gbuffer *g, const dp_frame *frame, size_t plane, size_t tiles) {
    const size_t bytes = dp_times(plane, wide_planes(g) * sizeof(float) + sizeof(uint16_t) + 1);
    return dp_reserve(frame->memory, &g->block, &g->block_cap, bytes, 1) &&
           dp_reserve(frame->memory, &g->mask, &g->mask_cap, 2 * tiles * DP_TILE,
                      sizeof *g->mask) &&
           dp_reserve(frame->memory, &g->clean, &g->clean_cap, tiles, 1);
}

static void place_planes(dp_gbuffer *g, size_t plane) {
    const size_t origin = DP_GBUFFER_MARGIN * g->stride + DP_GBUFFER_MARGIN;
    float **const planes[] = {&g->nx,    &g->ny,    &g->nz, &g->distance,
                              &g->depth, &g->other, &g->u,  &g->v};
    const size_t floats = g->textured ? 8 : 6;
    for (size_t i = 0; i < 8; i++)
        *planes[i] = i < floats ? (float *)(void *)g->block + i * plane + origin : NULL;
    g->color = g->colored ? (uint32_t *)(void *)g->block + floats * plane + origin : NULL;
    uint16_t *const ids = (uint16_t *)(void *)((float *)(void *)g->block + wide_planes(g) * plane);
    g->id = ids + origin;
    g->share = (uint8_t *)(ids + plane) + origin;
}

/* Camera space is that of the view matrix, without scale. */
void dp_gbuffer_take_camera(dp_gbuffer *g, const dp_view *view) {
    const double w = 1, d = view->perspective ? 1 / w : -w; /* at distance 1 */
    const dp_vec3 o = dp_unproject(view, (dp_pointd){0, 0, d});
    const dp_vec3 x = dp_sub(dp_unproject(view, (dp_pointd){1, 0, d}), o);
    const dp_vec3 y = dp_sub(dp_unproject(view, (dp_pointd){0, 1, d}), o);
    const dp_vec3 right = dp_unit(x), back = dp_scale(view->forward, -1),
                  up = dp_scale(dp_unit(y), -1);
    const dp_vec3 rows[3] = {right, up, back};
    for (int r = 0; r < 3; r++)
        g->rotation[r][0] = rows[r].x, g->rotation[r][1] = rows[r].y, g->rotation[r][2] = rows[r].z;
    const dp_vec3 axis = dp_sub(dp_mad(view->eye, view->forward, w), o);
    g->perspective = view->perspective;
    g->eye = view->eye;
    g->fx = (float)(1 / dp_length(x)), g->fy = (float)(1 / dp_length(y));
    g->cx = (float)(dp_dot(axis, right) / dp_length(x)),
    g->cy = (float)(-dp_dot(axis, up) / dp_length(y));
}

bool dp_gbuffer_begin(dp_gbuffer *g, const dp_frame *frame, bool textured, bool colored) {
    const uint32_t width = frame->target.width, height = frame->target.height;
    const bool same = g->block && g->width == width && g->height == height &&
                      g->textured == textured && g->colored == colored &&
                      g->perspective == frame->view.perspective;
    dp_gbuffer_take_camera(g, &frame->view);
    g->normals = NULL;
    g->detectors = dp_detectors_for(dp_lanes_best());
    g->fillers = dp_fillers_for(dp_lanes_best());
    if (same) return true;
    g->width = width, g->height = height, g->textured = textured, g->colored = colored;
    g->tiles_x = frame->tiles_x, g->tiles_y = frame->tiles_y;
    g->stride = ((size_t)g->tiles_x * DP_TILE + 2 * DP_GBUFFER_MARGIN + 15) / 16 * 16;
    const size_t plane = g->stride * ((size_t)height + 2 * DP_GBUFFER_MARGIN);
    const size_t tiles = (size_t)g->tiles_x * g->tiles_y;
    if (!reserve(g, frame, plane, tiles)) {
        g->width = 0; /* the planes are not valid any more */
        return false;
    }
    place_planes(g, plane);
    g->shared = g->mask + tiles * DP_TILE;
    memset(g->clean, 0, tiles);
    return true;
}

/* Repeats the picture's border beside one tile of one plane: its rows to the left and right, then
 * the rows so extended above and below. */
static void pad_tile(const dp_gbuffer *g, uint32_t tile, void *plane_at, size_t size) {
    const uint32_t tx = tile % g->tiles_x, ty = tile / g->tiles_x;
    const bool left = tx == 0, right = tx == g->tiles_x - 1, top = ty == 0,
               bottom = ty == g->tiles_y - 1;
    const size_t x0 = (size_t)tx * DP_TILE, x1 = right ? g->width : x0 + DP_TILE;
    const size_t y0 = (size_t)ty * DP_TILE, y1 = bottom ? g->height : y0 + DP_TILE;
    for (size_t y = y0; y < y1; y++) {
        char *const row = (char *)plane_at + y * g->stride * size;
        for (size_t i = 1; left && i <= DP_GBUFFER_MARGIN; i++) memcpy(row - i * size, row, size);
        for (size_t i = 0; right && i < DP_GBUFFER_MARGIN; i++)
            memcpy(row + (x1 + i) * size, row + (x1 - 1) * size, size);
    }
    char *const first = (char *)plane_at + y0 * g->stride * size + x0 * size -
                        (left ? DP_GBUFFER_MARGIN * size : 0);
    char *const last = first + (y1 - 1 - y0) * g->stride * size;
    const size_t row =
        (x1 - x0 + (left ? DP_GBUFFER_MARGIN : 0) + (right ? DP_GBUFFER_MARGIN : 0)) * size;
    for (size_t i = 1; i <= DP_GBUFFER_MARGIN; i++) {
        if (top) memcpy(first - i * g->stride * size, first, row);
        if (bottom) memcpy(last + i * g->stride * size, last, row);
    }
}

void dp_gbuffer_pad(dp_gbuffer *g) {
    for (uint32_t tile = 0; tile < g->tiles_x * g->tiles_y; tile++) {
        const uint32_t tx = tile % g->tiles_x, ty = tile / g->tiles_x;
        const bool inside = tx > 0 && ty > 0 && tx < g->tiles_x - 1 && ty < g->tiles_y - 1;
        if (inside || g->clean[tile] == 2) continue;
        float *const planes[] = {g->nx, g->ny, g->nz, g->distance, g->depth};
        for (size_t i = 0; i < sizeof planes / sizeof *planes; i++)
            pad_tile(g, tile, planes[i], sizeof(float));
        pad_tile(g, tile, g->id, sizeof(uint16_t));
        if (g->clean[tile]) g->clean[tile] = 2;
    }
}

/* ------- the range of distances ------- */

typedef struct range {
    float least, most;
} range;

static void extend(range *r, const dp_frame *frame, uint32_t vertex) {
    const dp_vertex v = frame->vertices[vertex];
    if (v.x != v.x) return; /* NaN: to be clipped, or not finite */
    const float z = (float)dp_distance(&frame->view, v.d);
    r->least = dp_minf(z, r->least), r->most = dp_maxf(z, r->most);
}

void dp_gbuffer_fit_range(dp_gbuffer *g, const dp_frame *frame, const uint8_t *enhanced,
                          uint32_t enhanced_count) {
    const dp_polygons *const p = &frame->polygons;
    range r = {DP_FAR, -DP_FAR};
    if (!enhanced) {
        for (uint32_t v = 0; v < p->vertex_count; v++) extend(&r, frame, v);
    } else {
        for (uint32_t i = 0; i < p->count; i++) {
            const uint32_t group = p->groups ? p->groups[i] : 0;
            if (group >= enhanced_count || !enhanced[group]) continue;
            const uint32_t first = dp_first_corner(p, i), n = dp_corner_count(p, i);
            for (uint32_t c = 0; c < n; c++) {
                const uint32_t v = dp_corner_vertex(p, first + c);
                if (v < p->vertex_count) extend(&r, frame, v);
            }
        }
    }
    g->near_z = r.least <= r.most ? r.least : 0;
    g->far_z = r.most > r.least ? r.most : g->near_z + 1;
}
