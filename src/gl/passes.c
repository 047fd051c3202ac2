/* Programs that find lines, and how often they run.
 *
 * A list's length is read by a program of one invocation, which writes the arguments of an indirect dispatch; so the host
 * waits for nothing. Invariant: a list that was full has as many members as there is room for; its counter goes on, and
 * tells how much was wanted (dp_gl_grow_lines). */
#include "gl/passes.h"

/* Bytes of a list's member. */
enum { WORD = 8, HALF_EDGE = 4 };

static uint32_t rooms(const dp_gl_buffer *buffer, size_t size) {
    const size_t room = buffer->size / size;
    return room < UINT32_MAX ? (uint32_t)room : UINT32_MAX;
}

static uint32_t room_of(const dp_gl *gl, dp_gl_list list) {
    const dp_gl_lines_store *const l = &gl->lines;
    switch (list) {
    case DP_GL_LIST_SEGMENTS:
        return rooms(&l->segments, sizeof(dp_gl_segment));
    case DP_GL_LIST_CANDIDATES:
        return rooms(&l->candidates, sizeof(dp_gl_candidate));
    case DP_GL_LIST_DISPUTED:
        return rooms(&l->disputed, HALF_EDGE);
    case DP_GL_LIST_WORDS:
        return rooms(&l->words, WORD);
    case DP_GL_LIST_PAIRS:
        return rooms(&l->pairs, HALF_EDGE);
    case DP_GL_LIST_UNSURE:
        break;
    }
    return gl->scene.triangle_count;
}

dp_result dp_gl_pass_use(dp_gl *gl, const char *compute, const dp_gl_buffer *const own[DP_GL_OWN],
                         dp_diag *diag) {
    const dp_gl_program_desc desc = {.compute = compute};
    uint32_t program;
    const dp_result result = dp_gl_program(gl, &desc, &program, diag);
    if (result) return result;
    dp_gl_use(gl, program);
    dp_gl_scene_bind(gl);
    for (uint32_t i = 0; i < DP_GL_OWN && own[i]; i++)
        dp_gl_buffer_bind(gl, own[i], DP_GL_BIND_OWN + i);
    if (gl->faces.ids.name) dp_gl_faces_bind(gl, program);
    dp_gl_uniform_u(gl, program, "has_fans", gl->scene.has_fans);
    dp_gl_uniform_u(gl, program, "candidates_room", room_of(gl, DP_GL_LIST_CANDIDATES));
    dp_gl_uniform_u(gl, program, "disputed_room", room_of(gl, DP_GL_LIST_DISPUTED));
    dp_gl_uniform_u(gl, program, "pairs_room", room_of(gl, DP_GL_LIST_PAIRS));
    dp_gl_uniform_u(gl, program, "words_room", room_of(gl, DP_GL_LIST_WORDS));
    gl->api.Uniform2f(gl->api.GetUniformLocation(program, "depth_range"), gl->faces.range[0],
                      gl->faces.range[1]);
    return DP_OK;
}

dp_result dp_gl_pass_triangles(dp_gl *gl, const char *compute,
                               const dp_gl_buffer *const own[DP_GL_OWN], dp_diag *diag) {
    const dp_result result = dp_gl_pass_use(gl, compute, own, diag);
    if (!result) dp_gl_dispatch(gl, gl->scene.triangle_count);
    return result;
}

/* Writes the arguments. */
static dp_result count_groups(dp_gl *gl, dp_gl_list list, uint32_t times, dp_diag *diag) {
    static const dp_gl_program_desc desc = {.compute = "groups.comp"};
    uint32_t program;
    const dp_result result = dp_gl_program(gl, &desc, &program, diag);
    if (result) return result;
    dp_gl_use(gl, program);
    dp_gl_buffer_bind(gl, &gl->lines.counters, DP_GL_BIND_OWN);
    dp_gl_uniform_u(gl, program, "count_at", list);
    dp_gl_uniform_u(gl, program, "room", room_of(gl, list));
    dp_gl_uniform_u(gl, program, "times", times);
    gl->api.DispatchCompute(1, 1, 1);
    gl->api.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
    return DP_OK;
}

dp_result dp_gl_pass_list(dp_gl *gl, const char *compute, const dp_gl_buffer *const own[DP_GL_OWN],
                          dp_gl_list list, uint32_t times, dp_diag *diag) {
    const dp_gl_program_desc desc = {.compute = compute};
    const size_t arguments = offsetof(dp_gl_counters, groups);
    dp_result result = count_groups(gl, list, times, diag);
    if (!result && dp_gl_program_is_spared(gl, &desc, &gl->lines.counters, arguments)) return DP_OK;
    if (!result) result = dp_gl_pass_use(gl, compute, own, diag);
    if (result) return result;
    gl->api.BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, gl->lines.counters.name);
    gl->api.DispatchComputeIndirect((GLintptr)arguments);
    gl->api.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
    return DP_OK;
}
