/* Visibility of lines: candidates become segments.
 *
 *    spines with sample points, a quarter of a pixel apart, lifted off the surface     visible_spines.comp
 *    points, 32 an invocation: are they hidden by what the samples around them show,
 *    or by what is joined to it?                                                       visible_points.comp
 *    runs of visible points → segments                                                 visible_segments.comp
 *    what hides their ends, when somebody reads them                                   visible_hiders.comp
 *
 * The same points as in find/visibility.c, and the same question: does a polygon that is not the line's own cover the
 * point, nearer by DP_PROBE_SLACK? There every polygon is asked; here those that are seen around the point, and from there
 * on over the surface. However long a spine is, its points are
 * divided between invocations, and its segments are whole. Data structure: lists with counters (dp_gl_counters); one that was full is made
 * larger, and the stages that fill them run again. Invariant: after dp_gl_grow_lines without `again` no list lacks a
 * member. Not handled: hiders that no sample around a point shows, nor a part of the same surface. */
#include "gl/lines.h"
#include "gl/scene.h"

/* Words of dp_gl_counters. */
enum {
    AT_CANDIDATES = offsetof(dp_gl_counters, candidates) / 4,
    AT_WORDS = offsetof(dp_gl_counters, wanted) / 4,
    AT_SEGMENTS = offsetof(dp_gl_counters, segments) / 4,
    AT_GROUPS = offsetof(dp_gl_counters, groups) / 4
};
/* Bytes: 32 sample points of a spine; a spine (shaders/lines.glsl). */
enum { WORD = 8, SPINE = 112, FIRST_ROOM = 1 << 14 };

static uint32_t rooms(const dp_gl_buffer *buffer, size_t size) {
    return (uint32_t)(buffer->size / size);
}

static dp_result reserve(dp_gl *gl, dp_diag *diag) {
    dp_gl_lines_store *const l = &gl->lines;
    const size_t candidates = rooms(&l->candidates, sizeof(dp_gl_candidate));
    dp_result result =
        dp_gl_buffer_reserve(gl, &l->spines, candidates * SPINE, "spines of lines", diag);
    if (!result)
        result = dp_gl_buffer_reserve(gl, &l->words, FIRST_ROOM * (size_t)WORD,
                                      "sample points of lines", diag);
    if (!result)
        result = dp_gl_buffer_reserve(gl, &l->segments, FIRST_ROOM * sizeof(dp_gl_segment),
                                      "segments", diag);
    if (!result && gl->block.counts[3] != rooms(&l->segments, sizeof(dp_gl_segment)))
        result = dp_gl_upload_block(gl, diag);
    return result;
}

/* Arguments of an indirect dispatch over `times` a list's members, at groups[slot]. */
static dp_result count_groups(dp_gl *gl, uint32_t count_at, uint32_t room, uint32_t times,
                              uint32_t slot, dp_diag *diag) {
    static const dp_gl_program_desc desc = {.compute = "groups.comp"};
    uint32_t program;
    const dp_result result = dp_gl_program(gl, &desc, &program, diag);
    if (result) return result;
    dp_gl_use(gl, program);
    dp_gl_buffer_bind(gl, &gl->lines.counters, DP_GL_BIND_OWN + 1);
    dp_gl_uniform_u(gl, program, "count_at", count_at);
    dp_gl_uniform_u(gl, program, "groups_at", AT_GROUPS + 4 * slot);
    dp_gl_uniform_u(gl, program, "room", room);
    dp_gl_uniform_u(gl, program, "times", times);
    gl->api.DispatchCompute(1, 1, 1);
    gl->api.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
    return DP_OK;
}

/* Runs a program for as many items as groups[slot] has, with these buffers from DP_GL_BIND_OWN on. */
static dp_result pass(dp_gl *gl, const char *compute, const dp_gl_buffer *const own[5],
                      uint32_t slot, dp_diag *diag) {
    const dp_gl_program_desc desc = {.compute = compute};
    const dp_gl_lines_store *const l = &gl->lines;
    uint32_t program;
    const dp_result result = dp_gl_program(gl, &desc, &program, diag);
    if (result) return result;
    dp_gl_use(gl, program);
    dp_gl_scene_bind(gl);
    for (uint32_t i = 0; i < 5; i++) dp_gl_buffer_bind(gl, own[i], DP_GL_BIND_OWN + i);
    dp_gl_faces_bind(gl, program);
    dp_gl_uniform_u(gl, program, "has_fans", gl->scene.has_fans);
    dp_gl_uniform_u(gl, program, "candidates_room", rooms(&l->candidates, sizeof(dp_gl_candidate)));
    dp_gl_uniform_u(gl, program, "words_room", rooms(&l->words, WORD));
    gl->api.Uniform2f(gl->api.GetUniformLocation(program, "depth_range"), gl->faces.range[0],
                      gl->faces.range[1]);
    gl->api.BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, l->counters.name);
    gl->api.DispatchComputeIndirect(
        (GLintptr)(offsetof(dp_gl_counters, groups) + slot * sizeof(uint32_t[4])));
    gl->api.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
    return DP_OK;
}

dp_result dp_gl_find_visible(dp_gl *gl, dp_diag *diag) {
    dp_gl_lines_store *const l = &gl->lines;
    const dp_gl_buffer *const points[5] = {&l->mates, &l->counters, &l->candidates, &l->spines,
                                           &l->words},
                              *const runs[5] = {&l->segments, &l->counters, &l->candidates,
                                                &l->spines, &l->words};
    dp_result result = reserve(gl, diag);
    if (!result)
        result = count_groups(gl, AT_CANDIDATES, rooms(&l->candidates, sizeof(dp_gl_candidate)), 1,
                              0, diag);
    if (!result) result = pass(gl, "visible_spines.comp", points, 0, diag);
    if (!result) result = count_groups(gl, AT_WORDS, rooms(&l->words, WORD), 1, 1, diag);
    if (!result) result = pass(gl, "visible_points.comp", points, 1, diag);
    if (!result) result = pass(gl, "visible_segments.comp", runs, 0, diag);
    l->have_hiders = false;
    return result;
}

dp_result dp_gl_find_hiders(dp_gl *gl, dp_diag *diag) {
    dp_gl_lines_store *const l = &gl->lines;
    const dp_gl_buffer *const own[5] = {&l->mates, &l->counters, &l->segments, &l->spines,
                                        &l->words};
    if (l->have_hiders || !gl->stats.segments) return DP_OK;
    dp_result result = count_groups(
        gl, AT_SEGMENTS, rooms(&l->segments, sizeof(dp_gl_segment)), 2, 1, diag);
    if (!result) result = pass(gl, "visible_hiders.comp", own, 1, diag);
    l->have_hiders = !result;
    return result;
}

/* Makes a list large enough, if it was not. */
static dp_result grow(dp_gl *gl, dp_gl_buffer *list, uint32_t count, size_t size, const char *what,
                      bool *again, dp_diag *diag) {
    if ((size_t)count * size <= list->size) return DP_OK;
    *again = true;
    return dp_gl_buffer_reserve(gl, list, (size_t)count * size, what, diag);
}

dp_result dp_gl_grow_lines(dp_gl *gl, bool *again, dp_diag *diag) {
    dp_gl_lines_store *const l = &gl->lines;
    dp_gl_counters c;
    *again = false;
    dp_gl_buffer_read(gl, &l->counters, 0, sizeof c, &c);
    gl->stats.candidates = c.candidates, gl->stats.segments = c.segments;
    dp_result result = grow(gl, &l->candidates, c.candidates, sizeof(dp_gl_candidate),
                            "edges that may be lines", again, diag);
    if (!result)
        result = grow(gl, &l->disputed, c.disputed, sizeof(uint32_t),
                      "edges of which the eye decides", again, diag);
    if (!result)
        result = grow(gl, &l->words, c.wanted[0], WORD, "sample points of lines", again, diag);
    if (!result)
        result = grow(gl, &l->segments, c.segments, sizeof(dp_gl_segment), "segments", again, diag);
    if (!result) result = dp_gl_grow_emerging(gl, again, diag);
    return result;
}

void dp_gl_lines_free(dp_gl *gl) {
    dp_gl_lines_store *const l = &gl->lines;
    dp_gl_buffer *const buffers[] = {&l->mates,    &l->slots,    &l->counters, &l->candidates,
                                     &l->segments, &l->disputed, &l->sides,    &l->spines,
                                     &l->words};
    for (size_t i = 0; i < sizeof buffers / sizeof *buffers; i++) dp_gl_buffer_free(gl, buffers[i]);
    for (size_t i = 0; i < sizeof l->own / sizeof *l->own; i++) dp_gl_buffer_free(gl, &l->own[i]);
    dp_gl_eye_free(gl);
}
