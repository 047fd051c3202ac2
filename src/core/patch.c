/* One patch: its grid of triangles, positions from the curves and the patch, everything else mixed
 * from its three corners.
 *
 * Invariant: points on an edge come from its curve, never from the patch, so that neighbours agree. */
#include "core/patch.h"

#include <string.h>

/* ------- polygons as they are ------- */

static void begin_polygon(dp_patch_target *t, uint32_t polygon) {
    const dp_polygons *const p = t->from;
    if (t->firsts) t->firsts[t->polygon] = t->corner;
    if (t->groups) t->groups[t->polygon] = p->groups[polygon];
    t->source_polygon[t->polygon++] = p->source_polygon ? p->source_polygon[polygon] : polygon;
}

/* The numbers of a corner's own normal and texture coordinates. */
static uint32_t normal_of(const dp_patch_target *t, uint32_t corner) {
    return dp_corner_normal_number(t->corner_normals, corner, dp_corner_vertex(t->from, corner));
}

static uint32_t texcoord_of(const dp_patch_target *t, uint32_t corner) {
    return dp_attribute_number(&t->from->texcoords, corner, dp_corner_vertex(t->from, corner));
}

static uint8_t flag_of(const dp_polygons *p, uint32_t corner) {
    return !p->edge_flags     ? 1
           : p->has_diagonals ? p->edge_flags[corner]
                              : p->edge_flags[corner] != 0;
}

/* What an edge of the result takes from the polygons that there were. */
typedef struct edge {
    uint32_t source; /* its number there, or DP_EDGE_INSIDE */
    uint8_t flag;
    bool smooth;
} edge;

static const edge INSIDE = {DP_EDGE_INSIDE, DP_EDGE_DIAGONAL, true};

static edge edge_of(const dp_patch_target *t, uint32_t first, uint32_t i) {
    return (edge){i, flag_of(t->from, first + i), (t->noted[first + i] & DP_NOTED_SMOOTH) != 0};
}

static void put_corner(dp_patch_target *t, uint32_t vertex, edge e) {
    t->corners[t->corner] = vertex;
    t->source_edges[t->corner] = (uint16_t)e.source;
    t->smooth_edges[t->corner] = e.smooth;
    if (t->edge_flags) t->edge_flags[t->corner] = e.flag;
    t->corner++;
}

void dp_patch_put_flat(dp_patch_target *t, uint32_t polygon) {
    const dp_polygons *const p = t->from;
    const uint32_t first = dp_first_corner(p, polygon), n = dp_corner_count(p, polygon);
    begin_polygon(t, polygon);
    for (uint32_t i = 0; i < n; i++) {
        if (t->normals) t->normal_at[t->corner] = normal_of(t, first + i);
        if (t->texcoords) t->texcoord_at[t->corner] = texcoord_of(t, first + i);
        put_corner(t, dp_corner_vertex(p, first + i), edge_of(t, first, i));
    }
}

/* ------- curved ones ------- */

typedef struct patch {
    const dp_pn_grid *grid;
    uint32_t corner[3], vertex[3]; /* of the polygons that there were */
    edge outer[3];
    uint32_t normal[3], texcoord[3]; /* numbers of the corners' */
    uint32_t first;                  /* the first new vertex */
} patch;

static void put_positions(const dp_patch_target *t, const patch *p, const dp_pn_edge curves[3]) {
    const dp_pn_grid *const g = p->grid;
    const dp_pn_patch surface = dp_pn_patch_within(curves);
    for (uint32_t v = 3; v < g->vertex_count; v++) {
        int k = 0;
        while (k < 3 && v >= g->starts[k + 1]) k++;
        const dp_vec3 at = k < 3 ? dp_pn_edge_point(&curves[k], v - g->starts[k] + 1, g->parts[k])
                                 : dp_pn_point(&surface, g->weights[v]);
        float *const to = t->positions[p->first + v - 3];
        to[0] = (float)at.x, to[1] = (float)at.y, to[2] = (float)at.z;
    }
}

static bool has_all(const uint32_t number[3]) {
    return number[0] != UINT32_MAX && number[1] != UINT32_MAX && number[2] != UINT32_MAX;
}

static void put_normals(const dp_patch_target *t, const patch *p) {
    const dp_pn_grid *const g = p->grid;
    if (!has_all(p->normal)) return;
    dp_vec3 at[3], corner[3];
    for (int k = 0; k < 3; k++) {
        at[k] = dp_v3f(dp_vertex_position(t->from, p->vertex[k]));
        corner[k] = dp_unit(dp_v3f(dp_corner_normal_value(t->corner_normals, p->normal[k])));
    }
    const dp_pn_normals normals = dp_pn_normals_of(at, corner);
    for (uint32_t v = 3; v < g->vertex_count; v++) {
        const dp_vec3 n = dp_pn_normal(&normals, g->weights[v]);
        float *const to = t->normals[t->normal_base + p->first - t->from->vertex_count + v - 3];
        to[0] = (float)n.x, to[1] = (float)n.y, to[2] = (float)n.z;
    }
}

static void put_texcoords(const dp_patch_target *t, const patch *p) {
    const dp_attribute *const a = &t->from->texcoords;
    if (!has_all(p->texcoord)) return;
    for (uint32_t v = 3; v < p->grid->vertex_count; v++) {
        float *const to = t->texcoords[a->count + p->first - t->from->vertex_count + v - 3];
        for (int c = 0; c < 2; c++) {
            double sum = 0;
            for (int k = 0; k < 3; k++)
                sum += p->grid->weights[v][k] * (double)dp_attribute_value(a, p->texcoord[k])[c];
            to[c] = (float)sum;
        }
    }
}

/* 0xRRGGBBAA, channel by channel; where a corner has none, the nearest corner's. */
static uint32_t mix_colors(const uint32_t colors[3], const double w[3]) {
    uint32_t mixed = 0;
    int nearest = 0;
    for (int k = 1; k < 3; k++)
        if (w[k] > w[nearest]) nearest = k;
    if (!colors[0] || !colors[1] || !colors[2]) return colors[nearest];
    for (int shift = 0; shift < 32; shift += 8) {
        double sum = 0.5;
        for (int k = 0; k < 3; k++) sum += w[k] * (colors[k] >> shift & 0xff);
        mixed |= (uint32_t)sum << shift;
    }
    return mixed ? mixed : colors[nearest];
}

static void put_colors(const dp_patch_target *t, const patch *p) {
    uint32_t colors[3];
    for (int k = 0; k < 3; k++) colors[k] = t->from->colors[p->vertex[k]];
    for (uint32_t v = 3; v < p->grid->vertex_count; v++)
        t->colors[p->first + v - 3] = mix_colors(colors, p->grid->weights[v]);
}

/* The number that a vertex of the grid has among normals or texture coordinates. */
static uint32_t number_of(const dp_patch_target *t, const patch *p, uint32_t v,
                          const uint32_t corner[3], uint32_t base) {
    if (v < 3) return corner[v];
    return has_all(corner) ? base + p->first - t->from->vertex_count + v - 3 : UINT32_MAX;
}

static void put_triangle(dp_patch_target *t, const patch *p, uint32_t polygon, uint32_t triangle) {
    begin_polygon(t, polygon);
    for (int i = 0; i < 3; i++) {
        const uint32_t v = p->grid->triangles[triangle][i], k = p->grid->edges[triangle][i];
        if (t->normals) t->normal_at[t->corner] = number_of(t, p, v, p->normal, t->normal_base);
        if (t->texcoords)
            t->texcoord_at[t->corner] =
                number_of(t, p, v, p->texcoord, (uint32_t)t->from->texcoords.count);
        put_corner(t, v < 3 ? p->vertex[v] : p->first + v - 3,
                   k == DP_PN_INSIDE ? INSIDE : p->outer[k]);
    }
}

static void begin_patch(const dp_patch_target *t, patch *p, uint32_t polygon, uint32_t i) {
    const uint32_t first = dp_first_corner(t->from, polygon), n = dp_corner_count(t->from, polygon);
    const uint32_t corner[3] = {0, i, i + 1};
    p->first = t->vertex;
    for (int k = 0; k < 3; k++) {
        p->corner[k] = first + corner[k];
        p->vertex[k] = dp_corner_vertex(t->from, p->corner[k]);
        p->outer[k] = dp_is_fan_diagonal(n, i, k) ? INSIDE : edge_of(t, first, corner[k]);
        p->normal[k] = t->normals ? normal_of(t, p->corner[k]) : UINT32_MAX;
        p->texcoord[k] = t->texcoords ? texcoord_of(t, p->corner[k]) : UINT32_MAX;
    }
}

void dp_patch_put(dp_patch_target *t, uint32_t polygon, uint32_t i, const dp_pn_edge curves[3],
                  const uint32_t parts[3]) {
    patch p = {.grid = t->grid};
    if (memcmp(t->grid->parts, parts, sizeof t->grid->parts)) dp_pn_grid_make(t->grid, parts);
    begin_patch(t, &p, polygon, i);
    put_positions(t, &p, curves);
    if (t->normals) put_normals(t, &p);
    if (t->texcoords) put_texcoords(t, &p);
    if (t->colors) put_colors(t, &p);
    for (uint32_t k = 0; k < p.grid->triangle_count; k++) put_triangle(t, &p, polygon, k);
    t->vertex += p.grid->vertex_count - 3;
}
