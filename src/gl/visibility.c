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
#include "gl/passes.h"
#include "gl/scene.h"

/* Bytes: 32 sample points of a spine; a spine (shaders/lines.glsl). */
enum { WORD = 8, SPINE = 112, FIRST_ROOM = 1 << 14 };

static dp_result reserve(dp_gl *gl, dp_diag *diag) {
    dp_gl_lines_store *const l = &gl->lines;
    const size_t candidates = l->candidates.size / sizeof(dp_gl_candidate);
    dp_result result =
        dp_gl_buffer_reserve(gl, &l->spines, candidates * SPINE, "spines of lines", diag);
    if (!result)
        result = dp_gl_buffer_reserve(gl, &l->words, FIRST_ROOM * (size_t)WORD,
                                      "sample points of lines", diag);
    if (!result)
        result = dp_gl_buffer_reserve(gl, &l->segments, FIRST_ROOM * sizeof(dp_gl_segment),
                                      "segments", diag);
    if (!result && gl->block.counts[3] != l->segments.size / sizeof(dp_gl_segment))
        result = dp_gl_upload_block(gl, diag);
    return result;
}

dp_result dp_gl_find_visible(dp_gl *gl, dp_diag *diag) {
    dp_gl_lines_store *const l = &gl->lines;
    const dp_gl_buffer *const points[DP_GL_OWN] = {&l->mates, &l->counters, &l->candidates,
                                                   &l->spines, &l->words},
                              *const runs[DP_GL_OWN] = {&l->segments, &l->counters, &l->candidates,
                                                        &l->spines, &l->words};
    dp_result result = reserve(gl, diag);
    if (!result)
        result = dp_gl_pass_list(gl, "visible_spines.comp", points, DP_GL_LIST_CANDIDATES, 1, diag);
    if (!result)
        result = dp_gl_pass_list(gl, "visible_points.comp", points, DP_GL_LIST_WORDS, 1, diag);
    if (!result)
        result = dp_gl_pass_list(gl, "visible_segments.comp", runs, DP_GL_LIST_CANDIDATES, 1, diag);
    l->have_hiders = false;
    return result;
}

dp_result dp_gl_find_hiders(dp_gl *gl, dp_diag *diag) {
    dp_gl_lines_store *const l = &gl->lines;
    const dp_gl_buffer *const own[DP_GL_OWN] = {&l->mates, &l->counters, &l->segments};
    if (l->have_hiders || !gl->stats.segments) return DP_OK;
    const dp_result result =
        dp_gl_pass_list(gl, "visible_hiders.comp", own, DP_GL_LIST_SEGMENTS, 2, diag);
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
        result = grow(gl, &l->pairs, c.wanted[DP_GL_LIST_PAIRS - DP_GL_LIST_WORDS],
                      sizeof(uint32_t), "edges that are not flat", again, diag);
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
                                     &l->words,    &l->pairs};
    for (size_t i = 0; i < sizeof buffers / sizeof *buffers; i++) dp_gl_buffer_free(gl, buffers[i]);
    dp_gl_eye_free(gl);
}
