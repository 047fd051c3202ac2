/* The G-buffer on the device: what each pixel shows (gbuffer/gbuffer.h has the CPU's, of the same values).
 *
 * It is filled from the samples' triangles once a picture, before anything is shaded. A shader that reads it says
 * `#include "gbuffer.glsl"`, which has functions for all of this, and its program is given to dp_gl_gbuffer_bind.
 *
 *     texture     format    a pixel's
 *     geometry    RGBA32F   unit normal, camera space (x right, y up, z towards the eye); distance along the line of sight,
 *                           DP_FAR where there is none (no surface, or a partial pixel: most of it is paper)
 *     what        RG32UI    x: 1 + triangle of the scene, 0: none
 *                           y: bits 0 to 15: 1 + group, 0: none; 16 to 23: the surface's share of the samples, of 255
 *     base        RGBA8     the surface's colour without light: the style's, the group's or the vertices'
 *     other       R32F      where the share is below 255: distance of the rest, DP_FAR: paper; of a partial pixel, of
 *                           its surface
 *     texcoord    RG32F     texture coordinates, NO_TEXCOORD where there are none; only if `textured` */
#ifndef DP_GL_GBUFFER_H
#define DP_GL_GBUFFER_H

#include "gl/gl.h"

#include "gbuffer/gbuffer.h"

/* Texture units of the G-buffer, and the first that a pass may use for itself. */
enum {
    DP_GL_UNIT_GEOMETRY = DP_GL_UNIT_OWN,
    DP_GL_UNIT_WHAT,
    DP_GL_UNIT_BASE,
    DP_GL_UNIT_OTHER,
    DP_GL_UNIT_TEXCOORD,
    DP_GL_UNIT_PASS
};

/* The block of values that passes share, at this binding of uniform blocks: shaders/shading.glsl has the same. */
enum { DP_GL_BLOCK_SHADING = 2 };

typedef struct dp_gl_gbuffer {
    dp_gl_texture geometry, what, base, other, texcoord;
    bool textured;
    uint32_t framebuffer;
} dp_gl_gbuffer;

/* Fills it for the picture's style, and uploads the block. gl->shading is there afterwards. */
dp_result dp_gl_gbuffer_fill(dp_gl *gl, dp_diag *diag);
/* Binds its textures and the block, and tells the program, which must be in use. */
void dp_gl_gbuffer_bind(dp_gl *gl, uint32_t program);
void dp_gl_gbuffer_free(dp_gl *gl, dp_gl_gbuffer *g);

/* A pass over all pixels of the picture into one texture of its size, with the G-buffer bound: makes the texture
 * and the framebuffer where needed, and binds all. The caller sets uniforms and draws (dp_gl_draw_whole). */
dp_result dp_gl_begin_pass(dp_gl *gl, const dp_gl_program_desc *desc, dp_gl_texture *to,
                           uint32_t format, uint32_t *program, dp_diag *diag);

#endif
