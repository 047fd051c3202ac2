/* Shading: the surface → surface.picture, in the passes of Nienhaus and Döllner 2003 (4, "Rendering Passes").
 *
 *    ids, scene             → G-buffer      normal, distance, group, and colour without light (gbuffer.frag)
 *    G-buffer               → color         the style's operator (shade.frag), pencil (pencil.c), what the mirror shows
 *    color                  → smooth        the cartoon map, if it is toon
 *    G-buffer               → edge map      one pass, or C1's three (edge_map.c)
 *    the model, edge map,
 *    color or smooth        → edged         a second pass over the model, onto which both are projected (edge_map.c)
 *    color, smooth or edged → picture       pixels that surfaces share are mixed
 *
 * The passes are those of src/shade, one fragment a pixel, and round to 8 bits where these do. Data structure: textures of
 * the picture's size, and a block of values (shading.h). Invariant: after dp_gl_gbuffer_fill the G-buffer's textures
 * hold the picture's values until the next picture; a pixel without a surface has id 0 in `what`, and what other textures
 * hold there is not used. Not here: lines, which are inked over the picture. */
#include "gl/shading.h"

#include "gl/surface.h"
#include "base/elementary.h"
#include "shade/shade.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

bool dp_gl_is_shaded(const dp_gl *gl) {
    const dp_shading shading = gl->style.shade.shading;
    const dp_edge_map *const map = &gl->style.edge_map;
    const bool lit = shading != DP_SHADING_FLAT && shading != DP_SHADING_PAPER,
               mirrors = gl->shading && gl->shading->mirrored;
    return lit || mirrors || gl->style.shade.model_colors || (map->detector && !map->hidden);
}

dp_result dp_gl_need_shading(dp_gl *gl, dp_diag *diag) {
    if (gl->shading) return DP_OK;
    gl->shading = dp_alloc_zeroed(&gl->memory, sizeof *gl->shading);
    return gl->shading ? DP_OK : dp_fail(diag, DP_ERR_MEMORY, "out of memory for shading");
}

static void put_color(dp_color c, float out[4]) {
    for (int k = 0; k < 4; k++) out[k] = (float)(c >> (24 - 8 * k) & 0xff) / 255;
}

/* ------- values of all passes ------- */

static void put_camera(const dp_gl *gl, dp_gl_shading_block *b) {
    dp_gbuffer g = {0};
    dp_gbuffer_take_camera(&g, &gl->view);
    b->lens[0] = g.cx, b->lens[1] = g.cy, b->lens[2] = g.fx, b->lens[3] = g.fy;
    b->eye[0] = (float)g.eye.x, b->eye[1] = (float)g.eye.y, b->eye[2] = (float)g.eye.z;
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++) b->rotation[r][c] = (float)g.rotation[r][c];
}

static void put_edges(const dp_gl *gl, dp_gl_shading_block *b) {
    const dp_edge_map *const m = &gl->style.edge_map;
    const double angle = (double)m->inner_angle * 0.017453292519943295;
    put_color(m->inner, b->inner), put_color(m->profile, b->profile);
    b->strength[0] = m->as_printed ? 0 : 1 - (float)dp_cos(angle);
    b->strength[1] = m->as_printed ? 1 : 1 / m->inner_softness;
    b->strength[2] = m->as_printed ? 0 : 0.15f;
    b->strength[3] = m->as_printed ? 1 : 1 / m->profile_softness;
    b->measure[0] = b->lens[3] / m->profile_depth;
    b->measure[1] = m->far_side || m->as_printed;
    b->measure[2] = m->profile_depth;
    b->measure[3] = 2 * (float)m->radius / m->profile_depth;
    b->counts[1] = m->radius;
    b->counts[2] = m->enhanced ? m->enhanced_count : 0;
}

static dp_color base_color(const dp_gl *gl) {
    return gl->style.surface & 0xff ? gl->style.surface : gl->style.paper;
}

static dp_result put_block(dp_gl *gl, dp_diag *diag) {
    dp_gl_shading *const s = gl->shading;
    const dp_shade *const shade = &gl->style.shade;
    dp_gl_shading_block *const b = &s->block;
    put_camera(gl, b);
    for (int k = 0; k < 3; k++) b->light[k] = shade->light[k];
    b->light[3] = shade->highlight;
    b->gooch[0] = shade->gooch_blue, b->gooch[1] = shade->gooch_yellow;
    b->gooch[2] = shade->gooch_alpha, b->gooch[3] = shade->gooch_beta;
    put_color(shade->ink, b->ink);
    put_color(base_color(gl), b->base);
    put_edges(gl, b);
    b->strokes[0] = (float)s->strokes.width, b->strokes[1] = (float)s->strokes.height;
    b->strokes[2] = shade->stroke_scale, b->strokes[3] = shade->object_space;
    b->counts[0] = shade->shades.values ? shade->shades.width : DP_TOON_SHADES;
    return dp_gl_buffer_fill(gl, &s->block_buffer, b, sizeof *b, "values of shading", diag);
}

/* ------- textures of styles ------- */

static dp_result upload_strokes(dp_gl *gl, const uint8_t *values, uint32_t width, uint32_t height,
                                dp_diag *diag) {
    dp_gl_texture *const t = &gl->shading->strokes;
    const dp_result result =
        dp_gl_texture_reserve(gl, t, GL_R8, width, height, 0, "a texture of strokes", diag);
    if (result) return result;
    gl->api.ActiveTexture(GL_TEXTURE0 + DP_GL_UNIT_PASS);
    gl->api.BindTexture(GL_TEXTURE_2D, t->name);
    gl->api.TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, (GLsizei)width, (GLsizei)height, GL_RED,
                          GL_UNSIGNED_BYTE, values);
    return DP_OK;
}

static bool has_strokes(const dp_gl *gl) {
    const dp_shading shading = gl->style.shade.shading;
    return shading == DP_SHADING_HATCH || shading == DP_SHADING_HALFTONE;
}

/* Those of the style are uploaded each time, as the application may have drawn them anew. */
static dp_result choose_strokes(dp_gl *gl, dp_diag *diag) {
    enum { SIZE = DP_STROKES_SIZE };
    const dp_shade *const shade = &gl->style.shade;
    dp_gl_shading *const s = gl->shading;
    if (!has_strokes(gl)) return DP_OK;
    if (shade->strokes.values) {
        s->strokes_of = -1;
        return upload_strokes(gl, shade->strokes.values, shade->strokes.width,
                              shade->strokes.height, diag);
    }
    if (s->strokes_of == (int)shade->shading) return DP_OK;
    uint8_t *const made = dp_alloc_array(&gl->memory, SIZE, SIZE);
    if (!made) return dp_fail(diag, DP_ERR_MEMORY, "out of memory for a texture of strokes");
    if (shade->shading == DP_SHADING_HALFTONE)
        dp_make_halftone(made);
    else
        dp_make_hatching(made);
    const dp_result result = upload_strokes(gl, made, SIZE, SIZE, diag);
    dp_free(&gl->memory, made);
    s->strokes_of = result ? -1 : (int)shade->shading;
    return result;
}

static bool is_anchored(const dp_gl *gl) {
    const double *const o = gl->scene.origin;
    return has_strokes(gl) && gl->style.shade.object_space && (o[0] != 0 || o[1] != 0 || o[2] != 0);
}

static dp_result upload_anchors(dp_gl *gl, dp_diag *diag) {
    dp_gl_shading *const s = gl->shading;
    dp_hatch_anchor *const anchor = dp_alloc_array(&gl->memory, 1, sizeof *anchor);
    if (!anchor) return dp_fail(diag, DP_ERR_MEMORY, "out of memory for places of strokes");
    dp_anchor_strokes(gl->scene.origin, s->strokes.width, s->strokes.height, anchor);
    const dp_result result =
        dp_gl_buffer_fill(gl, &s->anchors, anchor, sizeof *anchor, "places of strokes", diag);
    dp_free(&gl->memory, anchor);
    return result;
}

static dp_result upload_shades(dp_gl *gl, dp_diag *diag) {
    const dp_image *const i = &gl->style.shade.shades;
    return dp_gl_buffer_fill(gl, &gl->shading->shades, i->values ? i->values : dp_toon_shades[0],
                             i->values ? 4 * (size_t)i->width : sizeof dp_toon_shades,
                             "shades of toon", diag);
}

/* ------- the G-buffer ------- */

static bool wants_texcoords(const dp_gl *gl) {
    return has_strokes(gl) && gl->style.shade.object_space;
}

static bool has_colors(const dp_gl *gl) {
    return gl->style.shade.model_colors && gl->style.shade.shading != DP_SHADING_PAPER;
}

static dp_result open_gbuffer(dp_gl *gl, dp_gl_gbuffer *g, dp_diag *diag) {
    static const GLenum buffers[5] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT0 + 1,
                                      GL_COLOR_ATTACHMENT0 + 2, GL_COLOR_ATTACHMENT0 + 3,
                                      GL_COLOR_ATTACHMENT0 + 4};
    static const GLenum formats[5] = {GL_RGBA32F, GL_RG32UI, GL_RGBA8, GL_R32F, GL_RG32F};
    dp_gl_texture *const textures[5] = {&g->geometry, &g->what, &g->base, &g->other, &g->texcoord};
    const int count = g->textured ? 5 : 4;
    dp_result result = DP_OK;
    if (!g->framebuffer) gl->api.GenFramebuffers(1, &g->framebuffer);
    gl->api.BindFramebuffer(GL_FRAMEBUFFER, g->framebuffer);
    for (int i = 0; i < count && !result; i++) {
        result = dp_gl_texture_reserve(gl, textures[i], formats[i], gl->target.width,
                                       gl->target.height, 0, "the G-buffer", diag);
        gl->api.FramebufferTexture(GL_FRAMEBUFFER, buffers[i], textures[i]->name, 0);
    }
    if (count < 5) gl->api.FramebufferTexture(GL_FRAMEBUFFER, buffers[4], 0, 0);
    gl->api.DrawBuffers(count, buffers);
    gl->api.Viewport(0, 0, (GLsizei)gl->target.width, (GLsizei)gl->target.height);
    return result;
}

static void bind_attributes(dp_gl *gl, uint32_t program, bool facets) {
    const dp_gl_scene_attributes *const a = &gl->shading->attributes;
    if (!facets) dp_gl_buffer_bind(gl, &a->normals, DP_GL_BIND_OWN);
    if (gl->shading->gbuffer.textured) dp_gl_buffer_bind(gl, &a->texcoords, DP_GL_BIND_OWN + 1);
    if (!has_colors(gl)) return;
    dp_gl_buffer_bind(gl, a->has_colors ? &a->colors : &a->groups, DP_GL_BIND_OWN + 2);
    dp_gl_buffer_bind(gl, &a->groups, DP_GL_BIND_OWN + 3);
    dp_gl_uniform_u(gl, program, "has_vertex_colors", a->has_colors);
}

dp_result dp_gl_gbuffer_fill(dp_gl *gl, dp_diag *diag) {
    const bool facets = gl->style.shade.normals == DP_NORMALS_FACET, colored = has_colors(gl);
    char defines[80];
    uint32_t program;
    dp_result result = dp_gl_need_shading(gl, diag);
    if (!result) result = choose_strokes(gl, diag);
    if (!result) result = dp_gl_gather_attributes(gl, wants_texcoords(gl), colored, diag);
    if (!result) result = put_block(gl, diag);
    if (result) return result;
    dp_gl_gbuffer *const g = &gl->shading->gbuffer;
    g->textured = wants_texcoords(gl) && gl->shading->attributes.has_texcoords;
    snprintf(defines, sizeof defines, "%s%s%s", facets ? "#define FACETS\n" : "",
             g->textured ? "#define TEXTURED\n" : "", colored ? "#define COLORED\n" : "");
    const dp_gl_program_desc desc = {
        .vertex = "whole.vert", .fragment = "gbuffer.frag", .defines = defines};
    result = open_gbuffer(gl, g, diag);
    if (!result) result = dp_gl_program(gl, &desc, &program, diag);
    if (result) return result;
    dp_gl_use(gl, program);
    gl->api.BindBufferBase(GL_UNIFORM_BUFFER, DP_GL_BLOCK_SHADING, gl->shading->block_buffer.name);
    dp_gl_scene_bind(gl);
    dp_gl_faces_bind(gl, program);
    bind_attributes(gl, program, facets);
    dp_gl_draw_whole(gl);
    return DP_OK;
}

void dp_gl_gbuffer_bind(dp_gl *gl, uint32_t program) {
    const dp_gl_gbuffer *const g = &gl->shading->gbuffer;
    const struct {
        const dp_gl_texture *texture;
        const char *name;
        int unit;
    } all[] = {{&g->geometry, "g_geometry", DP_GL_UNIT_GEOMETRY},
               {&g->what, "g_what", DP_GL_UNIT_WHAT},
               {&g->base, "g_base", DP_GL_UNIT_BASE},
               {&g->other, "g_other", DP_GL_UNIT_OTHER},
               {&g->texcoord, "g_texcoord", DP_GL_UNIT_TEXCOORD}};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        if (!all[i].texture->name) continue;
        dp_gl_texture_bind(gl, all[i].texture, (uint32_t)all[i].unit);
        dp_gl_uniform_i(gl, program, all[i].name, all[i].unit);
    }
    gl->api.BindBufferBase(GL_UNIFORM_BUFFER, DP_GL_BLOCK_SHADING, gl->shading->block_buffer.name);
}

void dp_gl_gbuffer_free(dp_gl *gl, dp_gl_gbuffer *g) {
    dp_gl_texture *const textures[] = {&g->geometry, &g->what, &g->base, &g->other, &g->texcoord};
    for (size_t i = 0; i < sizeof textures / sizeof *textures; i++)
        dp_gl_texture_free(gl, textures[i]);
    if (g->framebuffer) gl->api.DeleteFramebuffers(1, &g->framebuffer);
    g->framebuffer = 0;
}

/* ------- passes ------- */

static dp_result bind_pass(dp_gl *gl, const dp_gl_program_desc *desc, uint32_t *program,
                           dp_diag *diag) {
    const dp_result result = dp_gl_program(gl, desc, program, diag);
    if (result) return result;
    dp_gl_use(gl, *program);
    dp_gl_gbuffer_bind(gl, *program);
    return DP_OK;
}

dp_result dp_gl_begin_pass(dp_gl *gl, const dp_gl_program_desc *desc, dp_gl_texture *to,
                           uint32_t format, uint32_t *program, dp_diag *diag) {
    dp_gl_shading *const s = gl->shading;
    const dp_result result = dp_gl_texture_reserve(gl, to, format, gl->target.width,
                                                   gl->target.height, 0, "a pass of shading", diag);
    if (result) return result;
    if (!s->framebuffer) gl->api.GenFramebuffers(1, &s->framebuffer);
    gl->api.BindFramebuffer(GL_FRAMEBUFFER, s->framebuffer);
    gl->api.FramebufferTexture(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, to->name, 0);
    gl->api.DrawBuffer(GL_COLOR_ATTACHMENT0);
    gl->api.Viewport(0, 0, (GLsizei)gl->target.width, (GLsizei)gl->target.height);
    return bind_pass(gl, desc, program, diag);
}

/* A pass that reads one texture of colours, or none. */
static dp_result run_pass(dp_gl *gl, const dp_gl_program_desc *desc, const dp_gl_texture *from,
                          dp_gl_texture *to, dp_diag *diag) {
    uint32_t program;
    const dp_result result = dp_gl_begin_pass(gl, desc, to, GL_RGBA8, &program, diag);
    if (result) return result;
    dp_gl_texture_bind(gl, from, DP_GL_UNIT_PASS);
    dp_gl_uniform_i(gl, program, "colors", DP_GL_UNIT_PASS);
    dp_gl_draw_whole(gl);
    return DP_OK;
}

/* The style's operator, for all but pencil. */
static dp_result shade_pixels(dp_gl *gl, dp_diag *diag) {
    dp_gl_shading *const s = gl->shading;
    const dp_shading shading = gl->style.shade.shading;
    const bool anchored = is_anchored(gl);
    char defines[160];
    uint32_t program;
    snprintf(defines, sizeof defines, "#define STYLE %d\n#define GOOCH_KD %s\n%s%s", (int)shading,
             gl->style.shade.gooch_plain ? "vec3(0.5)" : "color.rgb",
             s->gbuffer.textured ? "#define TEXTURED\n" : "", anchored ? "#define ANCHORED\n" : "");
    const dp_gl_program_desc desc = {
        .vertex = "whole.vert", .fragment = "shade.frag", .defines = defines};
    dp_result result = shading == DP_SHADING_TOON ? upload_shades(gl, diag) : DP_OK;
    if (!result && anchored) result = upload_anchors(gl, diag);
    if (!result) result = dp_gl_begin_pass(gl, &desc, &s->color, GL_RGBA8, &program, diag);
    if (result) return result;
    if (shading == DP_SHADING_TOON) dp_gl_buffer_bind(gl, &s->shades, 4);
    if (anchored) dp_gl_buffer_bind(gl, &s->anchors, 5);
    if (s->strokes.name) dp_gl_texture_bind(gl, &s->strokes, DP_GL_UNIT_PASS);
    dp_gl_uniform_i(gl, program, "g_strokes", DP_GL_UNIT_PASS);
    dp_gl_draw_whole(gl);
    return DP_OK;
}

static dp_result put_mirrored(dp_gl *gl, dp_diag *diag) {
    static const dp_gl_program_desc desc = {.vertex = "whole.vert", .fragment = "mirrored.frag"};
    return run_pass(gl, &desc, gl->shading->mirrored, &gl->shading->color, diag);
}

static dp_result smooth_colors(dp_gl *gl, dp_diag *diag) {
    static const dp_gl_program_desc desc = {.vertex = "whole.vert", .fragment = "cartoon.frag"};
    return run_pass(gl, &desc, &gl->shading->color, &gl->shading->smooth, diag);
}

static dp_result resolve(dp_gl *gl, const dp_gl_texture *shown, dp_diag *diag) {
    const bool eight = gl->style.edge_map.detector && gl->style.edge_map.eight_bits;
    char defines[50];
    uint32_t program;
    snprintf(defines, sizeof defines, "%s%s", eight ? "#define EIGHT_BITS\n" : "",
             gl->target.depth_texture ? "#define FOREIGN\n" : "");
    const dp_gl_program_desc desc = {
        .vertex = "whole.vert", .fragment = "resolve.frag", .defines = defines};
    dp_result result = dp_gl_open_surface(gl, diag);
    if (!result) result = bind_pass(gl, &desc, &program, diag);
    if (result) return result;
    dp_gl_faces_bind(gl, program);
    if (eight) dp_gl_buffer_bind(gl, &gl->shading->range, 4);
    dp_gl_texture_bind(gl, shown, DP_GL_UNIT_PASS);
    dp_gl_uniform_i(gl, program, "shown", DP_GL_UNIT_PASS);
    dp_gl_draw_whole(gl);
    return DP_OK;
}

dp_result dp_gl_shade(dp_gl *gl, dp_diag *diag) {
    const dp_shade *const shade = &gl->style.shade;
    const dp_edge_map *const map = &gl->style.edge_map;
    dp_result result = dp_gl_gbuffer_fill(gl, diag);
    if (!result)
        result = shade->shading == DP_SHADING_PENCIL ? dp_gl_shade_pencil(gl, diag)
                                                     : shade_pixels(gl, diag);
    if (result) return result;
    dp_gl_shading *const s = gl->shading;
    const dp_gl_texture *shown = &s->color;
    if (s->mirrored) result = put_mirrored(gl, diag);
    if (!result && shade->shading == DP_SHADING_TOON && !shade->nearest) {
        result = smooth_colors(gl, diag);
        shown = &s->smooth;
    }
    if (!result && map->detector) result = dp_gl_fit_edge_map(gl, diag);
    if (!result && map->detector && !map->hidden) {
        result = dp_gl_make_edge_map(gl, diag);
        if (!result) result = dp_gl_apply_edge_map(gl, shown, diag);
        shown = &s->edged;
    }
    return result ? result : resolve(gl, shown, diag);
}

void dp_gl_shading_free(dp_gl *gl) {
    dp_gl_shading *const s = gl->shading;
    if (!s) return;
    dp_gl_texture *const textures[] = {&s->strokes,   &s->color,    &s->smooth,
                                       &s->intensity, &s->edge_map, &s->edged};
    dp_gl_buffer *const buffers[] = {&s->block_buffer, &s->range, &s->enhanced, &s->shades,
                                     &s->anchors};
    if (!gl->is_lost) {
        dp_gl_gbuffer_free(gl, &s->gbuffer);
        dp_gl_attributes_free(gl, &s->attributes);
        for (size_t i = 0; i < sizeof textures / sizeof *textures; i++)
            dp_gl_texture_free(gl, textures[i]);
        for (size_t i = 0; i < sizeof buffers / sizeof *buffers; i++)
            dp_gl_buffer_free(gl, buffers[i]);
        if (s->framebuffer) gl->api.DeleteFramebuffers(1, &s->framebuffer);
        if (s->second) gl->api.DeleteFramebuffers(1, &s->second);
    }
    dp_free(&gl->memory, s);
    gl->shading = NULL;
}
