/* What corners carry besides positions, for shading: normals, texture coordinates, colours.
 *
 * A mesh has them by corner of its triangles (colours by vertex), uploaded when its source is read. Normals that a style wants
 * and the source has not are computed when they are first needed, by mesh/normals.c as for dp_draw: positions and corners are
 * read back for that, so that nothing of the source need be kept. Of an application's buffers none are computed: it gives
 * normals, or polygons have their own.
 *
 * A picture has those of its meshes one after the other, as its corners are, with normals turned as the meshes stand.
 * Invariant: `key` names what the picture's arrays were made of (versions, placements, topologies and the style's normals), and
 * is 0 where an application's buffers, which may change any time, are among it. */
#include "gl/mesh.h"
#include "gl/scene.h"
#include "gl/shading.h"

#include "base/threads.h"
#include "mesh/normals.h"
#include "mesh/source.h"

#include <string.h>

/* ------- a mesh's own ------- */

typedef struct packed_normal {
    int16_t n[3];
    uint16_t lacks; /* 1: a computed one is to be taken */
} packed_normal;

/* Visits the corners of all triangles, as mesh.c makes fans of polygons. */
typedef void corner_visitor(void *arg, size_t to, uint32_t corner, uint32_t vertex);

static void for_corners(const dp_polygons *p, corner_visitor *visit, void *arg) {
    size_t to = 0;
    for (uint32_t i = 0; i < p->count; i++) {
        const uint32_t first = dp_first_corner(p, i), n = dp_corner_count(p, i);
        for (uint32_t k = 0; k + 2 < n; k++) {
            const uint32_t corners[3] = {first, first + k + 1, first + k + 2};
            for (int c = 0; c < 3; c++)
                visit(arg, to++, corners[c], dp_corner_vertex(p, corners[c]));
        }
    }
}

typedef struct normal_job {
    const dp_polygons *polygons;
    const dp_packed_normals *packed;
    packed_normal *out;
    bool lacks;
} normal_job;

static void put_normal(void *arg, size_t to, uint32_t corner, uint32_t vertex) {
    normal_job *const j = arg;
    const dp_attribute *const a = &j->polygons->normals;
    const bool shared = vertex < j->polygons->vertex_count && !j->packed->vertex[vertex][3];
    const int16_t *const n = shared ? j->packed->vertex[vertex] : j->packed->corner[corner];
    packed_normal *const out = &j->out[to];
    memcpy(out->n, n, sizeof out->n);
    out->lacks = a->indices && a->indices[corner] == UINT32_MAX;
    j->lacks |= out->lacks;
}

/* polygons->normals to a buffer. */
static dp_result upload_normals(dp_gl_mesh *m, const dp_polygons *polygons, dp_normal_store *store,
                                dp_threads *threads, dp_gl_buffer *to, bool *lacks, dp_diag *diag) {
    dp_gl *const gl = m->gl;
    const size_t corners = 3 * (size_t)m->triangle_count;
    normal_job job = {polygons, &store->packed,
                      dp_alloc_array(&gl->memory, corners + 1, sizeof *job.out), false};
    if (!job.out || !dp_normals_pack(store, polygons, threads, &gl->memory)) {
        dp_free(&gl->memory, job.out);
        return dp_fail(diag, DP_ERR_MEMORY, "out of memory for normals");
    }
    for_corners(polygons, put_normal, &job);
    const dp_result result =
        dp_gl_buffer_fill(gl, to, job.out, corners * sizeof *job.out, "normals of a mesh", diag);
    if (lacks) *lacks = job.lacks;
    dp_free(&gl->memory, job.out);
    return result;
}

typedef struct texcoord_job {
    const dp_attribute *texcoords;
    float (*out)[2];
} texcoord_job;

static void put_texcoord(void *arg, size_t to, uint32_t corner, uint32_t vertex) {
    const texcoord_job *const j = arg;
    const uint32_t i = dp_attribute_number(j->texcoords, corner, vertex);
    j->out[to][0] = j->out[to][1] = DP_FAR; /* NO_TEXCOORD */
    if (i != UINT32_MAX) memcpy(j->out[to], dp_attribute_value(j->texcoords, i), sizeof j->out[to]);
}

static dp_result upload_texcoords(dp_gl_mesh *m, const dp_polygons *polygons, dp_diag *diag) {
    dp_gl *const gl = m->gl;
    const size_t corners = 3 * (size_t)m->triangle_count;
    texcoord_job job = {&polygons->texcoords,
                        dp_alloc_array(&gl->memory, corners + 1, sizeof *job.out)};
    if (!job.out) return dp_fail(diag, DP_ERR_MEMORY, "out of memory for texture coordinates");
    for_corners(polygons, put_texcoord, &job);
    const dp_result result =
        dp_gl_buffer_fill(gl, &m->texcoords, job.out, corners * sizeof *job.out,
                          "texture coordinates of a mesh", diag);
    dp_free(&gl->memory, job.out);
    return result;
}

dp_result dp_gl_mesh_take_attributes(dp_gl_mesh *mesh, const dp_polygons *polygons, dp_diag *diag) {
    dp_result result = DP_OK;
    mesh->shading.version = dp_gl_number(mesh->gl);
    mesh->has_normals = polygons->normals.values && mesh->triangle_count;
    mesh->has_texcoords = polygons->texcoords.values != NULL;
    mesh->has_colors = polygons->colors != NULL;
    mesh->shading.lacks = false;
    if (mesh->has_normals) {
        dp_normal_store store = {0};
        dp_threads *const threads = dp_threads_create(1, NULL, NULL, &mesh->gl->memory);
        result = threads ? upload_normals(mesh, polygons, &store, threads, &mesh->normals,
                                          &mesh->shading.lacks, diag)
                         : dp_fail(diag, DP_ERR_MEMORY, "out of memory for normals");
        dp_normal_store_free(&store, &mesh->gl->memory);
        dp_threads_destroy(threads);
    }
    if (!result && mesh->has_texcoords) result = upload_texcoords(mesh, polygons, diag);
    if (!result && mesh->has_colors)
        result = dp_gl_buffer_fill(mesh->gl, &mesh->colors, polygons->colors,
                                   4 * (size_t)mesh->vertex_count, "colours of a mesh", diag);
    return result;
}

/* ------- computed normals ------- */

/* Polygons as they lie on the device. */
typedef struct read_back {
    float *positions;
    uint32_t *triangles;        /* [3 * triangle] vertex */
    uint32_t *corners, *firsts; /* NULL: triangles are the polygons */
    dp_polygons polygons;
} read_back;

static void free_read(dp_gl *gl, read_back *r) {
    dp_free(&gl->memory, r->positions), dp_free(&gl->memory, r->triangles);
    dp_free(&gl->memory, r->corners), dp_free(&gl->memory, r->firsts);
}

/* Puts the fans' triangles together to polygons again. */
static void join_fans(const dp_gl_mesh *m, read_back *r) {
    dp_polygons *const p = &r->polygons;
    uint32_t corners = 0;
    for (uint32_t t = 0; t < m->triangle_count; t++) {
        const uint32_t *const from = r->triangles + 3 * (size_t)t;
        const bool begins = m->polygon_firsts[t] == t;
        if (begins) r->firsts[p->count++] = corners;
        for (int k = begins ? 0 : 2; k < 3; k++) r->corners[corners++] = from[k];
    }
    r->firsts[p->count] = corners;
    p->corners = r->corners, p->firsts = r->firsts;
}

static dp_result read_polygons(dp_gl_mesh *m, read_back *r, dp_diag *diag) {
    dp_gl *const gl = m->gl;
    const dp_allocator *const memory = &gl->memory;
    const size_t triangles = m->triangle_count, vertices = m->vertex_count;
    *r = (read_back){.positions = dp_alloc_array(memory, vertices + 1, 12),
                     .triangles = dp_alloc_array(memory, triangles + 1, 12)};
    if (m->polygon_firsts) {
        r->corners = dp_alloc_array(memory, triangles + 1, 12);
        r->firsts = dp_alloc_array(memory, triangles + 2, 4);
    }
    if (!r->positions || !r->triangles || (m->polygon_firsts && (!r->corners || !r->firsts)))
        return dp_fail(diag, DP_ERR_MEMORY, "out of memory for normals");
    dp_gl_buffer_read(gl, &m->positions, 0, 12 * vertices, r->positions);
    dp_gl_buffer_read(gl, &m->corners, 0, 12 * triangles, r->triangles);
    r->polygons = (dp_polygons){.positions = r->positions,
                                .stride = 12,
                                .vertex_count = m->vertex_count,
                                .corners = r->triangles,
                                .count = m->polygon_firsts ? 0 : m->triangle_count};
    if (m->polygon_firsts) join_fans(m, r);
    return DP_OK;
}

static dp_result compute_normals(dp_gl_mesh *m, float crease, dp_diag *diag) {
    dp_gl *const gl = m->gl;
    read_back read;
    dp_normal_store store = {0};
    dp_threads *const threads = dp_threads_create(0, NULL, NULL, &gl->memory);
    dp_result result = threads ? read_polygons(m, &read, diag)
                               : dp_fail(diag, DP_ERR_MEMORY, "no threads for normals");
    if (!result && !dp_normals_make(&store, &read.polygons, crease, NULL, threads, &gl->memory,
                                    &read.polygons.normals))
        result = dp_fail(diag, DP_ERR_MEMORY, "out of memory for normals");
    if (!result)
        result = upload_normals(m, &read.polygons, &store, threads, &m->shading.made, NULL, diag);
    dp_normal_store_free(&store, &gl->memory);
    if (threads) free_read(gl, &read);
    dp_threads_destroy(threads);
    m->shading.made_from = result ? 0 : m->shading.version;
    m->shading.crease = crease;
    return result;
}

static bool needs_made(const dp_gl *gl, const dp_gl_mesh *m) {
    const bool smooth = gl->style.shade.normals == DP_NORMALS_SMOOTH;
    return !m->shading.is_foreign && m->triangle_count &&
           (smooth || !m->has_normals || m->shading.lacks);
}

static dp_result make_normals(dp_gl *gl, dp_gl_mesh *m, dp_diag *diag) {
    const dp_gl_mesh_normals *const s = &m->shading;
    const float crease = gl->style.shade.crease_angle;
    if (s->is_foreign && gl->style.shade.normals == DP_NORMALS_SMOOTH)
        return dp_fail(diag, DP_ERR_UNSUPPORTED,
                       "OpenGL does not compute smooth normals of an application's buffers: give "
                       "dp_gl_buffers.normals, or take those of facets");
    if (!needs_made(gl, m)) return DP_OK;
    return s->made_from == s->version && s->crease == crease ? DP_OK
                                                             : compute_normals(m, crease, diag);
}

/* ------- the picture's ------- */

void dp_gl_turn_of(const dp_gl_mesh *m, double rows[3][3]) {
    const double *const a = m->matrix; /* column-major: entry (r, c) is a[4 c + r] */
    for (int r = 0; r < 3; r++) {
        const int r1 = (r + 1) % 3, r2 = (r + 2) % 3;
        for (int c = 0; c < 3; c++) {
            const int c1 = (c + 1) % 3, c2 = (c + 2) % 3;
            rows[r][c] = m->placed
                             ? a[4 * c1 + r1] * a[4 * c2 + r2] - a[4 * c2 + r1] * a[4 * c1 + r2]
                             : (double)(r == c);
        }
    }
}

static void put_turn(dp_gl *gl, uint32_t program, const dp_gl_mesh *m) {
    static const char *const names[3] = {"row0", "row1", "row2"};
    double rows[3][3];
    dp_gl_turn_of(m, rows);
    dp_gl_uniform_u(gl, program, "is_turned", m->placed);
    for (int r = 0; r < 3; r++) {
        const float row[4] = {(float)rows[r][0], (float)rows[r][1], (float)rows[r][2], 0};
        dp_gl_uniform_4f(gl, program, names[r], row);
    }
}

static void put_normals(dp_gl *gl, uint32_t program, const dp_gl_mesh *m, uint32_t first_vertex,
                        uint32_t first_corner) {
    const dp_gl_buffer *const out = &gl->shading->attributes.normals;
    const bool made = needs_made(gl, m),
               own = m->has_normals && gl->style.shade.normals == DP_NORMALS_MODEL;
    const bool floats = !m->owned && m->from.normals && !own;
    const uint32_t source = own      ? m->normals.name
                            : floats ? m->from.normals
                            : made   ? m->shading.made.name
                                     : gl->scene.corners.name;
    put_turn(gl, program, m);
    dp_gl_uniform_u(gl, program, "kind", floats ? 2 : own || made);
    dp_gl_uniform_u(gl, program, "mends", own && made);
    dp_gl_uniform_u(gl, program, "first_vertex", first_vertex);
    dp_gl_uniform_u(gl, program, "first_corner", first_corner);
    dp_gl_uniform_u(gl, program, "corner_count", 3 * m->triangle_count);
    dp_gl_uniform_u(gl, program, "at", (uint32_t)(m->from.normals_offset / 4));
    dp_gl_uniform_u(gl, program, "stride", m->from.normals_stride / 4);
    gl->api.BindBufferBase(GL_SHADER_STORAGE_BUFFER, DP_GL_BIND_OWN, source);
    gl->api.BindBufferBase(GL_SHADER_STORAGE_BUFFER, DP_GL_BIND_OWN + 1,
                           made ? m->shading.made.name : gl->scene.corners.name);
    dp_gl_buffer_bind(gl, out, DP_GL_BIND_OWN + 2);
    dp_gl_dispatch(gl, 3 * m->triangle_count);
}

static dp_result gather_normals(dp_gl *gl, dp_diag *diag) {
    static const dp_gl_program_desc desc = {.compute = "attributes.comp"};
    uint32_t program, vertices = 0, corners = 0;
    dp_result result =
        dp_gl_buffer_reserve(gl, &gl->shading->attributes.normals,
                             24 * (size_t)gl->scene.triangle_count, "normals of the picture", diag);
    if (!result) result = dp_gl_program(gl, &desc, &program, diag);
    if (result) return result;
    dp_gl_use(gl, program);
    dp_gl_scene_bind(gl);
    for (size_t i = 0; i < gl->scene.count; i++) {
        const dp_gl_mesh *const m = gl->scene.meshes[i];
        put_normals(gl, program, m, vertices, corners);
        vertices += m->vertex_count, corners += 3 * m->triangle_count;
    }
    return DP_OK;
}

/* Puts the meshes' arrays behind each other; `word` where a mesh has none. */
static dp_result gather(dp_gl *gl, dp_gl_buffer *to, size_t size, bool colors, uint32_t word,
                        const char *what, dp_diag *diag) {
    const dp_result result = dp_gl_buffer_reserve(gl, to, size, what, diag);
    size_t at = 0;
    if (result) return result;
    dp_gl_buffer_clear(gl, to, size, word);
    gl->api.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    for (size_t i = 0; i < gl->scene.count; i++) {
        const dp_gl_mesh *const m = gl->scene.meshes[i];
        const dp_gl_buffer *const from = colors ? &m->colors : &m->texcoords;
        const size_t bytes = colors ? 4 * (size_t)m->vertex_count : 24 * (size_t)m->triangle_count;
        if ((colors ? m->has_colors : m->has_texcoords) && bytes) {
            gl->api.BindBuffer(GL_COPY_READ_BUFFER, from->name);
            gl->api.BindBuffer(GL_COPY_WRITE_BUFFER, to->name);
            gl->api.CopyBufferSubData(GL_COPY_READ_BUFFER, GL_COPY_WRITE_BUFFER, 0, (GLintptr)at,
                                      (GLsizeiptr)bytes);
        }
        at += bytes;
    }
    return DP_OK;
}

/* Each group's colour: the model's, the style's, or the paper's. */
static dp_result gather_groups(dp_gl *gl, dp_diag *diag) {
    const dp_style *const style = &gl->style;
    const dp_color base = style->surface & 0xff ? style->surface : style->paper;
    uint32_t *const colors = dp_alloc_array(&gl->memory, 65536, sizeof *colors);
    if (!colors) return dp_fail(diag, DP_ERR_MEMORY, "out of memory for colours of groups");
    for (uint32_t g = 0; g < 65536; g++) colors[g] = base;
    for (size_t i = 0; i < gl->scene.count; i++) {
        const dp_gl_mesh *const m = gl->scene.meshes[i];
        const dp_gl_group_numbers numbers = dp_gl_groups_of(&gl->scene, i);
        for (uint32_t g = 0; !m->keeps_groups && g < m->group_count; g++) {
            const dp_color own = m->group_colors[g];
            const uint32_t number = g ? numbers.others + g : numbers.zero;
            if (own && number < 65536) colors[number] = own & 0xff ? own : style->paper;
        }
    }
    const dp_result result = dp_gl_buffer_fill(gl, &gl->shading->attributes.groups, colors,
                                               65536 * sizeof *colors, "colours of groups", diag);
    dp_free(&gl->memory, colors);
    return result;
}

static uint64_t mix(uint64_t hash, uint64_t value) {
    hash = (hash ^ value) * 0x9e3779b97f4a7c15u;
    return hash ^ hash >> 32;
}

/* What the picture's arrays are made of; 0: of what may change any time. */
static uint64_t key_of(const dp_gl *gl, bool normals) {
    uint64_t hash = mix(1, gl->scene.count);
    uint32_t crease;
    memcpy(&crease, &gl->style.shade.crease_angle, sizeof crease);
    if (normals) hash = mix(mix(hash, gl->style.shade.normals), crease);
    for (size_t i = 0; i < gl->scene.count; i++) {
        const dp_gl_mesh *const m = gl->scene.meshes[i];
        if (normals && !m->owned && m->from.normals) return 0;
        hash = mix(mix(hash, m->shading.version), m->topology);
        if (normals) hash = mix(hash, m->placement);
    }
    return hash ? hash : 1;
}

typedef enum attribute_kind { NORMALS, TEXCOORDS, COLORS } attribute_kind;

static bool is_known(dp_gl *gl, attribute_kind kind) {
    uint64_t *const key = &gl->shading->attributes.key[kind], now = key_of(gl, kind == NORMALS);
    const bool known = now && now == *key;
    *key = now;
    return known;
}

static bool any_has(const dp_gl *gl, attribute_kind kind) {
    bool any = false;
    for (size_t i = 0; i < gl->scene.count; i++)
        any |=
            kind == COLORS ? gl->scene.meshes[i]->has_colors : gl->scene.meshes[i]->has_texcoords;
    return any;
}

static dp_result gather_all(dp_gl *gl, bool textured, bool colored, dp_diag *diag) {
    dp_gl_scene_attributes *const a = &gl->shading->attributes;
    dp_result result = DP_OK;
    a->has_texcoords = textured && any_has(gl, TEXCOORDS);
    a->has_colors = colored && any_has(gl, COLORS);
    if (gl->style.shade.normals != DP_NORMALS_FACET) {
        for (size_t i = 0; i < gl->scene.count && !result; i++)
            result = make_normals(gl, gl->scene.meshes[i], diag);
        if (!result && !is_known(gl, NORMALS)) result = gather_normals(gl, diag);
    }
    if (!result && a->has_texcoords && !is_known(gl, TEXCOORDS)) {
        const float none = DP_FAR;
        uint32_t word;
        memcpy(&word, &none, sizeof word);
        result = gather(gl, &a->texcoords, 24 * (size_t)gl->scene.triangle_count, false, word,
                        "texture coordinates of the picture", diag);
    }
    if (!result && a->has_colors && !is_known(gl, COLORS))
        result = gather(gl, &a->colors, 4 * (size_t)gl->scene.vertex_count, true, 0,
                        "colours of the picture", diag);
    if (!result && colored) result = gather_groups(gl, diag);
    return result;
}

dp_result dp_gl_gather_attributes(dp_gl *gl, bool textured, bool colored, dp_diag *diag) {
    const dp_result result = gather_all(gl, textured, colored, diag);
    if (result) memset(gl->shading->attributes.key, 0, sizeof gl->shading->attributes.key);
    return result;
}

void dp_gl_attributes_free(dp_gl *gl, dp_gl_scene_attributes *a) {
    dp_gl_buffer *const buffers[] = {&a->normals, &a->texcoords, &a->colors, &a->groups};
    for (size_t i = 0; i < sizeof buffers / sizeof *buffers; i++) dp_gl_buffer_free(gl, buffers[i]);
    *a = (dp_gl_scene_attributes){0};
}
