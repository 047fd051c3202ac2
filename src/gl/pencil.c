/* Pencil rendering (Hermosilla and Vázquez 2010, 2.4), as shade/pencil.c has it.
 *
 *     curvature     directions of least curvature of all vertices, by the CPU      mesh/curvature.c
 *     geometry      the G-buffer says which triangle a pixel shows, so that a pixel reads the directions of its three
 *                     corners as they are, not interpolated (Listing 2.4), and no vertex is copied
 *     pixel stage   three turned look-ups, tone, the paper's tooth (Listing 2.5)   pencil.frag
 *
 * Directions are made from the scene's own vertices, which come back from the device for it: so all meshes have them, wherever
 * their positions came from. They are made again when a mesh, its place or its positions change; positions in the application's
 * buffers may change any time, so those come back for each picture, and are compared (dp_curvature_directions).
 *
 * Texture units take the four texels of a look-up, with shares in steps of 1/256; the power and the tooth are tables of the
 * CPU's. Data structure: dp_gl_pencil. Not handled: of polygons of more than three corners the CPU takes three corners spread
 * over all, here it is those of the triangle that the pixel shows. */
#include "gl/pencil.h"

#include "gl/fins.h"
#include "gl/shading.h"
#include "gl/surface.h"
#include "shade/pencil.h"
#include "texture/graphite.h"

#include <string.h>

enum { SIZE = DP_GRAPHITE_SIZE };
static const size_t TEXELS = (size_t)SIZE * SIZE;

static dp_result out_of_memory(dp_diag *diag) {
    return dp_fail(diag, DP_ERR_MEMORY, "out of memory for pencil rendering");
}

/* ------- directions ------- */

typedef struct scene_vertex {
    float screen[4], world[4];
} scene_vertex;

/* What the scene's positions are made of; 0: of what may change without a word. */
static uint64_t placement_of(const dp_gl *gl) {
    uint64_t hash = 0xcbf29ce484222325u;
    for (size_t i = 0; i < gl->scene.count; i++) {
        const dp_gl_mesh *const m = gl->scene.meshes[i];
        if (!m->owned) return 0;
        hash = (hash ^ m->placement) * 0x100000001b3u;
    }
    return hash | 1;
}

static uint64_t topology_of(const dp_gl *gl) {
    uint64_t hash = 0xcbf29ce484222325u;
    for (size_t i = 0; i < gl->scene.count; i++)
        hash = (hash ^ gl->scene.topologies[i]) * 0x100000001b3u;
    return hash | 1;
}

static dp_result make_directions(dp_gl *gl, dp_gl_pencil *p, dp_diag *diag) {
    const dp_gl_scene *const s = &gl->scene;
    const dp_allocator *const memory = &gl->memory;
    const size_t corners = 3 * (size_t)s->triangle_count, n = s->vertex_count;
    scene_vertex *const vertices = dp_alloc_array(memory, n + 1, sizeof *vertices);
    uint32_t *const corner = dp_alloc_array(memory, corners + 1, sizeof *corner);
    dp_threads *const threads = dp_threads_create(0, NULL, NULL, memory);
    dp_result result = vertices && corner && threads ? DP_OK : out_of_memory(diag);
    if (!result) {
        dp_gl_buffer_read(gl, &s->vertices, 0, n * sizeof *vertices, vertices);
        dp_gl_buffer_read(gl, &s->corners, 0, corners * sizeof *corner, corner);
        const dp_polygons polygons = {.positions = vertices[0].world,
                                      .stride = sizeof *vertices,
                                      .vertex_count = (uint32_t)n,
                                      .corners = corner,
                                      .count = s->triangle_count};
        if (!dp_curvature_directions(&p->curvature, &polygons, threads, memory))
            result = out_of_memory(diag);
    }
    dp_threads_destroy(threads);
    dp_free(memory, corner), dp_free(memory, vertices);
    return result;
}

static dp_result need_directions(dp_gl *gl, dp_gl_pencil *p, dp_diag *diag) {
    const uint64_t topology = topology_of(gl), placement = placement_of(gl), key = p->curvature.key;
    if (placement && p->topology == topology && p->placement == placement) return DP_OK;
    const bool had = p->topology == topology;
    p->topology = 0;
    dp_result result = make_directions(gl, p, diag);
    if (!result && !(had && key == p->curvature.key))
        result =
            dp_gl_buffer_fill(gl, &p->along, p->curvature.along,
                              12 * (size_t)gl->scene.vertex_count, "directions of curvature", diag);
    if (!result) p->topology = topology, p->placement = placement;
    return result;
}

/* ------- textures ------- */

static dp_result make_table(dp_gl *gl, dp_gl_texture *t, GLenum format, uint32_t size, GLenum type,
                            const void *values, dp_diag *diag) {
    const dp_result result =
        dp_gl_texture_reserve(gl, t, format, size, size, 0, "a table of pencil rendering", diag);
    if (result) return result;
    dp_gl_texture_bind(gl, t, DP_GL_UNIT_PASS);
    gl->api.TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, (GLsizei)size, (GLsizei)size, GL_RED_INTEGER,
                          type, values);
    return DP_OK;
}

static dp_result need_tables(dp_gl *gl, dp_gl_pencil *p, dp_diag *diag) {
    const float of[2] = {gl->style.shade.pencil_s, gl->style.shade.pencil_o};
    const bool tooth = !p->tooth.name,
               powers = !p->powers.name || memcmp(p->powers_of, of, sizeof of) != 0;
    if (!tooth && !powers) return DP_OK;
    uint8_t *const values = dp_alloc_array(&gl->memory, TEXELS, 1);
    if (!values) return out_of_memory(diag);
    dp_result result = DP_OK;
    if (tooth) {
        dp_make_tooth((int8_t *)values);
        result = make_table(gl, &p->tooth, GL_R8I, SIZE, GL_BYTE, values, diag);
    }
    if (powers && !result) {
        dp_make_powers(values, of[0], of[1]);
        result = make_table(gl, &p->powers, GL_R8UI, 256, GL_UNSIGNED_BYTE, values, diag);
        memcpy(p->powers_of, of, sizeof of);
    }
    dp_free(&gl->memory, values);
    return result;
}

static void free_tones(dp_gl *gl, dp_gl_pencil *p) {
    if (!p->tones) return;
    gl->api.DeleteTextures(1, &p->tones);
    gl->stats.bytes -= (uint64_t)p->width * p->height * p->layers;
    p->tones = 0;
}

static void bind_tones(dp_gl *gl, const dp_gl_pencil *p) {
    gl->api.ActiveTexture(GL_TEXTURE0 + DP_GL_UNIT_PASS);
    gl->api.BindTexture(GL_TEXTURE_2D_ARRAY, p->tones);
}

static dp_result upload_tones(dp_gl *gl, dp_gl_pencil *p, const uint8_t *values, uint32_t width,
                              uint32_t height, uint32_t layers, dp_diag *diag) {
    static const GLenum names[4] = {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER, GL_TEXTURE_WRAP_S,
                                    GL_TEXTURE_WRAP_T};
    static const GLint set[4] = {GL_LINEAR, GL_LINEAR, GL_REPEAT, GL_REPEAT};
    const dp_gl_api *const a = &gl->api;
    if (width > gl->texture_most || height > gl->texture_most)
        return dp_fail(diag, DP_ERR_UNSUPPORTED, "%s has no textures of %u x %u px", gl->device,
                       width, height);
    if (!p->tones || p->width != width || p->height != height || p->layers != layers) {
        free_tones(gl, p);
        p->width = width, p->height = height, p->layers = layers;
        a->GenTextures(1, &p->tones);
        bind_tones(gl, p);
        a->TexStorage3D(GL_TEXTURE_2D_ARRAY, 1, GL_R8, (GLsizei)width, (GLsizei)height,
                        (GLsizei)layers);
        gl->stats.bytes += (uint64_t)width * height * layers;
        for (int i = 0; i < 4; i++) a->TexParameteri(GL_TEXTURE_2D_ARRAY, names[i], set[i]);
    }
    bind_tones(gl, p);
    a->TexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, (GLsizei)width, (GLsizei)height,
                     (GLsizei)layers, GL_RED, GL_UNSIGNED_BYTE, values);
    return dp_gl_check(gl, "textures of pencil strokes", diag);
}

/* The style's own are uploaded each time, as the application may have drawn them anew. */
static dp_result need_tones(dp_gl *gl, dp_gl_pencil *p, dp_diag *diag) {
    const dp_shade *const shade = &gl->style.shade;
    const dp_image *const own = &shade->strokes;
    const uint32_t layers = shade->pencil_tones ? shade->pencil_tones : 1;
    if (own->values) {
        p->is_own = true;
        return upload_tones(gl, p, own->values, own->width, own->height, 1, diag);
    }
    if (p->tones && !p->is_own && p->layers == layers) return DP_OK;
    uint8_t *const values = dp_alloc_array(&gl->memory, layers * TEXELS, 1);
    float *const scratch = dp_alloc_array(&gl->memory, TEXELS, sizeof *scratch);
    dp_result result = values && scratch ? DP_OK : out_of_memory(diag);
    p->is_own = true; /* until it is known to be otherwise */
    if (!result) {
        dp_make_graphite(values, layers, scratch);
        result = upload_tones(gl, p, values, SIZE, SIZE, layers, diag);
        p->is_own = result != DP_OK;
    }
    dp_free(&gl->memory, scratch), dp_free(&gl->memory, values);
    return result;
}

/* ------- the pixel stage ------- */

static void set_axes(dp_gl *gl, uint32_t program) {
    const dp_view *const v = &gl->view;
    const dp_vec3 x = dp_v3(v->clip[0][0], v->clip[0][1], v->clip[0][2]);
    const dp_vec3 right = dp_unit(dp_sub(x, dp_scale(v->forward, dp_dot(x, v->forward)))),
                  up = dp_cross(right, v->forward);
    dp_gl_uniform_4f(gl, program, "right",
                     (float[4]){(float)right.x, (float)right.y, (float)right.z, 0});
    dp_gl_uniform_4f(gl, program, "up", (float[4]){(float)up.x, (float)up.y, (float)up.z, 0});
}

static void set_turns(dp_gl *gl, uint32_t program) {
    dp_pencil_table table;
    float turns[DP_TURNS][4] = {{0}};
    dp_make_pencil_table(&table);
    for (int i = 0; i < DP_TURNS; i++) turns[i][0] = table.c[i], turns[i][1] = table.s[i];
    gl->api.Uniform4fv(gl->api.GetUniformLocation(program, "turns"), DP_TURNS, turns[0]);
}

static void bind(dp_gl *gl, uint32_t program, const dp_gl_pencil *p) {
    dp_gl_scene_bind(gl);
    dp_gl_buffer_bind(gl, &p->along, DP_GL_BIND_OWN);
    bind_tones(gl, p);
    dp_gl_texture_bind(gl, &p->powers, DP_GL_UNIT_PASS + 1);
    dp_gl_texture_bind(gl, &p->tooth, DP_GL_UNIT_PASS + 2);
    dp_gl_uniform_i(gl, program, "tones", DP_GL_UNIT_PASS);
    dp_gl_uniform_i(gl, program, "powers", DP_GL_UNIT_PASS + 1);
    dp_gl_uniform_i(gl, program, "tooth", DP_GL_UNIT_PASS + 2);
    dp_gl_uniform_f(gl, program, "scale", 1 / gl->style.shade.stroke_scale);
}

static const char *defines_of(const dp_gl *gl) {
    static const char *const defines[2][3] = {
        {"", "#define EXACT_LOOKUPS\n", "#define EXACT_LOOKUPS\n#define LOOKUP_STEPS 256.0\n"},
        {"#define PRINTED\n", "#define PRINTED\n#define EXACT_LOOKUPS\n",
         "#define PRINTED\n#define EXACT_LOOKUPS\n#define LOOKUP_STEPS 256.0\n"}};
    return defines[gl->style.shade.pencil_printed][gl->lookups];
}

dp_result dp_gl_shade_pencil(dp_gl *gl, dp_diag *diag) {
    const dp_gl_program_desc desc = {
        .vertex = "whole.vert", .fragment = "pencil.frag", .defines = defines_of(gl)};
    uint32_t program;
    dp_result result = dp_gl_fins_begin(gl, diag);
    if (result) return result;
    dp_gl_pencil *const p = &gl->fins->pencil;
    if (gl->scene.triangle_count) result = need_directions(gl, p, diag);
    if (!result) result = need_tables(gl, p, diag);
    if (!result) result = need_tones(gl, p, diag);
    if (!result)
        result = dp_gl_begin_pass(gl, &desc, &gl->shading->color, GL_RGBA8, &program, diag);
    if (result) return result;
    bind(gl, program, p);
    set_axes(gl, program);
    set_turns(gl, program);
    dp_gl_draw_whole(gl);
    return DP_OK;
}

void dp_gl_pencil_free(dp_gl *gl, dp_gl_pencil *p) {
    dp_curvature_store_free(&p->curvature, &gl->memory);
    if (gl->is_lost) return;
    free_tones(gl, p);
    dp_gl_buffer_free(gl, &p->along);
    dp_gl_texture_free(gl, &p->tooth), dp_gl_texture_free(gl, &p->powers);
}
