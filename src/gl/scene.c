/* The scene: all meshes of a picture in one list of vertices and triangles.
 *
 * Corners are numbers of the scene's vertices, so that no later stage knows of meshes. They are written when the list
 * of meshes or the topology of one changes; vertices are placed for each picture. Invariant: `new_topology` is set
 * exactly when corners were written since the last picture, or a mesh of several moved against the others. */
#include "gl/scene.h"

#include <string.h>

static bool reserve_list(dp_gl *gl, size_t count) {
    dp_gl_scene *const s = &gl->scene;
    return dp_reserve(&gl->memory, &s->meshes, &s->meshes_cap, count, sizeof *s->meshes) &&
           dp_reserve(&gl->memory, &s->topologies, &s->topologies_cap, count,
                      sizeof *s->topologies) &&
           dp_reserve(&gl->memory, &s->placements, &s->placements_cap, count,
                      sizeof *s->placements);
}

/* Is it the same list, with the same topologies? Two meshes may touch where they stand, and no more where
 * one has moved. */
static bool is_known(const dp_gl_scene *s, dp_gl_mesh *const *meshes, size_t count) {
    if (s->count != count) return false;
    for (size_t i = 0; i < count; i++)
        if (s->meshes[i] != meshes[i] || s->topologies[i] != meshes[i]->topology ||
            (count > 1 && s->placements[i] != meshes[i]->placement))
            return false;
    return true;
}

static dp_result count_all(dp_gl *gl, dp_gl_mesh *const *meshes, size_t count, dp_diag *diag) {
    uint64_t vertices = 0, triangles = 0;
    for (size_t i = 0; i < count; i++) {
        vertices += meshes[i]->vertex_count;
        triangles += meshes[i]->triangle_count;
    }
    if (vertices > UINT32_MAX / 2 || triangles > UINT32_MAX / 8)
        return dp_fail(diag, DP_ERR_LIMIT, "the meshes have %llu triangles; the most are %u",
                       (unsigned long long)triangles, UINT32_MAX / 8);
    gl->scene.vertex_count = (uint32_t)vertices, gl->scene.triangle_count = (uint32_t)triangles;
    return DP_OK;
}

static dp_result reserve_device(dp_gl *gl, dp_diag *diag) {
    dp_gl_scene *const s = &gl->scene;
    dp_result result = dp_gl_buffer_reserve(gl, &s->vertices, 32 * (size_t)s->vertex_count,
                                            "vertices of the picture", diag);
    if (!result)
        result = dp_gl_buffer_reserve(gl, &s->corners, 12 * (size_t)s->triangle_count,
                                      "corners of the picture", diag);
    if (!result)
        result = dp_gl_buffer_reserve(gl, &s->triangles, 8 * (size_t)s->triangle_count,
                                      "triangles of the picture", diag);
    return result;
}

void dp_gl_scene_bind(dp_gl *gl) {
    dp_gl_buffer_bind(gl, &gl->scene.vertices, DP_GL_BIND_VERTICES);
    dp_gl_buffer_bind(gl, &gl->scene.corners, DP_GL_BIND_CORNERS);
    dp_gl_buffer_bind(gl, &gl->scene.triangles, DP_GL_BIND_TRIANGLES);
}

dp_gl_group_numbers dp_gl_groups_of(const dp_gl_scene *scene, size_t index) {
    uint32_t meshes = 0, before = 0;
    if (scene->meshes[index]->keeps_groups) return (dp_gl_group_numbers){0, 0};
    for (size_t i = 0; i < scene->count; i++) {
        const dp_gl_mesh *const m = scene->meshes[i];
        meshes += !m->keeps_groups;
        before += i < index && m->group_count ? m->group_count - 1 : 0;
    }
    return (dp_gl_group_numbers){(uint32_t)index, meshes + before - 1};
}

/* Writes one mesh's corners and triangles behind those before it. */
static void put_mesh(dp_gl *gl, uint32_t program, const dp_gl_mesh *m, uint32_t first_vertex,
                     uint32_t first_triangle, uint64_t first_polygon, dp_gl_group_numbers groups) {
    const dp_gl_api *const a = &gl->api;
    dp_gl_uniform_u(gl, program, "first_vertex", first_vertex);
    dp_gl_uniform_u(gl, program, "first_triangle", first_triangle);
    dp_gl_uniform_u(gl, program, "first_polygon", (uint32_t)first_polygon);
    dp_gl_uniform_u(gl, program, "zero_group", groups.zero);
    dp_gl_uniform_u(gl, program, "other_groups", groups.others);
    dp_gl_uniform_u(gl, program, "vertex_count", m->vertex_count);
    dp_gl_uniform_u(gl, program, "triangle_count", m->triangle_count);
    dp_gl_uniform_u(gl, program, "indices_at",
                    m->from.indices ? (uint32_t)(m->from.indices_offset / 4) : UINT32_MAX);
    dp_gl_uniform_u(gl, program, "has_kinds", m->owned);
    a->BindBufferBase(GL_SHADER_STORAGE_BUFFER, DP_GL_BIND_OWN,
                      m->from.indices ? m->from.indices : gl->scene.corners.name);
    a->BindBufferBase(GL_SHADER_STORAGE_BUFFER, DP_GL_BIND_OWN + 1,
                      m->owned ? m->triangles.name : gl->scene.triangles.name);
    dp_gl_dispatch(gl, m->triangle_count);
}

static dp_result put_meshes(dp_gl *gl, dp_diag *diag) {
    static const dp_gl_program_desc desc = {.compute = "scene_corners.comp"};
    uint32_t program, vertices = 0, triangles = 0;
    uint64_t polygons = 0;
    const dp_result result = dp_gl_program(gl, &desc, &program, diag);
    if (result) return result;
    dp_gl_use(gl, program);
    dp_gl_scene_bind(gl);
    for (size_t i = 0; i < gl->scene.count; i++) {
        const dp_gl_mesh *const m = gl->scene.meshes[i];
        put_mesh(gl, program, m, vertices, triangles, polygons, dp_gl_groups_of(&gl->scene, i));
        vertices += m->vertex_count, triangles += m->triangle_count, polygons += m->pieces;
    }
    return DP_OK;
}

dp_result dp_gl_scene_take(dp_gl *gl, dp_gl_mesh *const *meshes, size_t count, dp_diag *diag) {
    dp_gl_scene *const s = &gl->scene;
    s->new_topology = !count || !is_known(s, meshes, count); /* none are known once one is gone */
    /* which a source may change with its positions */
    memcpy(s->origin, count ? meshes[0]->origin : (double[3]){0, 0, 0}, sizeof s->origin);
    if (!s->new_topology) return DP_OK;
    s->count = 0;
    s->topology = dp_gl_number(gl);
    dp_result result = reserve_list(gl, count)
                           ? count_all(gl, meshes, count, diag)
                           : dp_fail(diag, DP_ERR_MEMORY, "out of memory for a list of meshes");
    if (!result) result = reserve_device(gl, diag);
    if (result) return result;
    s->has_fans = false;
    for (size_t i = 0; i < count; i++) {
        s->has_fans |= meshes[i]->polygon_firsts != NULL;
        s->meshes[i] = meshes[i];
        s->topologies[i] = meshes[i]->topology;
        s->placements[i] = meshes[i]->placement;
    }
    s->count = count;
    result = put_meshes(gl, diag);
    if (result) s->count = 0;
    return result;
}

bool dp_gl_placement_of(const dp_gl_mesh *m, const double origin[3], double rows[3][4]) {
    bool moves = m->placed;
    for (int r = 0; r < 3; r++) {
        rows[r][3] = m->origin[r] - origin[r];
        for (int c = 0; c < 3; c++)
            rows[r][c] = m->placed ? m->matrix[4 * c + r] : (double)(r == c);
        if (m->placed) {
            rows[r][3] = m->matrix[12 + r] - origin[r];
            for (int c = 0; c < 3; c++) rows[r][3] += m->matrix[4 * c + r] * m->origin[c];
        }
        moves |= rows[r][3] != 0;
    }
    return moves;
}

static dp_result place_mesh(dp_gl *gl, uint32_t program, const dp_gl_mesh *m, uint32_t first,
                            dp_gl_buffer *placement, dp_diag *diag) {
    double rows[3][4];
    const bool moves = dp_gl_placement_of(m, gl->scene.origin, rows);
    const dp_result result =
        dp_gl_buffer_fill(gl, placement, rows, sizeof rows, "a mesh's place", diag);
    if (result) return result;
    gl->api.BindBufferBase(GL_UNIFORM_BUFFER, 1, placement->name);
    dp_gl_uniform_u(gl, program, "is_placed", moves);
    dp_gl_uniform_u(gl, program, "first_vertex", first);
    dp_gl_uniform_u(gl, program, "vertex_count", m->vertex_count);
    dp_gl_uniform_u(gl, program, "positions_at", (uint32_t)(m->from.positions_offset / 4));
    dp_gl_uniform_u(gl, program, "stride", m->from.positions_stride / 4);
    gl->api.BindBufferBase(GL_SHADER_STORAGE_BUFFER, DP_GL_BIND_OWN, m->from.positions);
    dp_gl_dispatch(gl, m->vertex_count);
    return DP_OK;
}

dp_result dp_gl_scene_place(dp_gl *gl, dp_diag *diag) {
    static const dp_gl_program_desc desc = {.compute = "scene_vertices.comp"};
    dp_gl_buffer placement = {0};
    uint32_t program, first = 0;
    dp_result result = dp_gl_program(gl, &desc, &program, diag);
    if (result) return result;
    dp_gl_use(gl, program);
    dp_gl_scene_bind(gl);
    for (size_t i = 0; i < gl->scene.count && !result; i++) {
        const dp_gl_mesh *const m = gl->scene.meshes[i];
        result = place_mesh(gl, program, m, first, &placement, diag);
        first += m->vertex_count;
    }
    dp_gl_buffer_free(gl, &placement);
    return result;
}

void dp_gl_scene_free_host(dp_gl *gl) {
    dp_free(&gl->memory, gl->scene.meshes);
    dp_free(&gl->memory, gl->scene.topologies);
    dp_free(&gl->memory, gl->scene.placements);
}

void dp_gl_scene_free(dp_gl *gl) {
    dp_gl_buffer_free(gl, &gl->scene.vertices);
    dp_gl_buffer_free(gl, &gl->scene.corners);
    dp_gl_buffer_free(gl, &gl->scene.triangles);
}
