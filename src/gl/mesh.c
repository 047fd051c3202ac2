/* Meshes: polygons of a source, or the application's own buffers, on the device.
 *
 * A source is gathered into convex polygons as for dp_draw (mesh/gather.c); each becomes a fan of triangles, whose inner
 * edges are none. Data structure: positions, corners (3 a triangle) and kinds (dp_gl_scene.triangles) in three
 * buffers; on the host what leads from a triangle back to the source's polygon. Invariant: `topology` changes
 * whenever corners or kinds do, `placement` whenever positions may have, as far as the library can know: buffers
 * of the application's are read anew for each picture. */
#include "gl/mesh.h"

#include "core/view.h"
#include "mesh/polygons.h"
#include "mesh/source.h"

#include <math.h>
#include <string.h>

enum { TRIANGLES_MOST = 1 << 29 };

/* ------- from polygons to triangles ------- */

typedef struct fan {
    const dp_polygons *polygons;
    uint32_t *corners;
    uint32_t *kinds; /* two a triangle */
    dp_gl_mesh *mesh;
    uint32_t count;
} fan;

/* Bits of edge `corner`, if that edge of the polygon is edge k of a triangle. */
static uint32_t edge_bits(const dp_polygons *p, uint32_t corner, uint32_t k) {
    if (!dp_edge_may_be_line(p, corner)) return 0;
    const bool diagonal = !dp_edge_is_flagged(p, corner);
    return 1u << k | (diagonal ? 8u << k : 0);
}

static void add_triangle(fan *f, uint32_t polygon, uint32_t i) {
    const dp_polygons *const p = f->polygons;
    const uint32_t first = dp_first_corner(p, polygon), n = dp_corner_count(p, polygon),
                   t = f->count++;
    const uint32_t at[3] = {first, first + i + 1, first + i + 2};
    uint32_t bits = edge_bits(p, at[1], 1);
    if (i == 0) bits |= edge_bits(p, at[0], 0);
    if (i + 3 == n) bits |= edge_bits(p, at[2], 2);
    for (int k = 0; k < 3; k++) f->corners[3 * (size_t)t + k] = dp_corner_vertex(p, at[k]);
    if (dp_is_section_face(p, polygon)) bits |= DP_GL_KIND_FACE;
    f->kinds[2 * (size_t)t] = polygon;
    f->kinds[2 * (size_t)t + 1] = bits | (uint32_t)(p->groups ? p->groups[polygon] : 0) << 16;
    f->mesh->source_polygon[t] = p->source_polygon ? p->source_polygon[polygon] : polygon;
    if (f->mesh->polygon_firsts) f->mesh->polygon_firsts[t] = t - i;
}

static size_t count_triangles(const dp_polygons *p) {
    size_t count = 0;
    if (!p->firsts) return p->count;
    for (uint32_t i = 0; i < p->count; i++) {
        const uint32_t n = dp_corner_count(p, i);
        count += n > 2 ? n - 2 : 0;
    }
    return count;
}

static bool reserve_host(dp_gl_mesh *m, size_t triangles, bool fans) {
    const dp_allocator *const memory = &m->gl->memory;
    dp_free(memory, m->source_polygon), dp_free(memory, m->polygon_firsts);
    m->polygon_firsts = NULL;
    m->source_polygon = dp_alloc_array(memory, triangles + 1, sizeof *m->source_polygon);
    if (fans) m->polygon_firsts = dp_alloc_array(memory, triangles + 1, sizeof *m->polygon_firsts);
    return m->source_polygon && (!fans || m->polygon_firsts);
}

static uint64_t fingerprint(const uint32_t *words, size_t count, uint64_t hash) {
    for (size_t i = 0; i < count; i++) hash = (hash ^ words[i]) * 0x9e3779b97f4a7c15u;
    return hash ^ hash >> 32;
}

/* Uploads corners and kinds, unless they are what is there. */
static dp_result upload_topology(dp_gl_mesh *m, const fan *f, dp_diag *diag) {
    dp_gl *const gl = m->gl;
    const uint64_t print =
        fingerprint(f->kinds, 2 * (size_t)f->count,
                    fingerprint(f->corners, 3 * (size_t)f->count, 0x100000001b3u + f->count));
    if (m->owned && m->topology && print == m->fingerprint) return DP_OK;
    dp_result result = dp_gl_buffer_fill(gl, &m->corners, f->corners, 12 * (size_t)f->count,
                                         "corners of a mesh", diag);
    if (!result)
        result = dp_gl_buffer_fill(gl, &m->triangles, f->kinds, 8 * (size_t)f->count,
                                   "triangles of a mesh", diag);
    m->fingerprint = result ? 0 : print;
    m->topology = dp_gl_number(gl);
    gl->drawn = false; /* numbers of the last picture's triangles lead nowhere now */
    return result;
}

static dp_result upload_positions(dp_gl_mesh *m, const dp_polygons *p, dp_diag *diag) {
    const dp_allocator *const memory = &m->gl->memory;
    float *packed = NULL;
    const float *positions = p->positions;
    m->written = dp_written_of(p);
    if (p->stride != 12) {
        packed = dp_alloc_array(memory, (size_t)p->vertex_count + 1, 12);
        if (!packed) return dp_fail(diag, DP_ERR_MEMORY, "out of memory for a mesh's positions");
        for (uint32_t v = 0; v < p->vertex_count; v++)
            memcpy(packed + 3 * (size_t)v, dp_vertex_position(p, v), 12);
        positions = packed;
    }
    const dp_result result = dp_gl_buffer_fill(
        m->gl, &m->positions, positions, 12 * (size_t)p->vertex_count, "positions of a mesh", diag);
    dp_free(memory, packed);
    return result;
}

static dp_result upload_polygons(dp_gl_mesh *m, const dp_polygons *p, dp_diag *diag) {
    const dp_allocator *const memory = &m->gl->memory;
    const size_t triangles = count_triangles(p);
    if (triangles > TRIANGLES_MOST)
        return dp_fail(diag, DP_ERR_LIMIT, "%zu triangles; the most are %d", triangles,
                       TRIANGLES_MOST);
    fan f = {p, dp_alloc_array(memory, triangles + 1, 12), dp_alloc_array(memory, triangles + 1, 8),
             m, 0};
    dp_result result = DP_OK;
    if (!f.corners || !f.kinds || !reserve_host(m, triangles, p->firsts != NULL))
        result =
            dp_fail(diag, DP_ERR_MEMORY, "out of memory for a mesh of %zu triangles", triangles);
    for (uint32_t i = 0; i < p->count && !result; i++)
        for (uint32_t k = 0; k + 2 < dp_corner_count(p, i); k++) add_triangle(&f, i, k);
    if (!result) result = upload_topology(m, &f, diag);
    if (!result) result = upload_positions(m, p, diag);
    m->triangle_count = f.count, m->vertex_count = p->vertex_count;
    dp_free(memory, f.corners), dp_free(memory, f.kinds);
    return result;
}

/* ------- sources ------- */

static dp_result take_colors(dp_gl_mesh *m, dp_source *source, const dp_polygons *p,
                             dp_diag *diag) {
    uint32_t most = 0;
    for (uint32_t i = 0; p->groups && i < p->count; i++)
        if (p->groups[i] > most) most = p->groups[i];
    dp_free(&m->gl->memory, m->group_colors);
    m->group_count = most + 1;
    m->group_colors = dp_alloc_array(&m->gl->memory, m->group_count, sizeof *m->group_colors);
    if (!m->group_colors) return dp_fail(diag, DP_ERR_MEMORY, "out of memory for groups' colours");
    for (uint32_t g = 0; g < m->group_count; g++)
        m->group_colors[g] = dp_source_group_color(source, g);
    return DP_OK;
}

/* What could not be read whole is empty. */
static void clear(dp_gl_mesh *m) {
    m->polygons = 0;
    m->vertex_count = m->triangle_count = 0;
    m->fingerprint = 0;
    if (!m->group_colors) m->group_count = 0;
    m->topology = dp_gl_number(m->gl);
    m->gl->drawn = false; /* as in upload_topology */
}

static dp_result take_source(dp_gl_mesh *m, dp_source *source, dp_diag *diag) {
    dp_polygon_store store = {0};
    dp_polygons polygons = {0};
    dp_stats stats = {0};
    dp_result result = dp_source_begin(source, m->origin, diag);
    if (!result) result = dp_gather(source, &store, &m->gl->memory, &polygons, &stats, diag);
    if (!result && polygons.mark_count)
        result = dp_fail(diag, DP_ERR_UNSUPPORTED,
                         "OpenGL does not draw sections and hatching; dp_draw does");
    if (!result) result = upload_polygons(m, &polygons, diag);
    if (!result) result = dp_gl_mesh_take_attributes(m, &polygons, diag);
    if (!result) result = take_colors(m, source, &polygons, diag);
    m->polygons = stats.polygons, m->pieces = polygons.count;
    if (result) clear(m);
    m->owned = true;
    m->placement = dp_gl_number(m->gl);
    m->from = (dp_gl_buffers){.positions = m->positions.name,
                              .positions_stride = 12,
                              .vertex_count = m->vertex_count,
                              .indices = m->corners.name,
                              .triangle_count = m->triangle_count};
    dp_polygon_store_free(&store, &m->gl->memory);
    return result;
}

static dp_gl_mesh *new_mesh(dp_gl *gl) {
    dp_gl_mesh *const m = dp_alloc_zeroed(&gl->memory, sizeof *m);
    if (!m) return NULL;
    m->gl = gl;
    m->next = gl->meshes;
    gl->meshes = m;
    return m;
}

dp_result dp_gl_mesh_from_source(dp_gl *gl, dp_source *source, dp_gl_mesh **out, dp_diag *diag) {
    if (!gl || !source || !out)
        return dp_fail(diag, DP_ERR_ARGUMENT, "dp_gl_mesh_from_source: gl, source or out is NULL");
    *out = NULL;
    dp_gl_mesh *const m = new_mesh(gl);
    if (!m) return dp_fail(diag, DP_ERR_MEMORY, "out of memory for a mesh");
    const dp_result result = dp_gl_mesh_update(m, source, diag);
    if (result)
        dp_gl_mesh_destroy(m);
    else
        *out = m;
    return result;
}

dp_result dp_gl_mesh_update(dp_gl_mesh *mesh, dp_source *source, dp_diag *diag) {
    dp_gl_state *state;
    if (!mesh || !source)
        return dp_fail(diag, DP_ERR_ARGUMENT, "dp_gl_mesh_update: mesh or source is NULL");
    if (!mesh->owned && mesh->from.positions)
        return dp_fail(diag, DP_ERR_ARGUMENT, "a mesh of the application's buffers has no source");
    dp_result result = dp_gl_enter(mesh->gl, &state, diag);
    if (result) return result;
    result = take_source(mesh, source, diag);
    dp_gl_leave(mesh->gl, state);
    return result;
}

/* ------- the application's buffers ------- */

static dp_result check_range(dp_gl *gl, uint32_t buffer, size_t offset, size_t stride, size_t count,
                             const char *what, dp_diag *diag) {
    GLint64 size = 0;
    if (offset % 4 || stride % 4)
        return dp_fail(diag, DP_ERR_ARGUMENT, "offset or stride of %s is no multiple of 4", what);
    if (!gl->api.IsBuffer(buffer))
        return dp_fail(diag, DP_ERR_ARGUMENT, "%u, which is to hold %s, is no buffer", buffer,
                       what);
    gl->api.BindBuffer(GL_COPY_READ_BUFFER, buffer);
    gl->api.GetBufferParameteri64v(GL_COPY_READ_BUFFER, GL_BUFFER_SIZE, &size);
    const size_t needed = count ? offset + (count - 1) * stride + 12 : 0;
    if (needed > (uint64_t)size)
        return dp_fail(diag, DP_ERR_ARGUMENT, "buffer %u has %lld bytes; %s would take %zu", buffer,
                       (long long)size, what, needed);
    return DP_OK;
}

static dp_result check_buffers(dp_gl *gl, dp_gl_buffers *b, dp_diag *diag) {
    if (!b->positions_stride) b->positions_stride = 12;
    if (!b->normals_stride) b->normals_stride = 12;
    if (b->positions_stride < 12 || b->normals_stride < 12)
        return dp_fail(diag, DP_ERR_ARGUMENT, "a stride is less than 12 bytes");
    if (b->triangle_count > TRIANGLES_MOST)
        return dp_fail(diag, DP_ERR_LIMIT, "%u triangles; the most are %d", b->triangle_count,
                       TRIANGLES_MOST);
    if (!b->indices && (uint64_t)b->triangle_count * 3 > b->vertex_count)
        return dp_fail(diag, DP_ERR_ARGUMENT,
                       "%u triangles without indices have more than %u vertices", b->triangle_count,
                       b->vertex_count);
    dp_result result = check_range(gl, b->positions, b->positions_offset, b->positions_stride,
                                   b->vertex_count, "positions", diag);
    if (!result && b->indices)
        result =
            check_range(gl, b->indices, b->indices_offset, 12, b->triangle_count, "indices", diag);
    if (!result && b->normals)
        result = check_range(gl, b->normals, b->normals_offset, b->normals_stride, b->vertex_count,
                             "normals", diag);
    return result;
}

dp_result dp_gl_mesh_check(dp_gl_mesh *mesh, dp_diag *diag) {
    return mesh->owned ? DP_OK : check_buffers(mesh->gl, &mesh->from, diag);
}

dp_result dp_gl_mesh_from_buffers(dp_gl *gl, const dp_gl_buffers *buffers, dp_gl_mesh **out,
                                  dp_diag *diag) {
    dp_gl_state *state;
    if (!gl || !buffers || !out)
        return dp_fail(diag, DP_ERR_ARGUMENT,
                       "dp_gl_mesh_from_buffers: gl, buffers or out is NULL");
    *out = NULL;
    dp_gl_buffers from = *buffers;
    dp_result result = dp_gl_enter(gl, &state, diag);
    if (result) return result;
    result = check_buffers(gl, &from, diag);
    dp_gl_leave(gl, state);
    if (result) return result;
    dp_gl_mesh *const m = new_mesh(gl);
    if (!m) return dp_fail(diag, DP_ERR_MEMORY, "out of memory for a mesh");
    m->from = from;
    m->vertex_count = from.vertex_count, m->triangle_count = from.triangle_count;
    m->polygons = m->pieces = from.triangle_count;
    m->topology = dp_gl_number(gl), m->placement = dp_gl_number(gl);
    m->shading.version = dp_gl_number(gl), m->shading.is_foreign = true;
    *out = m;
    return DP_OK;
}

void dp_gl_mesh_topology_changed(dp_gl_mesh *mesh) {
    if (mesh) mesh->topology = dp_gl_number(mesh->gl);
}

dp_result dp_gl_mesh_place(dp_gl_mesh *mesh, const double *matrix, dp_diag *diag) {
    if (!mesh) return dp_fail(diag, DP_ERR_ARGUMENT, "dp_gl_mesh_place: mesh is NULL");
    mesh->placement = dp_gl_number(mesh->gl);
    mesh->placed = false;
    if (!matrix) return DP_OK;
    const double *const m = matrix;
    const double turn = m[0] * (m[5] * m[10] - m[9] * m[6]) - m[4] * (m[1] * m[10] - m[9] * m[2]) +
                        m[8] * (m[1] * m[6] - m[5] * m[2]);
    for (int i = 0; i < 16; i++)
        if (!isfinite(m[i])) return dp_fail(diag, DP_ERR_ARGUMENT, "a mesh's matrix is not finite");
    if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1 || !(turn > 0))
        return dp_fail(diag, DP_ERR_ARGUMENT,
                       "a mesh's matrix must be affine, and neither singular nor mirror");
    memcpy(mesh->matrix, matrix, sizeof mesh->matrix);
    mesh->placed = true;
    return DP_OK;
}

void dp_gl_mesh_destroy(dp_gl_mesh *mesh) {
    if (!mesh) return;
    dp_gl *const gl = mesh->gl;
    dp_gl_mesh **at = &gl->meshes;
    while (*at && *at != mesh) at = &(*at)->next;
    if (*at) *at = mesh->next;
    gl->scene.count = 0; /* it may be among them */
    gl->drawn = false;
    dp_gl_buffer *const buffers[] = {&mesh->positions,   &mesh->corners,   &mesh->triangles,
                                     &mesh->normals,     &mesh->texcoords, &mesh->colors,
                                     &mesh->shading.made};
    for (size_t i = 0; i < sizeof buffers / sizeof *buffers && !gl->is_lost; i++)
        dp_gl_buffer_free(gl, buffers[i]);
    dp_free(&gl->memory, mesh->polygon_firsts);
    dp_free(&gl->memory, mesh->source_polygon);
    dp_free(&gl->memory, mesh->group_colors);
    dp_free(&gl->memory, mesh);
}
