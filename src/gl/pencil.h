/* Pencil rendering: what it keeps (pencil.c). */
#ifndef DP_GL_PENCIL_H
#define DP_GL_PENCIL_H

#include "gl/gl.h"

#include "mesh/curvature.h"

typedef struct dp_gl_pencil {
    dp_curvature_store curvature; /* on the host */
    dp_gl_buffer along;           /* [vertex of the scene] vec3: direction of least curvature */
    uint64_t topology,
        placement;  /* what `along` was made of; 0: nothing, or what may change any time */
    uint32_t tones; /* array of textures, R8: brightness */
    uint32_t layers, width, height;
    bool is_own;                 /* the style's texture */
    dp_gl_texture tooth, powers; /* R8I [512][512]; R8UI [light][value] of powers_of */
    float powers_of[2];
} dp_gl_pencil;

void dp_gl_pencil_free(dp_gl *gl, dp_gl_pencil *pencil);

#endif
