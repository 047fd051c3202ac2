/* Silhouettes by adjacency, as triangles (fins.c): what its files share. */
#ifndef DP_GL_FINS_H
#define DP_GL_FINS_H

#include "gl/pencil.h"

/* Bindings beside mates, which are at DP_GL_BIND_OWN. */
enum {
    DP_GL_BIND_RINGS = DP_GL_BIND_OWN + 1,
    DP_GL_BIND_CENTRE,
    DP_GL_BIND_FACING = DP_GL_BIND_CENTRE,
    DP_GL_BIND_LISTED,
    DP_GL_BIND_SUMS
};

struct dp_gl_fins {
    dp_gl_buffer six; /* [triangle][6] index buffer with adjacency */
    dp_gl_buffer
        rings; /* count, free; half-edges of edges of more than two, and their edge's first */
    dp_gl_buffer many;                 /* how rings are found */
    uint64_t topology;                 /* of six and rings */
    dp_gl_buffer facing, listed, sums; /* without a geometry shader: fins_list.comp */
    dp_gl_buffer centre;               /* of polar coordinates: stroke_texture.glsl */
    dp_gl_texture strokes[2];          /* of silhouettes and of borders */
    uint64_t stroke_keys[2];
    uint32_t framebuffer; /* of ink alone */
    dp_gl_pencil pencil;  /* the paper's other half: pencil.c */
};

/* Are outlines drawn so in this picture? And in the same pass as faces? */
bool dp_gl_draws_fins(const dp_gl *gl);
bool dp_gl_fins_in_one_pass(const dp_gl *gl);

/* fins.c. Makes gl->fins. */
dp_result dp_gl_fins_begin(dp_gl *gl, dp_diag *diag);
/* For faces.c. One pass: makes its textures layers of arrays, and attaches these to the bound framebuffer; then draws surface
 * and silhouettes. Frees ink and, if there are layers, all of them. */
dp_result dp_gl_fins_reserve_layers(dp_gl *gl, dp_diag *diag);
void dp_gl_fins_free_ink(dp_gl *gl);
dp_result dp_gl_fins_draw_once(dp_gl *gl, dp_diag *diag);

/* fins_edges.c: the index buffer with adjacency and the rings, kept while the topology stays; mates are known. Then, without a
 * geometry shader, the list of outlines. */
dp_result dp_gl_fins_adjacency(dp_gl *gl, dp_diag *diag);
dp_result dp_gl_fins_list(dp_gl *gl, dp_diag *diag);

/* fins_texture.c: stroke textures and the centre of polar coordinates; nothing without a texture. */
dp_result dp_gl_fins_texture(dp_gl *gl, dp_diag *diag);
/* Binds them. Lines of #define for programs that look them up. */
void dp_gl_fins_bind_texture(dp_gl *gl, uint32_t program);
const char *dp_gl_fins_texture_defines(const dp_gl *gl);

#endif
