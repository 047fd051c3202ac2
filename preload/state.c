/* state.c: reads from GL what a draw call will do, and decides whether it gets lines.
 *
 * GL is asked, not followed: the many ways to change a matrix or to enable blending need no model here.
 * The calls that can change what is read here mark the context stale (state_calls.c), and only then the
 * questions are asked again, at the next draw call.
 *
 * Not handled: texturing is looked for on the first texture unit only; glMatrixLoadfEXT and its kin
 * (direct state access) do not mark the context stale. */
#include "context.h"

#include <math.h>
#include <string.h>

static int integer(GLenum name) {
    GLint value[4] = {0}; /* GL_POLYGON_MODE is two */
    gl.glGetIntegerv(name, value);
    return value[0];
}

/* Newer names are only asked where no error can follow. */
static bool own_shaders(void) {
    return integer(GL_CURRENT_PROGRAM) != 0 || gl.glIsEnabled(GL_VERTEX_PROGRAM_ARB) ||
           gl.glIsEnabled(GL_FRAGMENT_PROGRAM_ARB) ||
           (gl.glBindProgramPipeline && integer(GL_PROGRAM_PIPELINE_BINDING) != 0);
}

static bool textured(void) {
    static const GLenum targets[] = {GL_TEXTURE_1D, GL_TEXTURE_2D, GL_TEXTURE_3D,
                                     GL_TEXTURE_CUBE_MAP, GL_TEXTURE_RECTANGLE};
    const int unit = integer(GL_ACTIVE_TEXTURE);
    if (unit != GL_TEXTURE0) gl.glActiveTexture(GL_TEXTURE0);
    bool any = false;
    for (size_t i = 0; i < sizeof targets / sizeof targets[0]; i++)
        any = any || gl.glIsEnabled(targets[i]);
    if (unit != GL_TEXTURE0) gl.glActiveTexture((GLenum)unit);
    return any;
}

static bool blended(void) {
    return gl.glIsEnabled(GL_BLEND) &&
           !(integer(GL_BLEND_SRC) == GL_ONE && integer(GL_BLEND_DST) == GL_ZERO);
}

/* Surfaces that lines can lie on write colour and depth, nearest first. */
static bool is_solid(void) {
    GLint modes[2] = {GL_FILL, GL_FILL};
    GLboolean mask[4] = {GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE};
    const int function = integer(GL_DEPTH_FUNC);
    gl.glGetIntegerv(GL_POLYGON_MODE, modes);
    gl.glGetBooleanv(GL_COLOR_WRITEMASK, mask);
    return integer(GL_DEPTH_WRITEMASK) && (function == GL_LESS || function == GL_LEQUAL) &&
           modes[0] == GL_FILL && mask[0] | mask[1] | mask[2] &&
           integer(GL_RENDER_MODE) == GL_RENDER &&
           !(gl.glIsEnabled(GL_CULL_FACE) && integer(GL_CULL_FACE_MODE) == GL_FRONT_AND_BACK);
}

static enum verdict judge(void) {
    if (own_shaders()) {
        say_once(SAY_SHADERS, "what the program draws with its own shaders is left as it is");
        return DRAW_UNTOUCHED;
    }
    if (integer(GL_DRAW_FRAMEBUFFER_BINDING) != 0) {
        say_once(SAY_FRAMEBUFFER, "what is drawn into framebuffer objects is left as it is");
        return DRAW_UNTOUCHED;
    }
    if (!gl.glIsEnabled(GL_DEPTH_TEST)) return DRAW_ABOVE_ALL;
    if (!is_solid()) return DRAW_UNTOUCHED;
    if (!settings()->textured && textured()) {
        say_once(SAY_TEXTURED,
                 "textured polygons are left as they are (DRYPOINT_ALSO=textured: not)");
        return DRAW_UNTOUCHED;
    }
    if (!settings()->blended && blended()) {
        say_once(SAY_BLENDED, "blended polygons are left as they are (DRYPOINT_ALSO=blended: not)");
        return DRAW_UNTOUCHED;
    }
    return DRAW_WITH_LINES;
}

static float determinant(const float *a, const float *b, const float *c, int i, int j, int k) {
    return a[i] * (b[j] * c[k] - b[k] * c[j]) - a[j] * (b[i] * c[k] - b[k] * c[i]) +
           a[k] * (b[i] * c[j] - b[j] * c[i]);
}

/* The point that the projection maps to no pixel: x, y and w are 0 there. It is the 4D cross product
 * of those three rows. For gluPerspective this is the eye, (0, 0, 0, 1), but for a scale; for glOrtho a
 * direction; and programs that put gluLookAt into the projection have it elsewhere. */
static void find_viewpoint(struct draw_state *state) {
    float row[3][4];
    static const int rows[3] = {0, 1, 3};
    for (int r = 0; r < 3; r++)
        for (int k = 0; k < 4; k++) row[r][k] = state->projection[4 * k + rows[r]];
    float *const v = state->viewpoint;
    v[0] = determinant(row[0], row[1], row[2], 1, 2, 3);
    v[1] = -determinant(row[0], row[1], row[2], 0, 2, 3);
    v[2] = determinant(row[0], row[1], row[2], 0, 1, 3);
    v[3] = -determinant(row[0], row[1], row[2], 0, 1, 2);
    float size = 0;
    for (int k = 0; k < 4; k++) size = fmaxf(size, fabsf(v[k]));
    for (int k = 0; k < 4 && size > 0; k++) v[k] /= size;
}

/* Modelview matrices end in the row (0, 0, 0, 1), or what we do in eye space means nothing. */
static bool matrices_are_usual(const struct draw_state *state) {
    const float *const m = state->modelview;
    const float *const v = state->viewpoint;
    bool finite = true;
    for (int i = 0; i < 16; i++)
        finite = finite && isfinite(m[i]) && isfinite(state->projection[i]);
    return finite && m[3] == 0 && m[7] == 0 && m[11] == 0 && m[15] == 1 &&
           (v[0] != 0 || v[1] != 0 || v[2] != 0 || v[3] != 0);
}

static void read_facing(struct draw_state *state) {
    state->fronts = integer(GL_FRONT_FACE) == GL_CW ? -1 : 1;
    state->culled = 0;
    if (gl.glIsEnabled(GL_CULL_FACE))
        state->culled = integer(GL_CULL_FACE_MODE) == GL_FRONT ? state->fronts : -state->fronts;
}

static void read_geometry(struct context *context) {
    struct draw_state *const state = &context->state;
    gl.glGetFloatv(GL_MODELVIEW_MATRIX, state->modelview);
    gl.glGetFloatv(GL_PROJECTION_MATRIX, state->projection);
    gl.glGetIntegerv(GL_VIEWPORT, state->viewport);
    gl.glGetFloatv(GL_DEPTH_RANGE, state->range);
    memcpy(state->scissor, state->viewport, sizeof state->scissor);
    if (gl.glIsEnabled(GL_SCISSOR_TEST)) gl.glGetIntegerv(GL_SCISSOR_BOX, state->scissor);
    read_facing(state);
    find_viewpoint(state);
    if (state->viewport[2] < 1 || state->viewport[3] < 1) context->verdict = DRAW_UNTOUCHED;
    if (matrices_are_usual(state)) return;
    context->verdict = DRAW_UNTOUCHED;
    say_once(SAY_MATRICES, "polygons with a projective modelview matrix are left as they are");
}

void context_read_state(struct context *context) {
    if (!context->stale) return;
    context->stale = false;
    context_errors_begin(context);
    context->verdict = judge();
    if (context->verdict == DRAW_WITH_LINES) read_geometry(context);
    context_errors_end();
}
