/* Added polygons as ink (Raskar 2001): what the files quads*.c share. */
#ifndef DP_GL_QUADS_H
#define DP_GL_QUADS_H

#include "gl/gl.h"

/* Lists of added polygons, of which each is drawn in its own way. */
enum { DP_GL_ADDED_LINES, DP_GL_ADDED_JOINTS, DP_GL_ADDED_VALLEYS, DP_GL_ADDED_LISTS };

struct dp_gl_quads {
    dp_gl_texture lines;   /* R8UI: 1 + the class of the line that stands before the surface; 0 */
    dp_gl_texture depth;   /* of faces and of those lines */
    dp_gl_texture trapped; /* R8UI: the same of valleys and intersections */
    dp_gl_texture stencil; /* DEPTH32F_STENCIL8: depth of faces, and how many are trapped */
    dp_gl_texture under;   /* RGBA8: the picture beneath ink */
    uint32_t framebuffer;
    dp_gl_buffer records;  /* Added, of one portion of half-edges */
    dp_gl_buffer commands; /* a DrawArraysIndirectCommand a list and portion */
    dp_gl_buffer faces;    /* Face in quads_faces.glsl: planes of all triangles */
    dp_gl_buffer blocks;   /* float: the farthest depth of the surface in each 8 x 8 px */
    dp_gl_buffer counts, order, states; /* one pass: quads_once.c */
    float range[2];                     /* dp_gl_depth_range */
};

/* How half-edges are taken in portions, and what a portion may add. */
typedef struct dp_gl_portions {
    uint32_t edges;                   /* of a portion; a multiple of 3 */
    uint32_t count;                   /* of portions */
    uint32_t room[DP_GL_ADDED_LISTS]; /* the most that a half-edge adds to a list */
    uint32_t ends[DP_GL_ADDED_LISTS]; /* where a portion's lists end */
    uint32_t places;                  /* the most that a half-edge adds */
} dp_gl_portions;

/* quads_shade.c: fills `out`, reserves lists and writes commands; `once`: lists are in order, faces too. */
dp_result dp_gl_quads_portion(dp_gl *gl, bool once, dp_gl_portions *out, dp_diag *diag);
/* Runs the primitive shader over portion i. */
dp_result dp_gl_quads_shade(dp_gl *gl, const dp_gl_portions *portions, uint32_t i, bool once,
                            dp_diag *diag);
/* quads_once.c: all in one pass, into `states`. */
dp_result dp_gl_quads_once(dp_gl *gl, dp_diag *diag);

/* Moves depth d away from the eye by px pixel sizes: d * out[0] + out[1]. */
void dp_gl_depth_move(const dp_gl *gl, double px, float out[2]);
void dp_gl_uniform_2f(dp_gl *gl, uint32_t program, const char *name, const float value[2]);
/* Attaches textures (depth: NULL allowed) to the framebuffer and binds it. */
dp_result dp_gl_quads_attach(dp_gl *gl, const dp_gl_texture *color, const dp_gl_texture *depth,
                             dp_diag *diag);

/* Does one polygon draw the whole width of valleys (printed/quads.c)? */
static inline bool dp_gl_is_once(const dp_style *s) {
    return s->between == DP_BETWEEN_INTERVAL && s->passes == 1;
}

#endif
