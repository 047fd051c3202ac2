/* How the stages that find lines run their programs: with the buffers that they name, for every triangle or for every
 * member of a list whose length only the device knows. */
#ifndef DP_GL_PASSES_H
#define DP_GL_PASSES_H

#include "gl/gl.h"

enum { DP_GL_OWN = DP_GL_BINDINGS - DP_GL_BIND_OWN };

/* Lists, and where dp_gl_counters counts their members. */
typedef enum dp_gl_list {
    DP_GL_LIST_SEGMENTS = offsetof(dp_gl_counters, segments) / 4,
    DP_GL_LIST_CANDIDATES = offsetof(dp_gl_counters, candidates) / 4,
    DP_GL_LIST_DISPUTED = offsetof(dp_gl_counters, disputed) / 4,
    DP_GL_LIST_WORDS = offsetof(dp_gl_counters, wanted) / 4, /* of sample points */
    DP_GL_LIST_UNSURE,                                       /* triangles (sides.c) */
    DP_GL_LIST_PAIRS                                         /* half-edges (edges.c) */
} dp_gl_list;

/* Uses a compute program, with the scene, the faces, `own` from DP_GL_BIND_OWN on (up to a NULL) and what the passes
 * for lines know: has_fans, depth_range, …_room of each list. */
dp_result dp_gl_pass_use(dp_gl *gl, const char *compute, const dp_gl_buffer *const own[DP_GL_OWN],
                         dp_diag *diag);
/* The same, and runs it for every triangle. */
dp_result dp_gl_pass_triangles(dp_gl *gl, const char *compute,
                               const dp_gl_buffer *const own[DP_GL_OWN], dp_diag *diag);
/* The same, `times` for every member of the list. */
dp_result dp_gl_pass_list(dp_gl *gl, const char *compute, const dp_gl_buffer *const own[DP_GL_OWN],
                          dp_gl_list list, uint32_t times, dp_diag *diag);

#endif
