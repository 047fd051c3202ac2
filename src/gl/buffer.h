/* Buffers and textures of the device that grow as pictures need them. */
#ifndef DP_GL_BUFFER_H
#define DP_GL_BUFFER_H

#include <drypoint/gl.h>

typedef struct dp_gl_buffer {
    uint32_t name; /* 0: none yet */
    size_t size;   /* bytes */
} dp_gl_buffer;

typedef struct dp_gl_texture {
    uint32_t name;
    uint32_t target; /* GL_TEXTURE_2D or GL_TEXTURE_2D_MULTISAMPLE */
    uint32_t format, width, height, samples;
} dp_gl_texture;

/* Makes room for at least `size` bytes, growing by at least half; what it held is lost if it grows.
 * DP_ERR_LIMIT beyond dp_gl_desc.memory (the message says what `what` is), DP_ERR_MEMORY. */
dp_result dp_gl_buffer_reserve(dp_gl *gl, dp_gl_buffer *buffer, size_t size, const char *what,
                               dp_diag *diag);
/* The same, and fills it from `data`. A size of 0 is made 16. */
dp_result dp_gl_buffer_fill(dp_gl *gl, dp_gl_buffer *buffer, const void *data, size_t size,
                            const char *what, dp_diag *diag);
/* Sets all bytes [0, size) to those of `word`, again and again. */
void dp_gl_buffer_clear(dp_gl *gl, const dp_gl_buffer *buffer, size_t size, uint32_t word);
void dp_gl_buffer_read(dp_gl *gl, const dp_gl_buffer *buffer, size_t offset, size_t size,
                       void *data);
void dp_gl_buffer_bind(dp_gl *gl, const dp_gl_buffer *buffer, uint32_t binding);
void dp_gl_buffer_free(dp_gl *gl, dp_gl_buffer *buffer);

/* A texture of this format and size, made anew where it has another. samples 0: GL_TEXTURE_2D, else
 * GL_TEXTURE_2D_MULTISAMPLE. Not filtered, clamped to its edge. */
dp_result dp_gl_texture_reserve(dp_gl *gl, dp_gl_texture *texture, uint32_t format, uint32_t width,
                                uint32_t height, uint32_t samples, const char *what, dp_diag *diag);
void dp_gl_texture_bind(dp_gl *gl, const dp_gl_texture *texture, uint32_t unit);
void dp_gl_texture_free(dp_gl *gl, dp_gl_texture *texture);

#endif
