/* Cuts a triangle so that its edges have the parts that were asked for, each its own number: what
 * graphics processors do between tessellation levels.
 *
 *     one edge is cut       a fan around the corner across
 *     more                  a regular grid, of as many rows as the largest number of parts; points on
 *                           an edge of fewer parts move to the nearest of these, and triangles that
 *                           thereby lose an edge are left out
 *
 * Moving neighbours on the outline into one takes away just the triangle between them, so that what
 * is left still covers the triangle once. Invariant: with B points on the outline and I inside there
 * are 2 I + B - 2 triangles (Euler). */
#include "mesh/pn_grid.h"

/* Does no more than one edge have more than one part? */
static bool is_fan(const uint32_t parts[3]) {
    return (parts[0] > 1) + (parts[1] > 1) + (parts[2] > 1) <= 1;
}

static uint32_t most(const uint32_t parts[3]) {
    const uint32_t two = parts[0] > parts[1] ? parts[0] : parts[1];
    return two > parts[2] ? two : parts[2];
}

static uint32_t inner_count(const uint32_t parts[3]) {
    const uint32_t n = most(parts);
    return is_fan(parts) ? 0 : (n - 1) * (n - 2) / 2;
}

uint32_t dp_pn_new_vertices(const uint32_t parts[3]) {
    return parts[0] + parts[1] + parts[2] - 3 + inner_count(parts);
}

uint32_t dp_pn_triangle_count(const uint32_t parts[3]) {
    return 2 * inner_count(parts) + parts[0] + parts[1] + parts[2] - 2;
}

/* The vertex at `part` of edge k. */
static uint32_t edge_vertex(const dp_pn_grid *g, int k, uint32_t part) {
    if (part == 0) return (uint32_t)k;
    return part == g->parts[k] ? (uint32_t)(k + 1) % 3 : g->starts[k] + part - 1;
}

/* Where on edge k a vertex lies; UINT32_MAX: not on it. */
static uint32_t part_of(const dp_pn_grid *g, int k, uint32_t vertex) {
    if (vertex == (uint32_t)k) return 0;
    if (vertex == (uint32_t)(k + 1) % 3) return g->parts[k];
    return vertex >= g->starts[k] && vertex < g->starts[k + 1] ? vertex - g->starts[k] + 1
                                                               : UINT32_MAX;
}

static uint8_t outer_edge(const dp_pn_grid *g, uint32_t from, uint32_t to) {
    for (int k = 0; k < 3; k++) {
        const uint32_t a = part_of(g, k, from), b = part_of(g, k, to);
        if (a != UINT32_MAX && b != UINT32_MAX && b == a + 1) return (uint8_t)k;
    }
    return DP_PN_INSIDE;
}

static void put(dp_pn_grid *g, uint32_t a, uint32_t b, uint32_t c) {
    if (a == b || b == c || c == a) return;
    const uint32_t v[3] = {a, b, c};
    for (int i = 0; i < 3; i++) {
        g->triangles[g->triangle_count][i] = (uint8_t)v[i];
        g->edges[g->triangle_count][i] = outer_edge(g, v[i], v[(i + 1) % 3]);
    }
    g->triangle_count++;
}

static void put_fan(dp_pn_grid *g) {
    int k = 0;
    while (k < 2 && g->parts[k] == 1) k++;
    for (uint32_t i = 0; i < g->parts[k]; i++)
        put(g, edge_vertex(g, k, i), edge_vertex(g, k, i + 1), (uint32_t)(k + 2) % 3);
}

/* The vertex nearest to point i of n on edge k. */
static uint32_t nearest(const dp_pn_grid *g, int k, uint32_t i) {
    return edge_vertex(g, k, (2 * i * g->parts[k] + g->rows) / (2 * g->rows));
}

/* The vertex at place i of row r: rows run along edge 1, from corner 0 on; row r has r + 1 places. */
static uint32_t grid_vertex(const dp_pn_grid *g, uint32_t r, uint32_t i) {
    const uint32_t n = g->rows;
    if (i == 0) return nearest(g, 0, r);
    if (i == r) return nearest(g, 2, n - r);
    if (r == n) return nearest(g, 1, i);
    return g->starts[3] + (r - 1) * (r - 2) / 2 + i - 1;
}

static void put_rows(dp_pn_grid *g) {
    for (uint32_t r = 0; r < g->rows; r++)
        for (uint32_t i = 0; i <= r; i++) {
            put(g, grid_vertex(g, r, i), grid_vertex(g, r + 1, i), grid_vertex(g, r + 1, i + 1));
            if (i < r)
                put(g, grid_vertex(g, r, i), grid_vertex(g, r + 1, i + 1),
                    grid_vertex(g, r, i + 1));
        }
}

static void weigh(dp_pn_grid *g) {
    for (int k = 0; k < 3; k++)
        for (uint32_t i = 0; i < g->parts[k]; i++) {
            double *const w = g->weights[edge_vertex(g, k, i)];
            const double t = (double)i / g->parts[k];
            w[k] = 1 - t, w[(k + 1) % 3] = t, w[(k + 2) % 3] = 0;
        }
    if (g->vertex_count == g->starts[3]) return;
    for (uint32_t r = 2; r < g->rows; r++)
        for (uint32_t i = 1; i < r; i++) {
            double *const w = g->weights[grid_vertex(g, r, i)];
            w[0] = (double)(g->rows - r) / g->rows;
            w[1] = (double)(r - i) / g->rows;
            w[2] = (double)i / g->rows;
        }
}

void dp_pn_grid_make(dp_pn_grid *g, const uint32_t parts[3]) {
    g->starts[0] = 3;
    for (int k = 0; k < 3; k++) {
        g->parts[k] = parts[k];
        g->starts[k + 1] = g->starts[k] + parts[k] - 1;
    }
    g->rows = most(parts);
    g->vertex_count = 3 + dp_pn_new_vertices(parts);
    g->triangle_count = 0;
    if (is_fan(parts))
        put_fan(g);
    else
        put_rows(g);
    weigh(g);
}
