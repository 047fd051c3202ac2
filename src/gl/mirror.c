/* A planar mirror (Nienhaus and Döllner 2003, 5), as draw/mirror.c has it.
 *
 *    meshes → images        on the device: vertices reflected, triangles cut at the plane and reversed (reflect.comp)
 *    images → picture       with lines of their own, by all the stages of a picture
 *    picture → `image`      faded and tinted
 *    meshes + mirror → picture, in which pixels of the mirror's group show `image` (shading.c)
 *
 * An image is made of each mesh, an application's buffers included, and again only where the mesh or the plane is another one;
 * positions that an application may have written are reflected for each picture. Mates, and what else stages keep from
 * picture to picture, are kept for both pictures: the two sets change places. Invariant: outside of dp_gl_begin_image and
 * dp_gl_end_image, gl holds the set of the picture with the mirror.
 *
 * Not here: reflections of reflections. */
#include "gl/mirror.h"

#include "draw/mirror.h"
#include "gl/ink.h"
#include "gl/lines.h"
#include "gl/scene.h"
#include "gl/shading.h"
#include "gl/surface.h"

#include <string.h>

/* What stages keep from picture to picture. */
typedef struct kept {
    dp_gl_scene scene;
    dp_gl_lines_store lines;
    dp_gl_quads *quads;
    dp_gl_fins *fins;
    dp_gl_scene_attributes attributes;
} kept;

/* What an image is made of. */
typedef struct image_key {
    uint64_t topology, version, placement;
    dp_plane_equation plane; /* about the scene's origin */
    double origin[3];
} image_key;

typedef struct image {
    dp_gl_mesh *mesh;
    dp_gl_buffer origins; /* [corner] of the mesh: the one that it was kept from */
    image_key key;
} image;

/* Of one mesh: shaders/reflection.glsl has the same, std140. */
typedef struct reflection_block {
    double placement[3][4], plane[4];
} reflection_block;

struct dp_gl_mirror {
    kept other; /* the set that gl does not hold */
    image *images;
    size_t images_cap, image_count;
    dp_gl_mesh **list; /* images, or meshes and the mirror */
    size_t list_cap;
    dp_gl_mesh *square;
    double corners[4][3], uploaded[4][3]; /* of the square, world space */
    dp_plane_equation plane;              /* world space */
    reflection_block block;
    dp_gl_buffer block_buffer;
    dp_gl_texture image;
    bool reflects; /* the reflected picture is being drawn */
    float light[3];
    uint32_t depth_texture;
};

bool dp_gl_is_image(const dp_gl *gl) { return gl->mirror && gl->mirror->reflects; }

static dp_result need_mirror(dp_gl *gl, dp_diag *diag) {
    if (gl->mirror) return DP_OK;
    gl->mirror = dp_alloc_zeroed(&gl->memory, sizeof *gl->mirror);
    if (!gl->mirror) return dp_fail(diag, DP_ERR_MEMORY, "out of memory for a mirror");
    gl->mirror->other.lines.topology = UINT64_MAX;
    return DP_OK;
}

static void exchange(dp_gl *gl) {
    kept *const o = &gl->mirror->other;
    const kept now = {gl->scene, gl->lines, gl->quads, gl->fins, gl->shading->attributes};
    gl->scene = o->scene, gl->lines = o->lines, gl->quads = o->quads, gl->fins = o->fins;
    gl->shading->attributes = o->attributes;
    *o = now;
}

/* ------- images of meshes ------- */

/* A mesh that is not on the list of the application's. */
static dp_gl_mesh *new_mesh(dp_gl *gl) {
    dp_gl_mesh *const m = dp_alloc_zeroed(&gl->memory, sizeof *m);
    if (m) m->gl = gl, m->owned = true;
    return m;
}

/* The plane about the scene's origin. */
static dp_plane_equation plane_about(const dp_plane_equation *plane, const double origin[3]) {
    dp_plane_equation p = *plane;
    for (int k = 0; k < 3; k++) p.offset -= p.n[k] * origin[k];
    return p;
}

static dp_result reserve_image(dp_gl *gl, const dp_gl_mesh *from, image *to, dp_diag *diag) {
    dp_gl_mesh *const m = to->mesh;
    const size_t triangles = 2 * (size_t)from->triangle_count,
                 vertices = from->vertex_count + triangles;
    if (vertices > UINT32_MAX / 2 || triangles > UINT32_MAX / 8)
        return dp_fail(diag, DP_ERR_LIMIT, "the image of %u triangles is too large for a mirror",
                       from->triangle_count);
    const char *const what = "a mirror image";
    dp_result result = dp_gl_buffer_reserve(gl, &m->positions, 12 * vertices + 16, what, diag);
    if (!result) result = dp_gl_buffer_reserve(gl, &m->corners, 12 * triangles + 16, what, diag);
    if (!result) result = dp_gl_buffer_reserve(gl, &m->triangles, 8 * triangles + 16, what, diag);
    if (!result) result = dp_gl_buffer_reserve(gl, &to->origins, 12 * triangles + 16, what, diag);
    m->vertex_count = (uint32_t)vertices, m->triangle_count = (uint32_t)triangles;
    m->from = (dp_gl_buffers){.positions = m->positions.name,
                              .positions_stride = 12,
                              .vertex_count = m->vertex_count,
                              .indices = m->corners.name,
                              .triangle_count = m->triangle_count};
    return result;
}

static void bind(dp_gl *gl, uint32_t binding, uint32_t buffer) {
    gl->api.BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, buffer);
}

static uint32_t indices_at(const dp_gl_mesh *m) {
    return m->from.indices ? (uint32_t)(m->from.indices_offset / 4) : UINT32_MAX;
}

static dp_result use(dp_gl *gl, const dp_gl_program_desc *desc, uint32_t *program, dp_diag *diag) {
    const dp_result result = dp_gl_program(gl, desc, program, diag);
    if (result) return result;
    dp_gl_use(gl, *program);
    gl->api.BindBufferBase(GL_UNIFORM_BUFFER, 1, gl->mirror->block_buffer.name);
    return DP_OK;
}

static dp_result reflect_vertices(dp_gl *gl, const dp_gl_mesh *from, bool moves, const image *to,
                                  dp_diag *diag) {
    static const dp_gl_program_desc desc = {.compute = "reflect_vertices.comp"};
    uint32_t program;
    const dp_result result = use(gl, &desc, &program, diag);
    if (result) return result;
    dp_gl_uniform_u(gl, program, "is_placed", moves);
    dp_gl_uniform_u(gl, program, "vertex_count", from->vertex_count);
    dp_gl_uniform_u(gl, program, "positions_at", (uint32_t)(from->from.positions_offset / 4));
    dp_gl_uniform_u(gl, program, "stride", from->from.positions_stride / 4);
    bind(gl, 0, from->from.positions);
    bind(gl, 3, to->mesh->positions.name);
    dp_gl_dispatch(gl, from->vertex_count);
    return DP_OK;
}

static dp_result reflect_triangles(dp_gl *gl, const dp_gl_mesh *from, const image *to,
                                   dp_diag *diag) {
    static const dp_gl_program_desc desc = {.compute = "reflect.comp"};
    const dp_gl_mesh *const m = to->mesh;
    uint32_t program;
    const dp_result result = use(gl, &desc, &program, diag);
    if (result) return result;
    dp_gl_uniform_u(gl, program, "vertex_count", from->vertex_count);
    dp_gl_uniform_u(gl, program, "triangle_count", from->triangle_count);
    dp_gl_uniform_u(gl, program, "indices_at", indices_at(from));
    dp_gl_uniform_u(gl, program, "has_kinds", from->owned);
    bind(gl, 1, from->from.indices ? from->from.indices : m->corners.name);
    bind(gl, 2, from->owned ? from->triangles.name : m->triangles.name);
    bind(gl, 3, m->positions.name);
    bind(gl, 4, m->corners.name);
    bind(gl, 5, m->triangles.name);
    bind(gl, 6, to->origins.name);
    dp_gl_dispatch(gl, from->triangle_count);
    return DP_OK;
}

/* Rows of the matrix that turns normals as the mesh stands, and reflects them. */
static void put_turn(dp_gl *gl, uint32_t program, const dp_gl_mesh *from) {
    static const char *const names[3] = {"row0", "row1", "row2"};
    double turn[3][3];
    const double *const n = gl->mirror->plane.n;
    dp_gl_turn_of(from, turn);
    for (int r = 0; r < 3; r++) {
        float row[4] = {0};
        for (int c = 0; c < 3; c++) {
            double sum = turn[r][c];
            for (int k = 0; k < 3; k++) sum -= 2 * n[r] * n[k] * turn[k][c];
            row[c] = (float)sum;
        }
        dp_gl_uniform_4f(gl, program, names[r], row);
    }
}

/* One attribute of the corners. */
static dp_result reflect_attribute(dp_gl *gl, const dp_gl_mesh *from, const image *to,
                                   const char *kind, uint32_t source, dp_gl_buffer *out,
                                   size_t size, dp_diag *diag) {
    const dp_gl_program_desc desc = {.compute = "reflect_attributes.comp", .defines = kind};
    uint32_t program;
    dp_result result = dp_gl_buffer_reserve(gl, out, size + 16, "a mirror image", diag);
    if (!result) result = use(gl, &desc, &program, diag);
    if (result) return result;
    dp_gl_uniform_u(gl, program, "corner_count", 3 * to->mesh->triangle_count);
    dp_gl_uniform_u(gl, program, "vertex_count", from->vertex_count);
    dp_gl_uniform_u(gl, program, "indices_at", indices_at(from));
    dp_gl_uniform_u(gl, program, "by_vertex", !from->owned);
    dp_gl_uniform_u(gl, program, "at", (uint32_t)(from->from.normals_offset / 4));
    dp_gl_uniform_u(gl, program, "stride", from->from.normals_stride / 4);
    put_turn(gl, program, from);
    bind(gl, 3, source);
    bind(gl, 4, to->mesh->corners.name);
    bind(gl, 5, out->name);
    bind(gl, 6, to->origins.name);
    bind(gl, 7, from->from.indices ? from->from.indices : to->mesh->corners.name);
    dp_gl_dispatch(gl, 3 * to->mesh->triangle_count);
    return DP_OK;
}

static dp_result reflect_attributes(dp_gl *gl, const dp_gl_mesh *from, const image *to,
                                    dp_diag *diag) {
    dp_gl_mesh *const m = to->mesh;
    const bool floats = !from->owned && from->from.normals;
    const size_t corners = 3 * (size_t)m->triangle_count;
    dp_result result = DP_OK;
    m->has_normals = (from->has_normals || floats) && m->triangle_count;
    m->has_texcoords = from->has_texcoords, m->has_colors = from->has_colors;
    m->shading.lacks = from->shading.lacks;
    m->shading.is_foreign = from->shading.is_foreign;
    m->shading.version = dp_gl_number(gl);
    if (m->has_normals)
        result = reflect_attribute(gl, from, to, "#define NORMALS\n",
                                   floats ? from->from.normals : from->normals.name, &m->normals,
                                   8 * corners, diag);
    if (!result && m->has_texcoords)
        result = reflect_attribute(gl, from, to, "#define TEXCOORDS\n", from->texcoords.name,
                                   &m->texcoords, 8 * corners, diag);
    if (!result && m->has_colors) { /* of vertices that no corner has, none is seen */
        result = dp_gl_buffer_reserve(gl, &m->colors, 4 * (size_t)m->vertex_count + 16,
                                      "a mirror image", diag);
        if (!result) dp_gl_buffer_clear(gl, &m->colors, 4 * (size_t)m->vertex_count, 0);
        if (!result)
            result = reflect_attribute(gl, from, to, "#define COLORS\n", from->colors.name,
                                       &m->colors, 4 * (size_t)m->vertex_count, diag);
    }
    return result;
}

/* Does the image still hold? Of positions that the application may have written, no. */
static bool is_current(const image *i, const dp_gl_mesh *from, const image_key *key) {
    return from->owned && i->mesh->topology && !memcmp(&i->key, key, sizeof *key);
}

static dp_result make_image(dp_gl *gl, const dp_gl_mesh *from, const double origin[3], image *to,
                            dp_diag *diag) {
    dp_gl_mirror *const s = gl->mirror;
    image_key key;
    memset(&key, 0, sizeof key);
    key.topology = from->topology, key.version = from->shading.version;
    key.placement = from->placement;
    key.plane = plane_about(&s->plane, origin);
    memcpy(key.origin, origin, sizeof key.origin);
    if (!to->mesh && !(to->mesh = new_mesh(gl)))
        return dp_fail(diag, DP_ERR_MEMORY, "out of memory for a mirror image");
    dp_gl_mesh *const m = to->mesh;
    m->group_colors = from->group_colors; /* borrowed */
    m->group_count = from->group_count;
    m->polygons = from->polygons, m->pieces = from->pieces;
    if (is_current(to, from, &key)) return DP_OK;
    m->topology = 0;
    const bool moves = dp_gl_placement_of(from, origin, s->block.placement);
    memcpy(s->block.plane, key.plane.n, sizeof key.plane.n);
    s->block.plane[3] = key.plane.offset;
    dp_result result =
        dp_gl_buffer_fill(gl, &s->block_buffer, &s->block, sizeof s->block, "a mirror", diag);
    if (!result) result = reserve_image(gl, from, to, diag);
    if (!result) result = reflect_vertices(gl, from, moves, to, diag);
    if (!result) result = reflect_triangles(gl, from, to, diag);
    if (!result) result = reflect_attributes(gl, from, to, diag);
    if (result) return result;
    memcpy(m->origin, origin, sizeof m->origin);
    to->key = key;
    m->topology = dp_gl_number(gl), m->placement = dp_gl_number(gl);
    return DP_OK;
}

static void free_image(dp_gl *gl, image *i) {
    if (!i->mesh) return;
    if (!gl->is_lost) dp_gl_buffer_free(gl, &i->origins);
    i->mesh->group_colors = NULL;
    dp_gl_mesh_destroy(i->mesh);
    *i = (image){0};
}

static dp_result make_images(dp_gl *gl, dp_gl_mesh *const *meshes, size_t count, dp_diag *diag) {
    dp_gl_mirror *const s = gl->mirror;
    static const double zero[3] = {0, 0, 0};
    while (s->image_count > count) free_image(gl, &s->images[--s->image_count]);
    if (!dp_reserve(&gl->memory, &s->images, &s->images_cap, count + 1, sizeof *s->images) ||
        !dp_reserve(&gl->memory, &s->list, &s->list_cap, count + 1, sizeof *s->list))
        return dp_fail(diag, DP_ERR_MEMORY, "out of memory for a mirror");
    while (s->image_count < count) s->images[s->image_count++] = (image){0};
    for (size_t i = 0; i < count; i++) {
        const dp_result result =
            make_image(gl, meshes[i], count ? meshes[0]->origin : zero, &s->images[i], diag);
        if (result) return result;
        s->list[i] = s->images[i].mesh;
    }
    return DP_OK;
}

/* ------- the two pictures ------- */

dp_result dp_gl_begin_image(dp_gl *gl, dp_gl_mesh *const *meshes, size_t count,
                            const dp_camera *camera, dp_gl_mesh_list *out, dp_diag *diag) {
    dp_view view;
    dp_result result = dp_view_init(&view, camera, gl->target.width, gl->target.height, diag);
    if (!result) result = need_mirror(gl, diag);
    if (!result) result = dp_gl_need_shading(gl, diag);
    if (result) return result;
    dp_gl_mirror *const s = gl->mirror;
    s->plane = dp_mirror_plane(&gl->style.mirror, &view);
    dp_mirror_square(&gl->style.mirror, &s->plane, s->corners);
    s->reflects = true;
    exchange(gl);
    memcpy(s->light, gl->style.shade.light, sizeof s->light);
    s->depth_texture = gl->target.depth_texture;
    gl->target.depth_texture =
        0; /* what stands before the mirror does not hide the image behind it */
    dp_mirror_light(camera, &s->plane, gl->style.shade.light);
    result = make_images(gl, meshes, count, diag);
    *out = (dp_gl_mesh_list){s->list, count};
    return result;
}

dp_result dp_gl_take_image(dp_gl *gl, dp_diag *diag) {
    dp_gl_mirror *const s = gl->mirror;
    const dp_mirror *const mirror = &gl->style.mirror;
    const bool fades = mirror->fade > 0, eight = gl->style.edge_map.detector &&
                                                 gl->style.edge_map.eight_bits &&
                                                 dp_gl_is_shaded(gl);
    const dp_gl_program_desc desc = {.vertex = "whole.vert",
                                     .fragment = "tint.frag",
                                     .defines = !fades  ? NULL
                                                : eight ? "#define FADES\n#define EIGHT_BITS\n"
                                                        : "#define FADES\n"};
    const dp_plane_equation plane = plane_about(&s->plane, gl->scene.origin);
    uint32_t program;
    dp_result result = fades && !dp_gl_is_shaded(gl) ? dp_gl_gbuffer_fill(gl, diag) : DP_OK;
    memcpy(s->block.plane, plane.n, sizeof plane.n);
    s->block.plane[3] = plane.offset;
    if (!result)
        result =
            dp_gl_buffer_fill(gl, &s->block_buffer, &s->block, sizeof s->block, "a mirror", diag);
    if (!result) result = dp_gl_begin_pass(gl, &desc, &s->image, GL_RGBA8, &program, diag);
    if (result) return result;
    const float tint[4] = {(float)(mirror->tint >> 24 & 0xff) / 255,
                           (float)(mirror->tint >> 16 & 0xff) / 255,
                           (float)(mirror->tint >> 8 & 0xff) / 255, mirror->tint_share};
    gl->api.BindBufferBase(GL_UNIFORM_BUFFER, 1, s->block_buffer.name);
    if (eight) dp_gl_buffer_bind(gl, &gl->shading->range, 4);
    dp_gl_uniform_4f(gl, program, "tint", tint);
    dp_gl_uniform_f(gl, program, "fade", mirror->fade);
    dp_gl_texture_bind(gl, &gl->surface.picture, DP_GL_UNIT_PASS);
    dp_gl_uniform_i(gl, program, "colors", DP_GL_UNIT_PASS);
    dp_gl_draw_whole(gl);
    return DP_OK;
}

void dp_gl_end_image(dp_gl *gl) {
    dp_gl_mirror *const s = gl->mirror;
    if (!s || !s->reflects) return;
    s->reflects = false;
    exchange(gl);
    memcpy(gl->style.shade.light, s->light, sizeof s->light);
    gl->target.depth_texture = s->depth_texture;
}

/* The mirror: one polygon of four corners, as two triangles. */
static dp_result make_square(dp_gl *gl, const double origin[3], dp_diag *diag) {
    static const uint32_t corners[6] = {0, 1, 2, 0, 2, 3};
    static const uint32_t kinds[4] = {0, DP_MIRROR_GROUP << 16 | 3, 0, DP_MIRROR_GROUP << 16 | 6};
    dp_gl_mirror *const s = gl->mirror;
    float positions[12];
    for (int i = 0; i < 12; i++) positions[i] = (float)(s->corners[i / 3][i % 3] - origin[i % 3]);
    if (!s->square && !(s->square = new_mesh(gl)))
        return dp_fail(diag, DP_ERR_MEMORY, "out of memory for a mirror");
    dp_gl_mesh *const m = s->square;
    if (!m->polygon_firsts) m->polygon_firsts = dp_alloc_array(&gl->memory, 2, 4);
    if (!m->source_polygon) m->source_polygon = dp_alloc_array(&gl->memory, 2, 8);
    if (!m->polygon_firsts || !m->source_polygon)
        return dp_fail(diag, DP_ERR_MEMORY, "out of memory for a mirror");
    memset(m->polygon_firsts, 0, 8), memset(m->source_polygon, 0, 16);
    dp_result result =
        dp_gl_buffer_fill(gl, &m->positions, positions, sizeof positions, "a mirror", diag);
    if (!result)
        result = dp_gl_buffer_fill(gl, &m->corners, corners, sizeof corners, "a mirror", diag);
    if (!result)
        result = dp_gl_buffer_fill(gl, &m->triangles, kinds, sizeof kinds, "a mirror", diag);
    m->vertex_count = 4, m->triangle_count = 2, m->polygons = 1, m->keeps_groups = true;
    memcpy(m->origin, origin, sizeof m->origin);
    m->from = (dp_gl_buffers){.positions = m->positions.name,
                              .positions_stride = 12,
                              .vertex_count = 4,
                              .indices = m->corners.name,
                              .triangle_count = 2};
    return result;
}

/* Has the square been uploaded as it is now? */
static bool is_uploaded(const dp_gl_mirror *s, const double origin[3]) {
    return s->square && !memcmp(s->square->origin, origin, sizeof s->square->origin) &&
           !memcmp(s->uploaded, s->corners, sizeof s->corners);
}

dp_result dp_gl_begin_mirrored(dp_gl *gl, dp_gl_mesh *const *meshes, size_t count,
                               dp_gl_mesh_list *out, dp_diag *diag) {
    static const double zero[3] = {0, 0, 0};
    dp_gl_mirror *const s = gl->mirror;
    const double *const origin = count ? meshes[0]->origin : zero;
    if (!is_uploaded(s, origin)) {
        const dp_result result = make_square(gl, origin, diag);
        if (result) return result;
        memcpy(s->uploaded, s->corners, sizeof s->uploaded);
        if (!s->square->topology) s->square->topology = dp_gl_number(gl);
        s->square->placement = s->square->shading.version = dp_gl_number(gl);
    }
    for (size_t i = 0; i < count; i++) s->list[i] = meshes[i];
    s->list[count] = s->square;
    gl->shading->mirrored = &s->image;
    *out = (dp_gl_mesh_list){s->list, count + 1};
    return DP_OK;
}

void dp_gl_end_mirrored(dp_gl *gl) {
    if (gl->shading) gl->shading->mirrored = NULL;
}

/* Frees the set that gl does not hold. */
static void free_kept(dp_gl *gl) {
    exchange(gl);
    if (!gl->is_lost) {
        dp_gl_scene_free(gl);
        dp_gl_lines_free(gl);
        dp_gl_attributes_free(gl, &gl->shading->attributes);
    }
    dp_gl_quads_free(gl), dp_gl_fins_free(gl);
    dp_gl_scene_free_host(gl);
    dp_free(&gl->memory, gl->lines.read);
    exchange(gl);
}

void dp_gl_mirror_free(dp_gl *gl) {
    dp_gl_mirror *const s = gl->mirror;
    if (!s) return;
    for (size_t i = 0; i < s->image_count; i++) free_image(gl, &s->images[i]);
    dp_gl_mesh_destroy(s->square);
    if (gl->shading) free_kept(gl);
    if (!gl->is_lost) {
        dp_gl_texture_free(gl, &s->image);
        dp_gl_buffer_free(gl, &s->block_buffer);
    }
    dp_free(&gl->memory, s->images), dp_free(&gl->memory, s->list);
    dp_free(&gl->memory, s);
    gl->mirror = NULL;
}
