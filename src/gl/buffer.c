/* Buffers and textures of the device that grow as pictures need them.
 *
 * Nothing is asked of the device after each call: whether its memory is out is asked once a picture
 * (dp_gl_check), but for what is large and new, where it is asked at once. */
#include "gl/gl.h"

enum { DEFAULT_MOST = 1 << 30 /* bytes: dp_gl_desc.memory */ };

static size_t allowed(const dp_gl *gl) { return gl->desc.memory ? gl->desc.memory : DEFAULT_MOST; }

static size_t most_of(const dp_gl *gl) {
    return allowed(gl) < gl->storage_most ? allowed(gl) : gl->storage_most;
}

static dp_result too_large(uint64_t size, size_t most, const char *what, dp_diag *diag) {
    return dp_fail(diag, DP_ERR_LIMIT, "%s would take %.1f MB of the device; %.1f MB are allowed",
                   what, (double)size / 1048576, (double)most / 1048576);
}

/* A buffer of `size` bytes; what it held is gone. */
static dp_result make(dp_gl *gl, dp_gl_buffer *buffer, size_t size, const void *data,
                      const char *what, dp_diag *diag) {
    const dp_gl_api *const a = &gl->api;
    if (!buffer->name) a->GenBuffers(1, &buffer->name);
    a->BindBuffer(GL_COPY_WRITE_BUFFER, buffer->name);
    a->BufferData(GL_COPY_WRITE_BUFFER, (GLsizeiptr)size, data, GL_DYNAMIC_COPY);
    gl->stats.bytes += size - buffer->size;
    buffer->size = size;
    const dp_result result = dp_gl_check(gl, what, diag);
    if (result) dp_gl_buffer_free(gl, buffer);
    return result;
}

dp_result dp_gl_buffer_reserve(dp_gl *gl, dp_gl_buffer *buffer, size_t size, const char *what,
                               dp_diag *diag) {
    const size_t most = most_of(gl), half = buffer->size / 2;
    if (buffer->name && size <= buffer->size) return DP_OK;
    if (size > most) return too_large(size, most, what, diag);
    size_t grown = size > buffer->size + half ? size : buffer->size + half;
    if (grown > most) grown = most;
    return make(gl, buffer, grown < 64 ? 64 : (grown + 15) / 16 * 16, NULL, what, diag);
}

dp_result dp_gl_buffer_fill(dp_gl *gl, dp_gl_buffer *buffer, const void *data, size_t size,
                            const char *what, dp_diag *diag) {
    if (size > most_of(gl)) return too_large(size, most_of(gl), what, diag);
    if (!size) return dp_gl_buffer_reserve(gl, buffer, 16, what, diag);
    if (buffer->name && size <= buffer->size && size > buffer->size / 2) {
        gl->api.BindBuffer(GL_COPY_WRITE_BUFFER, buffer->name);
        gl->api.BufferSubData(GL_COPY_WRITE_BUFFER, 0, (GLsizeiptr)size, data);
        return DP_OK;
    }
    return make(gl, buffer, size, data, what, diag);
}

void dp_gl_buffer_clear(dp_gl *gl, const dp_gl_buffer *buffer, size_t size, uint32_t word) {
    gl->api.BindBuffer(GL_COPY_WRITE_BUFFER, buffer->name);
    gl->api.ClearBufferSubData(GL_COPY_WRITE_BUFFER, GL_R32UI, 0, (GLsizeiptr)(size / 4 * 4),
                               GL_RED_INTEGER, GL_UNSIGNED_INT, &word);
}

void dp_gl_buffer_read(dp_gl *gl, const dp_gl_buffer *buffer, size_t offset, size_t size,
                       void *data) {
    gl->api.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    gl->api.BindBuffer(GL_COPY_READ_BUFFER, buffer->name);
    gl->api.GetBufferSubData(GL_COPY_READ_BUFFER, (GLintptr)offset, (GLsizeiptr)size, data);
}

void dp_gl_buffer_bind(dp_gl *gl, const dp_gl_buffer *buffer, uint32_t binding) {
    gl->api.BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, buffer->name);
}

void dp_gl_buffer_free(dp_gl *gl, dp_gl_buffer *buffer) {
    if (buffer->name) gl->api.DeleteBuffers(1, &buffer->name);
    gl->stats.bytes -= buffer->size;
    *buffer = (dp_gl_buffer){0};
}

static uint64_t bytes_of(const dp_gl_texture *t) {
    const uint64_t texels = (uint64_t)t->width * t->height * (t->samples ? t->samples : 1);
    return 4 * texels; /* all our formats but a few have 32 bits */
}

dp_result dp_gl_texture_reserve(dp_gl *gl, dp_gl_texture *texture, uint32_t format, uint32_t width,
                                uint32_t height, uint32_t samples, const char *what,
                                dp_diag *diag) {
    const dp_gl_api *const a = &gl->api;
    if (texture->name && texture->format == format && texture->width == width &&
        texture->height == height && texture->samples == samples)
        return DP_OK;
    dp_gl_texture_free(gl, texture);
    *texture = (dp_gl_texture){.target = samples ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D,
                               .format = format,
                               .width = width,
                               .height = height,
                               .samples = samples};
    if (bytes_of(texture) > allowed(gl)) {
        const uint64_t bytes = bytes_of(texture);
        *texture = (dp_gl_texture){0};
        return too_large(bytes, allowed(gl), what, diag);
    }
    a->GenTextures(1, &texture->name);
    a->ActiveTexture(GL_TEXTURE0);
    a->BindTexture(texture->target, texture->name);
    if (samples) {
        a->TexStorage2DMultisample(GL_TEXTURE_2D_MULTISAMPLE, (GLsizei)samples, format,
                                   (GLsizei)width, (GLsizei)height, GL_TRUE);
    } else {
        a->TexStorage2D(GL_TEXTURE_2D, 1, format, (GLsizei)width, (GLsizei)height);
        a->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        a->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        a->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        a->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    }
    gl->stats.bytes += bytes_of(texture);
    const dp_result result = dp_gl_check(gl, what, diag);
    if (result) dp_gl_texture_free(gl, texture);
    return result;
}

void dp_gl_texture_bind(dp_gl *gl, const dp_gl_texture *texture, uint32_t unit) {
    if (!texture->name)
        return; /* there is none yet: a pass before faces are drawn does not read them */
    gl->api.ActiveTexture(GL_TEXTURE0 + unit);
    gl->api.BindTexture(texture->target, texture->name);
}

void dp_gl_texture_free(dp_gl *gl, dp_gl_texture *texture) {
    if (texture->name) {
        gl->api.DeleteTextures(1, &texture->name);
        gl->stats.bytes -= bytes_of(texture);
    }
    *texture = (dp_gl_texture){0};
}
