/* dp_gl_draw: one picture, stage by stage.
 *
 *    meshes → scene → vertices → faces (ids, depth) → mates → edges, emerging lines, crossings
 *           → visibility → segments
 *    faces → surface: flat, or G-buffer, shading, edge map
 *    segments or added polygons → ink over the surface → the application's framebuffer
 *    a mirror: all of it twice, first of the reflected scene (mirror.c)
 *
 * Nothing comes back to the host but counters: were the lists of candidates and of segments large enough? If not,
 * they grow, and those stages run again. */
#include "gl/fins.h"
#include "gl/ink.h"
#include "gl/lines.h"
#include "gl/mesh.h"
#include "gl/mirror.h"
#include "gl/scene.h"
#include "gl/shading.h"
#include "gl/surface.h"

#include "base/elementary.h"
#include "core/outline.h"

#include <string.h>

const char *dp_gl_stage_name(dp_gl_stage stage) {
    static const char *const names[DP_GL_STAGE_COUNT] = {"vertices",   "faces", "mates", "edges",
                                                         "visibility", "shade", "ink"};
    return (unsigned)stage < DP_GL_STAGE_COUNT ? names[stage] : "unknown";
}

static void put_color(dp_color c, float out[4]) {
    for (int k = 0; k < 4; k++) out[k] = (float)(c >> (24 - 8 * k) & 0xff) / 255;
}

static void put_vector(dp_vec3 v, double last, double out[4]) {
    out[0] = v.x, out[1] = v.y, out[2] = v.z, out[3] = last;
}

/* Half a degree short of the least fold that is drawn, a right angle at the most; 2 where flat edges are lines too. As in
 * draw/draw.c. */
static float flat_cosine(const dp_style *s) {
    const float least = dp_minf(180 - s->ridge_angle, s->valley_angle - 180);
    return least > 1 ? (float)dp_cos(((double)dp_minf(least, 90) - 0.5) * 0.017453292519943295) : 2;
}

static void put_view(dp_gl *gl) {
    const dp_view *const v = &gl->view;
    dp_gl_picture_block *const b = &gl->block;
    memcpy(b->clip, v->clip, sizeof b->clip);
    memcpy(b->sight, v->sight, sizeof b->sight);
    put_vector(v->eye, v->guard, b->eye);
    put_vector(v->forward, v->focal, b->forward);
    put_vector(v->corner, 0, b->corner);
    put_vector(v->across, 0, b->across);
    put_vector(v->down, 0, b->down);
    const float size = (float)(1 / v->focal);
    b->step[0] = v->perspective ? size : 0, b->step[1] = v->perspective ? 0 : size;
    b->step[2] = dp_nearly_edge_on(v);
    b->step[3] = flat_cosine(&gl->style);
    b->size[0] = (float)v->width, b->size[1] = (float)v->height;
    b->size[2] = (float)(1 / v->width), b->size[3] = (float)(1 / v->height);
}

static void put_style(dp_gl *gl) {
    const dp_style *const s = &gl->style;
    dp_gl_picture_block *const b = &gl->block;
    const double theta = (double)s->ridge_angle * 0.017453292519943295,
                 phi = (double)s->valley_angle * 0.017453292519943295;
    b->angles[0] = dp_cos(theta), b->angles[1] = dp_sin(theta);
    b->angles[2] = dp_cos(phi), b->angles[3] = dp_sin(phi);
    for (int i = 0; i < DP_LINE_COUNT; i++) {
        b->widths[i][0] = s->line[i].width;
        put_color(s->line[i].color, b->colors[i]);
    }
    put_color(s->paper, b->paper);
    put_color(s->surface, b->surface);
    b->style[0] =
        s->lines & DP_ALL_LINES & ~(uint32_t)(dp_gl_draws_fins(gl) ? DP_SILHOUETTE | DP_BORDER : 0);
    b->style[1] = gl->view.perspective;
    b->style[2] = s->cull_back_faces;
}

/* Where samples lie in a pixel, as the device has it. */
static void put_places(dp_gl *gl) {
    dp_gl_picture_block *const b = &gl->block;
    b->places[0][0] = b->places[0][1] = 0.5f;
    if (gl->samples < 2 || gl->faces.ids.samples != gl->samples) return; /* it is asked again */
    gl->api.BindFramebuffer(GL_FRAMEBUFFER, gl->faces.framebuffer);
    for (GLuint i = 0; i < gl->samples; i++)
        gl->api.GetMultisamplefv(GL_SAMPLE_POSITION, i, b->places[i]);
}

dp_result dp_gl_upload_block(dp_gl *gl, dp_diag *diag) {
    put_view(gl);
    put_style(gl);
    gl->block.counts[0] = gl->scene.vertex_count;
    gl->block.counts[1] = gl->scene.triangle_count;
    gl->block.counts[2] = gl->samples;
    gl->block.counts[3] = (uint32_t)(gl->lines.segments.size / sizeof(dp_gl_segment));
    return dp_gl_buffer_fill(gl, &gl->block_buffer, &gl->block, sizeof gl->block,
                             "a picture's values", diag);
}

static uint32_t samples_of(const dp_gl *gl, uint32_t asked) {
    uint32_t samples = asked ? asked : 4;
    while (samples > 1 && samples > gl->samples_most) samples /= 2;
    return samples;
}

dp_result dp_gl_check_target(const dp_gl *gl, const dp_gl_target *t, dp_diag *diag) {
    const uint32_t most = gl->texture_most;
    if (t->width < 1 || t->height < 1 || t->width > most || t->height > most)
        return dp_fail(diag, DP_ERR_ARGUMENT,
                       "the picture is %u x %u px; each side must be 1 to %u on this device",
                       t->width, t->height, most);
    if (t->samples > 16 || (t->samples & (t->samples - 1)) || t->samples == 2)
        return dp_fail(diag, DP_ERR_ARGUMENT, "%u samples per pixel; it must be 1, 4, 8 or 16",
                       t->samples);
    return DP_OK;
}

static bool is_ours(const dp_gl *gl, const dp_gl_mesh *mesh) {
    const dp_gl_mesh *at = gl->meshes;
    while (at && at != mesh) at = at->next;
    return at;
}

/* A mesh of another dp_gl, or one that has been destroyed, is in no list of ours: it is not looked at. */
static dp_result check_meshes(const dp_gl *gl, dp_gl_mesh *const *meshes, size_t count,
                              dp_diag *diag) {
    dp_result result = DP_OK;
    for (size_t i = 0; i < count && !result; i++)
        result = meshes[i] && is_ours(gl, meshes[i])
                     ? dp_gl_mesh_check(meshes[i], diag)
                     : dp_fail(diag, DP_ERR_ARGUMENT,
                               "mesh %zu is NULL, destroyed, or of another dp_gl", i);
    return result;
}

/* Style and samples of the picture. */
static dp_result begin(dp_gl *gl, dp_gl_mesh *const *meshes, size_t count, const dp_style *style,
                       const dp_gl_target *target, dp_diag *diag) {
    dp_result result = dp_gl_check_target(gl, target, diag);
    if (!result) result = check_meshes(gl, meshes, count, diag);
    if (!result)
        result = dp_gl_bind_framebuffer(gl, GL_DRAW_FRAMEBUFFER, target->framebuffer, diag);
    if (!result) result = dp_style_resolve(style, &gl->style, diag);
    if (!result) result = dp_gl_check_style(gl, &gl->style, diag);
    if (result) return result;
    gl->target = *target;
    gl->samples = samples_of(gl, target->samples);
    return DP_OK;
}

/* ------- stages ------- */

/* By timestamps: of elapsed time, the application may be measuring its own. */
static void begin_stage(dp_gl *gl, dp_gl_stage stage) {
    gl->queried[stage] = gl->timed;
    if (!gl->timed) return;
    if (!gl->queries[0][0]) gl->api.GenQueries(2 * DP_GL_STAGE_COUNT, gl->queries[0]);
    gl->api.QueryCounter(gl->queries[stage][0], GL_TIMESTAMP);
}
static void end_stage(dp_gl *gl, dp_gl_stage stage) {
    if (gl->timed) gl->api.QueryCounter(gl->queries[stage][1], GL_TIMESTAMP);
}

typedef dp_result stage_function(dp_gl *, dp_diag *);

static dp_result run(dp_gl *gl, dp_gl_stage stage, stage_function *function, dp_diag *diag) {
    begin_stage(gl, stage);
    const dp_result result = function(gl, diag);
    end_stage(gl, stage);
    return result;
}

static dp_result find_candidates(dp_gl *gl, dp_diag *diag) {
    dp_result result = dp_gl_find_edges(gl, diag);
    if (!result) result = dp_gl_find_emerging(gl, diag);
    if (!result) result = dp_gl_find_crossings(gl, diag);
    return result;
}

static bool finds_lines(const dp_gl *gl) {
    const bool strokes = gl->style.ink == DP_INK_STROKES || gl->style.edges == DP_EDGES_ADJACENCY;
    return strokes && gl->scene.triangle_count && gl->block.style[0];
}

/* Silhouettes by adjacency need mates, which need sides. */
static bool finds_mates_alone(const dp_gl *gl) {
    return dp_gl_draws_fins(gl) && gl->lines.topology != gl->scene.topology;
}

/* Vertices, and if lines or mates are looked for how triangles lie to the eye. */
static dp_result place(dp_gl *gl, dp_diag *diag) {
    const dp_result result = dp_gl_scene_place(gl, diag);
    const bool needs_sides = finds_lines(gl) || finds_mates_alone(gl);
    return result || !needs_sides ? result : dp_gl_find_sides(gl, diag);
}

/* The last picture's segments are none of this one's. */
static void forget_lines(dp_gl *gl) {
    static const GLuint none = 0;
    if (!gl->lines.counters.name) return;
    gl->api.BindBuffer(GL_COPY_WRITE_BUFFER, gl->lines.counters.name);
    gl->api.BufferSubData(GL_COPY_WRITE_BUFFER, offsetof(dp_gl_counters, segments), sizeof none,
                          &none);
}

static dp_result find_lines(dp_gl *gl, dp_diag *diag) {
    bool again = true;
    dp_result result = run(gl, DP_GL_STAGE_MATES, dp_gl_find_mates, diag);
    while (!result && again) {
        result = run(gl, DP_GL_STAGE_EDGES, find_candidates, diag);
        if (!result) result = run(gl, DP_GL_STAGE_VISIBILITY, dp_gl_find_visible, diag);
        if (!result) result = dp_gl_grow_lines(gl, &again, diag);
        gl->stats.regrown += again;
        if (!result && again) result = dp_gl_upload_block(gl, diag);
    }
    return result;
}

static dp_result surface(dp_gl *gl, dp_diag *diag) {
    return dp_gl_is_shaded(gl) ? dp_gl_shade(gl, diag) : dp_gl_paint_surface(gl, diag);
}

static dp_result ink(dp_gl *gl, dp_diag *diag) {
    dp_result result = DP_OK;
    if (!gl->scene.triangle_count || !(gl->style.lines & DP_ALL_LINES))
        result = DP_OK;
    else if (dp_gl_draws_fins(gl))
        result = dp_gl_ink_fins(gl, diag);
    else if (gl->style.ink == DP_INK_QUADS && gl->style.edges != DP_EDGES_ADJACENCY)
        result = dp_gl_ink_quads(gl, diag);
    else
        result = dp_gl_ink_strokes(gl, diag);
    return result || dp_gl_is_image(gl) ? result : dp_gl_show(gl, diag);
}

static dp_result draw_stages(dp_gl *gl, dp_diag *diag) {
    dp_result result = dp_gl_upload_block(gl, diag);
    if (!result) result = run(gl, DP_GL_STAGE_VERTICES, place, diag);
    if (!result && dp_gl_fins_in_one_pass(gl))
        result = run(gl, DP_GL_STAGE_MATES, dp_gl_find_mates, diag);
    if (!result) result = run(gl, DP_GL_STAGE_FACES, dp_gl_draw_faces, diag);
    if (!result) put_places(gl); /* which the framebuffer tells */
    if (!result) result = dp_gl_upload_block(gl, diag);
    if (!result && finds_lines(gl)) result = find_lines(gl, diag);
    if (!result && !finds_lines(gl)) forget_lines(gl);
    if (!result) result = run(gl, DP_GL_STAGE_SHADE, surface, diag);
    if (!result) result = run(gl, DP_GL_STAGE_INK, ink, diag);
    return result ? result : dp_gl_check(gl, "drawing a picture", diag);
}

static dp_result draw_scene(dp_gl *gl, dp_gl_mesh *const *meshes, size_t count,
                            const dp_camera *camera, dp_diag *diag) {
    gl->lines.have_read = false;
    dp_result result = dp_gl_scene_take(gl, meshes, count, diag);
    if (result) return result;
    gl->camera = dp_camera_about(camera, gl->scene.origin);
    result = dp_view_init(&gl->view, &gl->camera, gl->target.width, gl->target.height, diag);
    return result ? result : draw_stages(gl, diag);
}

/* Two pictures: the reflected scene, then the scene with the mirror, which shows it (Nienhaus and Döllner 2003, 5). */
static dp_result draw_mirrored(dp_gl *gl, dp_gl_mesh *const *meshes, size_t count,
                               const dp_camera *camera, dp_diag *diag) {
    dp_gl_mesh_list list;
    dp_result result = dp_gl_begin_image(gl, meshes, count, camera, &list, diag);
    if (!result) result = draw_scene(gl, list.meshes, list.count, camera, diag);
    if (!result) result = dp_gl_take_image(gl, diag);
    dp_gl_end_image(gl);
    if (!result) result = dp_gl_begin_mirrored(gl, meshes, count, &list, diag);
    if (!result) result = draw_scene(gl, list.meshes, list.count, camera, diag);
    dp_gl_end_mirrored(gl);
    return result;
}

dp_result dp_gl_draw(dp_gl *gl, dp_gl_mesh *const *meshes, size_t count, const dp_camera *camera,
                     const dp_style *style, const dp_gl_target *target, dp_diag *diag) {
    dp_gl_state *state;
    if (!gl || !camera || !target || (count && !meshes))
        return dp_fail(diag, DP_ERR_ARGUMENT, "dp_gl_draw: gl, meshes, camera or target is NULL");
    gl->drawn = false;
    const uint64_t bytes = gl->stats.bytes;
    gl->stats = (dp_gl_stats){.bytes = bytes};
    memset(gl->queried, 0, sizeof gl->queried);
    dp_result result = dp_gl_enter(gl, &state, diag);
    if (result) return result;
    result = begin(gl, meshes, count, style, target, diag);
    if (!result)
        result = gl->style.mirror.size > 0 ? draw_mirrored(gl, meshes, count, camera, diag)
                                           : draw_scene(gl, meshes, count, camera, diag);
    gl->drawn = !result;
    gl->stats.triangles = gl->scene.triangle_count, gl->stats.vertices = gl->scene.vertex_count;
    gl->stats.samples = gl->samples;
    dp_gl_leave(gl, state);
    return result;
}

void dp_gl_time_stages(dp_gl *gl, bool timed) {
    if (gl) gl->timed = timed;
}

/* If the application has bound a buffer for results of queries, they would go there. */
static double elapsed_ms(dp_gl *gl, const uint32_t queries[2]) {
    GLuint64 ns[2] = {0, 0};
    GLint buffer = 0;
    if (gl->version >= 440) gl->api.GetIntegerv(GL_QUERY_BUFFER_BINDING, &buffer);
    if (buffer) gl->api.BindBuffer(GL_QUERY_BUFFER, 0);
    for (int i = 0; i < 2; i++) gl->api.GetQueryObjectui64v(queries[i], GL_QUERY_RESULT, &ns[i]);
    if (buffer) gl->api.BindBuffer(GL_QUERY_BUFFER, (GLuint)buffer);
    return (double)(ns[1] - ns[0]) * 1e-6;
}

dp_result dp_gl_stats_of(dp_gl *gl, dp_gl_stats *stats, dp_diag *diag) {
    if (!gl || !stats) return dp_fail(diag, DP_ERR_ARGUMENT, "dp_gl_stats_of: gl or stats is NULL");
    for (int i = 0; i < DP_GL_STAGE_COUNT && !gl->is_lost; i++)
        gl->stats.stage_ms[i] = gl->queried[i] ? elapsed_ms(gl, gl->queries[i]) : 0;
    *stats = gl->stats;
    return DP_OK;
}
