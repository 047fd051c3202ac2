/* The edge map (Nienhaus and Döllner 2003, 4.1.2).
 *
 *     I_N, I_Z  = detector (detect.h)
 *     strength  = as printed: 1 - I;  else: clamp((1 - I - threshold) / softness)
 *     profile   = 1 where groups meet                     beyond the paper
 *     strength  = 0 for groups that are not enhanced
 */
#include "gbuffer/edge_map.h"

#include "base/elementary.h"

#include <string.h>

static dp_rows rows_of(const float *plane, size_t at, size_t stride, int radius) {
    const float *const p = plane + at;
    const size_t step = stride * (size_t)radius;
    return (dp_rows){p - step, p, p + step};
}

static dp_depth_measure measure_of(const dp_gbuffer *g, const dp_edge_map *map) {
    if (map->as_printed)
        return (dp_depth_measure){.scale = 1 / (g->far_z - g->near_z), .both_sides = true};
    return (dp_depth_measure){.scale = g->fy / map->profile_depth,
                              .perspective = g->perspective,
                              .both_sides = map->far_side};
}

/* The C1 operator. Along a straight step three of eight neighbours lie beyond it, and their weights
 * add up to 1/2: by default, twice the sum is a whole step. */
static void detect_c1(const dp_gbuffer *g, const dp_edge_map *map, dp_rows z, uint32_t x0,
                      uint32_t y, uint32_t n, float *i_z) {
    const dp_depth_measure m = measure_of(g, map);
    const size_t at = (size_t)y * g->stride + x0;
    const dp_rays rays = {g->perspective, g->cx, g->cy, g->fx, g->fy};
    const int radius = (int)map->radius;
    float slope[DP_TILE];
    memset(i_z, 0, n * sizeof *i_z);
    if (!map->as_printed) {
        g->detectors->c1_slope(&rays, g->nx + at, g->ny + at, g->nz + at, x0, y, n, slope);
        for (uint32_t i = 0; i < n; i++) slope[i] *= 2 * (float)radius / map->profile_depth;
    }
    for (int pass = 0; pass < (int)map->c1_passes; pass++) {
        if (map->as_printed)
            g->detectors->c1_printed(z, &m, pass, radius, n, i_z);
        else
            g->detectors->c1_scaled(z, slope, &m, pass, radius, n, i_z);
    }
    const float whole = map->as_printed ? 1 : 2;
    for (uint32_t i = 0; i < n; i++) i_z[i] = 1 - dp_minf(whole * i_z[i], 1);
}

/* Does a neighbour of another group lie behind, or level with a smaller number? So that only one
 * side has the edge. */
static bool meets_group(const dp_gbuffer *g, const dp_edge_map *map, size_t at) {
    const size_t r = map->radius, down = r * g->stride;
    const size_t neighbours[4] = {at - down - r, at - down + r, at + down - r, at + down + r};
    const float z = g->distance[at], px = (g->perspective ? z : 1) / g->fy * map->profile_depth;
    for (int k = 0; k < 4; k++) {
        const size_t other = neighbours[k];
        if (g->id[other] == g->id[at]) continue;
        const float behind = g->distance[other] - z;
        if (map->far_side || behind > px || (behind > -px && g->id[other] < g->id[at])) return true;
    }
    return false;
}

static void add_groups(const dp_gbuffer *g, const dp_edge_map *map, size_t at, dp_edge_run *out) {
    for (uint64_t bits = out->meeting; bits; bits &= bits - 1) {
        const uint32_t i = (uint32_t)__builtin_ctzll(bits);
        if (!meets_group(g, map, at + i)) continue;
        out->profile[i] = 1;
        out->strong |= (uint64_t)1 << i;
    }
}

/* Drops the edges of groups that are not enhanced. */
static void drop_others(const dp_gbuffer *g, const dp_edge_map *map, size_t at, dp_edge_run *out) {
    for (uint64_t bits = out->strong; bits; bits &= bits - 1) {
        const uint32_t i = (uint32_t)__builtin_ctzll(bits);
        const uint16_t id = g->id[at + i];
        if (id <= map->enhanced_count && map->enhanced[id - 1]) continue;
        out->inner[i] = out->profile[i] = 0;
        out->strong &= ~((uint64_t)1 << i);
    }
}

/* As printed, a strength is 1 - I. */
static dp_threshold threshold_of(const dp_edge_map *map, float at, float softness) {
    return map->as_printed ? (dp_threshold){0, 1} : (dp_threshold){at, 1 / softness};
}

void dp_edge_map_row(const dp_gbuffer *g, const dp_edge_map *map, uint32_t y, uint32_t x0,
                     uint32_t x1, dp_edge_run *out) {
    const size_t at = (size_t)y * g->stride + x0;
    const uint32_t n = x1 - x0;
    const int radius = (int)map->radius;
    const dp_depth_measure m = measure_of(g, map);
    const dp_rows z = rows_of(map->as_printed ? g->distance : g->depth, at, g->stride, radius);
    const dp_rows nx = rows_of(g->nx, at, g->stride, radius),
                  ny = rows_of(g->ny, at, g->stride, radius);
    const dp_rows nz = rows_of(g->nz, at, g->stride, radius);
    if (map->as_printed) {
        g->detectors->diagonal_normals(nx, ny, nz, radius, n, out->inner);
        g->detectors->diagonal_depth_printed(z, &m, radius, n, out->profile);
    } else {
        g->detectors->diagonal_scaled(nx, ny, nz, z, &m, radius, n, out->inner, out->profile);
    }
    if (map->detector == DP_EDGE_MAP_C1) detect_c1(g, map, z, x0, y, n, out->profile);
    const float angle = map->inner_angle * (float)(3.14159265358979323846 / 180);
    const dp_pixel_run run = {g->id + at, g->distance + at, g->stride, n};
    g->detectors->strengths(
        &run, threshold_of(map, 1 - (float)dp_cos((double)angle), map->inner_softness),
        threshold_of(map, 0.15f, map->profile_softness), radius, out);
    if (!map->no_groups) add_groups(g, map, at, out);
    if (map->enhanced) drop_others(g, map, at, out);
}

void dp_edge_map_store(const dp_edge_run *run, uint32_t n, uint8_t *rgba) {
    for (uint32_t i = 0; i < n; i++) {
        const uint8_t inner = (uint8_t)(255.5f - 255 * run->inner[i]);
        rgba[4 * i] = rgba[4 * i + 1] = rgba[4 * i + 2] = inner;
        rgba[4 * i + 3] = (uint8_t)(255.5f - 255 * run->profile[i]);
    }
}
