/* Models for tests. */
#include "gl/models.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

static void add_polygon(model *m, uint32_t group, uint32_t count, const uint32_t *corners) {
    const uint32_t first = m->firsts[m->polygons];
    memcpy(m->corners + first, corners, count * sizeof *corners);
    m->groups[m->polygons++] = (uint16_t)group;
    m->firsts[m->polygons] = first + count;
}

static void add_vertex(model *m, double x, double y, double z) {
    float *const p = m->positions[m->vertices], *const n = m->normals[m->vertices];
    p[0] = (float)x, p[1] = (float)y, p[2] = (float)z;
    memcpy(n, p, sizeof m->normals[0]);
    m->texcoords[m->vertices][0] = p[0], m->texcoords[m->vertices][1] = p[1];
    m->colors[m->vertices] = m->vertices * 0x35a1c7u << 8 | 0xff;
    m->vertices++;
}

static void make_torus(model *m) {
    enum { ROUND = 12, TUBE = 8 };
    for (uint32_t i = 0; i < ROUND; i++)
        for (uint32_t j = 0; j < TUBE; j++) {
            const double u = 6.283185307179586 * i / ROUND, v = 6.283185307179586 * j / TUBE,
                         r = 1 + 0.4 * cos(v);
            const uint32_t i1 = (i + 1) % ROUND, j1 = (j + 1) % TUBE;
            const uint32_t at[4] = {i * TUBE + j, i1 * TUBE + j, i1 * TUBE + j1, i * TUBE + j1};
            add_vertex(m, r * cos(u), r * sin(u), 0.4 * sin(v));
            add_polygon(m, 0, 4, at);
        }
}

/* Two that cross. */
static void make_sheets(model *m) {
    enum { N = 4 };
    for (uint32_t s = 0; s < 2; s++)
        for (uint32_t i = 0; i <= N; i++)
            for (uint32_t j = 0; j <= N; j++) {
                const uint32_t n = s * (N + 1) * (N + 1) + i * (N + 1) + j;
                const double a = 2.0 * i / N - 1, b = 2.0 * j / N - 1;
                const uint32_t at[2][3] = {{n, n + 1, n + N + 2}, {n, n + N + 2, n + N + 1}};
                if (s)
                    add_vertex(m, a, 0.3 * a + 0.07 * b, b);
                else
                    add_vertex(m, a, b, 0.1 * a - 0.2 * b);
                for (int k = 0; k < 2 && i < N && j < N; k++) add_polygon(m, s + 1, 3, at[k]);
            }
}

static void make_box(model *m) {
    static const uint32_t sides[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                         {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (uint32_t v = 0; v < 8; v++)
        add_vertex(m, v & 1 ? 0.7 : -0.7, v & 2 ? 0.8 : -0.8, v & 4 ? 0.6 : -0.6);
    for (uint32_t s = 0; s < 6; s++) add_polygon(m, s / 2, 4, sides[s]);
}

void make_model(model *m, shape s, float wave) {
    memset(m, 0, sizeof *m);
    if (s == TORUS) make_torus(m);
    if (s == SHEETS) make_sheets(m);
    if (s == BOX) make_box(m);
    for (uint32_t v = 0; v < m->vertices; v++)
        m->positions[v][0] += wave * (float)sin(2 * (double)m->positions[v][1] + 1);
}

dp_source *source_of(const model *m, shape s, bool far_away) {
    const bool carries = s == BOX;
    dp_batch batch = {.positions = m->positions[0],
                      .vertex_count = m->vertices,
                      .indices = m->corners,
                      .corner_count = m->firsts[m->polygons],
                      .firsts = s == SHEETS ? NULL : m->firsts,
                      .polygon_count = m->polygons,
                      .groups = s == TORUS ? NULL : m->groups,
                      .colors = carries || s == SHEETS ? m->colors : NULL};
    if (far_away) batch.origin[0] = 0.25, batch.origin[1] = -0.125;
    if (carries)
        batch.normals.values = m->normals[0], batch.normals.count = m->vertices,
        batch.texcoords.values = m->texcoords[0], batch.texcoords.count = m->vertices;
    dp_source *source = NULL;
    assert_int_equal(dp_source_from_arrays(&batch, NULL, &source, NULL), DP_OK);
    return source;
}
