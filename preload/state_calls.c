/* state_calls.c: calls that change what lines depend on: they mark the context stale, or begin another
 * segment of the display list that is being compiled; then they go on to GL as they are. */
#include <drypoint/gl_preload.h>

#include "lines.h"
#include "lists.h"

/* Before such a call. */
static void state_changes(void) {
    struct context *const context = context_current();
    if (!context) return;
    context->stale = true;
    if (context->list) list_state_change(context);
}

#define DEFINE(name, parameters, arguments)                                                        \
    EXPORT void name parameters {                                                                  \
        state_changes();                                                                           \
        if (gl.name) gl.name arguments;                                                            \
    }
STATE_FUNCTIONS(DEFINE)

/* True when it was ours. GL never hears of it, unless we can draw nothing: then it says GL_INVALID_ENUM. */
static bool switch_lines(GLenum capability, bool on) {
    struct context *const context = capability == GL_SIL_RIDGE_VALLEY ? context_current() : NULL;
    if (!context || context->in_begin || !context_able(context)) return false;
    if (context->list)
        list_switch_lines(context, on);
    else
        context->lines = on;
    return true;
}

EXPORT void glEnable(GLenum capability) {
    if (switch_lines(capability, true)) return;
    state_changes();
    CALL(glEnable, capability);
}

EXPORT void glDisable(GLenum capability) {
    if (switch_lines(capability, false)) return;
    state_changes();
    CALL(glDisable, capability);
}

EXPORT GLboolean glIsEnabled(GLenum capability) {
    struct context *const context = context_current();
    if (capability == GL_SIL_RIDGE_VALLEY && context && !context->in_begin && context_able(context))
        return context->lines;
    return gl.glIsEnabled ? gl.glIsEnabled(capability) : GL_FALSE;
}

/* Also what the program did wrong before we looked. GL keeps the first error alone: one that came later is
 * dropped, as it would have been. */
EXPORT GLenum glGetError(void) {
    struct context *const context = context_current();
    if (context && context->error != GL_NO_ERROR && !context->in_begin) {
        const GLenum error = context->error;
        context->error = GL_NO_ERROR;
        gl.glGetError();
        return error;
    }
    return gl.glGetError ? gl.glGetError() : GL_NO_ERROR;
}

EXPORT GLint glRenderMode(GLenum mode) {
    state_changes();
    return gl.glRenderMode ? gl.glRenderMode(mode) : 0;
}

/* Lines belong to the window: they are due before the program turns to another framebuffer. */
static void leave_framebuffer(void) {
    struct context *const context = context_current();
    if (!context) return;
    frame_ink(context);
    context->stale = true;
}

EXPORT void glBindFramebuffer(GLenum target, GLuint name) {
    leave_framebuffer();
    CALL(glBindFramebuffer, target, name);
}

EXPORT void glBindFramebufferEXT(GLenum target, GLuint name) {
    leave_framebuffer();
    CALL(glBindFramebufferEXT, target, name);
}

#define DEFINE_READ(name, parameters, arguments)                                                   \
    EXPORT void name parameters {                                                                  \
        struct context *const context = context_current();                                         \
        if (context) frame_ink(context);                                                           \
        if (gl.name) gl.name arguments;                                                            \
    }
READ_FUNCTIONS(DEFINE_READ)

EXPORT void glClear(GLbitfield mask) {
    struct context *const context = context_current();
    if (context && context->list && list_clear(context, mask)) return;
    if (context && !context->list && !context->in_begin)
        frame_clear(context, mask);
    else
        CALL(glClear, mask);
}
