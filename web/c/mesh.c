/* The model's triangles for whoever simplifies them, and the simplified model.
 *
 *     web_mesh            all batches as one indexed mesh, polygons as fans of triangles
 *     web_draft           a source of fewer triangles, which is drawn while something moves
 *
 * Invariant: vertices are counted about the first batch's origin, as the drawing counts them. Normals, texture
 * coordinates and vertices' colours are left out: a draft is shaded flat where the model is smooth. */
#include "page.h"

#include "report.h"

#include <stdlib.h>
#include <string.h>

typedef struct mesh {
    float *positions;  /* [vertex_count][3] */
    uint32_t *indices; /* [triangle_count][3] */
    uint16_t *groups;  /* [triangle_count]; NULL: all of group 0 */
    size_t vertex_count, triangle_count, vertex_room, triangle_room;
    double origin[3];
    bool begun;        /* origin is known */
    const float *last; /* vertices of the last batch, and the first of them here */
    size_t last_count, last_base;
} mesh;

static mesh all;

static void free_mesh(mesh *m) {
    free(m->positions);
    free(m->indices);
    free(m->groups);
    *m = (mesh){0};
}

static bool grow(void **block, size_t item, size_t room) {
    void *const larger = realloc(*block, item * room);
    if (larger) *block = larger;
    return larger != NULL;
}

static bool make_vertex_room(mesh *m, size_t more) {
    if (m->vertex_count + more <= m->vertex_room) return true;
    m->vertex_room = m->vertex_count + more + m->vertex_room / 2;
    return grow((void **)&m->positions, 3 * sizeof(float), m->vertex_room);
}

static bool make_triangle_room(mesh *m, size_t more) {
    if (m->triangle_count + more <= m->triangle_room) return true;
    m->triangle_room = m->triangle_count + more + m->triangle_room / 2;
    return grow((void **)&m->indices, 3 * sizeof(uint32_t), m->triangle_room) &&
           grow((void **)&m->groups, sizeof(uint16_t), m->triangle_room);
}

/* The batch's vertices, once where several batches share them. */
static bool add_vertices(mesh *m, const dp_batch *b) {
    const size_t stride = b->position_stride ? b->position_stride : 3 * sizeof(float);
    if (b->stable && b->positions == m->last && b->vertex_count == m->last_count) return true;
    if (!make_vertex_room(m, b->vertex_count)) return false;
    m->last = b->positions, m->last_count = b->vertex_count, m->last_base = m->vertex_count;
    for (size_t v = 0; v < b->vertex_count; v++) {
        const float *const from = (const float *)((const char *)b->positions + v * stride);
        float *const to = m->positions + 3 * m->vertex_count++;
        for (int k = 0; k < 3; k++)
            to[k] = (float)((double)from[k] + (b->origin[k] - m->origin[k]));
    }
    return true;
}

static void add_polygon(mesh *m, const dp_batch *b, size_t polygon) {
    const size_t first = b->firsts ? b->firsts[polygon] : 3 * polygon,
                 end = b->firsts ? b->firsts[polygon + 1] : first + 3;
    for (size_t c = first; c < end; c++)
        if (b->indices && b->indices[c] >= b->vertex_count) return;
    for (size_t c = first + 1; c + 1 < end; c++) {
        const size_t corners[3] = {first, c, c + 1};
        uint32_t *const to = m->indices + 3 * m->triangle_count;
        m->groups[m->triangle_count++] = b->groups ? b->groups[polygon] : 0;
        for (int k = 0; k < 3; k++)
            to[k] = (uint32_t)(m->last_base + (b->indices ? b->indices[corners[k]] : corners[k]));
    }
}

static bool add_batch(mesh *m, const dp_batch *b) {
    if (!m->begun) memcpy(m->origin, b->origin, sizeof m->origin), m->begun = true;
    if (!add_vertices(m, b) || !make_triangle_room(m, b->corner_count)) return false;
    for (size_t k = 0; k < b->polygon_count; k++) add_polygon(m, b, k);
    return true;
}

/* Gathers the model's triangles. */
EMSCRIPTEN_KEEPALIVE web_answer web_mesh(void) {
    dp_source *const source = the_page.model.source;
    dp_diag diag = {0};
    bool room = true;
    if (!source) return ANSWER_FAILED;
    free_mesh(&all);
    dp_result result = dp_source_rewind(source, &diag);
    while (!result && room) {
        dp_batch batch;
        result = dp_source_next(source, &batch, &diag);
        if (!result && !batch.polygon_count) break;
        if (!result) room = add_batch(&all, &batch);
    }
    if (!result && room) return ANSWER_DONE;
    free_mesh(&all);
    return ANSWER_FAILED;
}

/* Where they lie: positions, vertices, indices, triangles, groups. */
EMSCRIPTEN_KEEPALIVE const double *web_mesh_parts(void) {
    static double parts[5];
    parts[0] = (double)(uintptr_t)all.positions, parts[1] = (double)all.vertex_count;
    parts[2] = (double)(uintptr_t)all.indices, parts[3] = (double)all.triangle_count;
    parts[4] = (double)(uintptr_t)all.groups;
    return parts;
}

EMSCRIPTEN_KEEPALIVE void web_mesh_free(void) {
    const double origin[3] = {all.origin[0], all.origin[1], all.origin[2]};
    free_mesh(&all);
    memcpy(all.origin, origin, sizeof origin); /* for the draft */
}

/* ------- the draft ------- */

typedef struct draft {
    dp_source *model; /* says what groups are called; outlives the draft */
    dp_batch batch;
    bool read;
} draft;

static dp_result next_batch(void *user, dp_batch *batch, dp_diag *diag) {
    draft *const d = user;
    (void)diag;
    if (!d->read) *batch = d->batch;
    d->read = true;
    return DP_OK;
}

static dp_result rewind_draft(void *user, dp_diag *diag) {
    (void)diag;
    ((draft *)user)->read = false;
    return DP_OK;
}

static void destroy_draft(void *user) {
    draft *const d = user;
    free((void *)(uintptr_t)d->batch.positions);
    free((void *)(uintptr_t)d->batch.indices);
    free((void *)(uintptr_t)d->batch.groups);
    free(d);
}

static const char *group_name(void *user, uint32_t group) {
    return dp_source_group_name(((draft *)user)->model, group);
}

static uint32_t group_color(void *user, uint32_t group) {
    return dp_source_group_color(((draft *)user)->model, group);
}

/* Takes blocks of malloc's in any case; groups may be NULL. Positions count about the origin of the last web_mesh. */
EMSCRIPTEN_KEEPALIVE web_answer web_draft(float *positions, size_t vertices, uint32_t *indices,
                                          size_t triangles, uint16_t *groups) {
    draft *const d = calloc(1, sizeof *d);
    dp_diag diag;
    if (!d) {
        free(positions), free(indices), free(groups);
        return ANSWER_FAILED;
    }
    *d = (draft){.model = the_page.model.source,
                 .batch = {.positions = positions,
                           .vertex_count = vertices,
                           .indices = indices,
                           .corner_count = 3 * triangles,
                           .polygon_count = triangles,
                           .groups = groups,
                           .stable = true}};
    memcpy(d->batch.origin, all.origin, sizeof d->batch.origin);
    dp_source_callbacks calls = {.user = d,
                                 .next = next_batch,
                                 .rewind = rewind_draft,
                                 .destroy = destroy_draft,
                                 .group_name = group_name,
                                 .group_color = group_color};
    dp_source_up(d->model, calls.up);
    loaded made = {.seen = the_page.model.seen};
    if (dp_source_from_callbacks(&calls, NULL, &made.source, &diag)) {
        destroy_draft(d);
        return ANSWER_FAILED;
    }
    loaded_free(&the_page.draft);
    the_page.draft = made;
    return ANSWER_DONE;
}
