/* What comes back from the device as it is: buffers of lines, and pixels. */
#include "gl/lines.h"
#include "gl/scene.h"
#include "gl/surface.h"

#include <string.h>

dp_result dp_gl_lines_of(dp_gl *gl, dp_gl_lines *out, dp_diag *diag) {
    if (!gl || !out) return dp_fail(diag, DP_ERR_ARGUMENT, "dp_gl_lines_of: gl or out is NULL");
    if (!gl->drawn) return dp_fail(diag, DP_ERR_ARGUMENT, "dp_gl_lines_of: nothing has been drawn");
    dp_gl_state *state;
    dp_result result = dp_gl_enter(gl, &state, diag);
    if (result) return result;
    result = dp_gl_find_hiders(gl, diag);
    dp_gl_leave(gl, state);
    *out = (dp_gl_lines){gl->lines.segments.name, gl->lines.counters.name,
                         offsetof(dp_gl_counters, segments)};
    return result;
}

static void turn_rows(uint8_t *rgba, size_t stride, uint32_t width, uint32_t height) {
    for (uint32_t y = 0; y < height / 2; y++) {
        uint8_t *const a = rgba + y * stride, *const b = rgba + (height - 1 - y) * stride;
        for (uint32_t x = 0; x < 4 * width; x++) {
            const uint8_t swap = a[x];
            a[x] = b[x], b[x] = swap;
        }
    }
}

/* Several samples of each pixel cannot be read: their means are put into a framebuffer of our own. */
static dp_result resolve(dp_gl *gl, const dp_gl_target *t, dp_gl_texture *mean, GLuint *framebuffer,
                         dp_diag *diag) {
    const dp_gl_api *const a = &gl->api;
    const dp_result result = dp_gl_texture_reserve(gl, mean, GL_RGBA8, t->width, t->height, 0,
                                                   "a picture that is read", diag);
    if (result) return result;
    const GLint w = (GLint)t->width, h = (GLint)t->height;
    a->GenFramebuffers(1, framebuffer);
    a->BindFramebuffer(GL_DRAW_FRAMEBUFFER, *framebuffer);
    a->FramebufferTexture(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, mean->name, 0);
    a->BlitFramebuffer(t->x, t->y, t->x + w, t->y + h, 0, 0, w, h, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    a->BindFramebuffer(GL_READ_FRAMEBUFFER, *framebuffer);
    return DP_OK;
}

/* Reads what the framebuffer's first draw buffer holds. */
static dp_result read_rows(dp_gl *gl, const dp_gl_target *t, uint8_t *rgba, size_t step,
                           dp_diag *diag) {
    const dp_gl_api *const a = &gl->api;
    GLint drawn = 0, read = 0, several = 0;
    GLuint framebuffer = 0;
    dp_gl_texture mean = {0};
    dp_result result = dp_gl_bind_framebuffer(gl, GL_READ_FRAMEBUFFER, t->framebuffer, diag);
    if (!result) result = dp_gl_bind_framebuffer(gl, GL_DRAW_FRAMEBUFFER, t->framebuffer, diag);
    if (result) return result;
    a->GetIntegerv(GL_DRAW_BUFFER0, &drawn);
    a->GetIntegerv(GL_READ_BUFFER, &read);
    a->GetIntegerv(GL_SAMPLE_BUFFERS, &several);
    a->ReadBuffer((GLenum)drawn);
    if (several) result = resolve(gl, t, &mean, &framebuffer, diag);
    a->PixelStorei(GL_PACK_ROW_LENGTH, (GLint)(step / 4));
    if (!result)
        a->ReadPixels(several ? 0 : t->x, several ? 0 : t->y, (GLsizei)t->width, (GLsizei)t->height,
                      GL_RGBA, GL_UNSIGNED_BYTE, rgba);
    if (!result) result = dp_gl_check(gl, "reading a picture", diag);
    a->BindFramebuffer(GL_READ_FRAMEBUFFER, t->framebuffer);
    a->ReadBuffer((GLenum)read);
    if (framebuffer) a->DeleteFramebuffers(1, &framebuffer);
    dp_gl_texture_free(gl, &mean);
    return result;
}

dp_result dp_gl_read(dp_gl *gl, const dp_gl_target *target, uint8_t *rgba, size_t stride,
                     dp_diag *diag) {
    dp_gl_state *state;
    if (!gl || !target || !rgba)
        return dp_fail(diag, DP_ERR_ARGUMENT, "dp_gl_read: gl, target or rgba is NULL");
    const size_t row = 4 * (size_t)target->width, step = stride ? stride : row;
    if (step < row || step % 4 || step / 4 > INT32_MAX)
        return dp_fail(diag, DP_ERR_ARGUMENT,
                       "dp_gl_read: stride %zu is less than a row, too large or no multiple of 4",
                       step);
    dp_result result = dp_gl_check_target(gl, target, diag);
    if (!result) result = dp_gl_enter(gl, &state, diag);
    if (result) return result;
    result = read_rows(gl, target, rgba, step, diag);
    dp_gl_leave(gl, state);
    if (!result) turn_rows(rgba, step, target->width, target->height);
    return result;
}
