/* What comes back from the device as it is: buffers of lines, and pixels. */
#include "gl/lines.h"

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

dp_result dp_gl_read(dp_gl *gl, const dp_gl_target *target, uint8_t *rgba, size_t stride,
                     dp_diag *diag) {
    dp_gl_state *state;
    if (!gl || !target || !rgba)
        return dp_fail(diag, DP_ERR_ARGUMENT, "dp_gl_read: gl, target or rgba is NULL");
    const size_t row = 4 * (size_t)target->width, step = stride ? stride : row;
    if (step < row || step % 4)
        return dp_fail(diag, DP_ERR_ARGUMENT, "dp_gl_read: stride %zu is less than a row, or odd",
                       step);
    dp_result result = dp_gl_enter(gl, &state, diag);
    if (result) return result;
    gl->api.BindFramebuffer(GL_READ_FRAMEBUFFER, target->framebuffer);
    gl->api.PixelStorei(GL_PACK_ROW_LENGTH, (GLint)(step / 4));
    gl->api.ReadPixels(target->x, target->y, (GLsizei)target->width, (GLsizei)target->height,
                       GL_RGBA, GL_UNSIGNED_BYTE, rgba);
    result = dp_gl_check(gl, "reading a picture", diag);
    dp_gl_leave(gl, state);
    turn_rows(rgba, step, target->width, target->height);
    return result;
}
