/* window.c: where a frame ends: swapping buffers, glFlush on single-buffered windows, another context.
 *
 * GLX and EGL are wrapped, and the two toolkits that load libGL themselves, so that their own calls to GLX do not
 * come by here: glfwSwapBuffers and SDL_GL_SwapWindow. Contexts are noted when they are made, for what they
 * share, and forgotten when they are destroyed. */
#include "lines.h"

static void finish_frame(void) {
    struct context *const context = context_current();
    if (!context || context->in_begin) return;
    frame_ink(context);
    frame_reset(context);
}

/* The lines of the context that the thread leaves. */
static void leave_context(void) {
    struct context *const context = context_current();
    if (context) frame_ink(context);
}

/* ---- GLX ---- */

EXPORT void glXSwapBuffers(Display *display, GLXDrawable drawable) {
    finish_frame();
    CALL(glXSwapBuffers, display, drawable);
}

EXPORT Bool glXMakeCurrent(Display *display, GLXDrawable drawable, GLXContext context) {
    leave_context();
    return gl.glXMakeCurrent ? gl.glXMakeCurrent(display, drawable, context) : False;
}

EXPORT Bool glXMakeContextCurrent(Display *display, GLXDrawable draw, GLXDrawable read,
                                  GLXContext context) {
    leave_context();
    return gl.glXMakeContextCurrent ? gl.glXMakeContextCurrent(display, draw, read, context)
                                    : False;
}

EXPORT GLXContext glXCreateContext(Display *display, XVisualInfo *visual, GLXContext share,
                                   Bool direct) {
    real_load();
    if (!gl.glXCreateContext) return NULL;
    const GLXContext made = gl.glXCreateContext(display, visual, share, direct);
    context_shares((void *)made, (void *)share);
    return made;
}

EXPORT GLXContext glXCreateNewContext(Display *display, GLXFBConfig config, int type,
                                      GLXContext share, Bool direct) {
    real_load();
    if (!gl.glXCreateNewContext) return NULL;
    const GLXContext made = gl.glXCreateNewContext(display, config, type, share, direct);
    context_shares((void *)made, (void *)share);
    return made;
}

EXPORT GLXContext glXCreateContextAttribsARB(Display *display, GLXFBConfig config, GLXContext share,
                                             Bool direct, const int *attributes) {
    real_load();
    if (!gl.glXCreateContextAttribsARB) return NULL;
    const GLXContext made =
        gl.glXCreateContextAttribsARB(display, config, share, direct, attributes);
    context_shares((void *)made, (void *)share);
    return made;
}

EXPORT void glXDestroyContext(Display *display, GLXContext context) {
    real_load();
    context_forget((void *)context);
    CALL(glXDestroyContext, display, context);
}

/* ---- EGL ---- */

EXPORT unsigned eglSwapBuffers(void *display, void *surface) {
    finish_frame();
    return gl.eglSwapBuffers ? gl.eglSwapBuffers(display, surface) : 0;
}

EXPORT unsigned eglSwapBuffersWithDamageEXT(void *display, void *surface, const int *rects,
                                            int count) {
    finish_frame();
    return gl.eglSwapBuffersWithDamageEXT
               ? gl.eglSwapBuffersWithDamageEXT(display, surface, rects, count)
               : 0;
}

EXPORT unsigned eglSwapBuffersWithDamageKHR(void *display, void *surface, const int *rects,
                                            int count) {
    finish_frame();
    return gl.eglSwapBuffersWithDamageKHR
               ? gl.eglSwapBuffersWithDamageKHR(display, surface, rects, count)
               : 0;
}

EXPORT unsigned eglMakeCurrent(void *display, void *draw, void *read, void *context) {
    leave_context();
    return gl.eglMakeCurrent ? gl.eglMakeCurrent(display, draw, read, context) : 0;
}

EXPORT void *eglCreateContext(void *display, void *config, void *share, const int *attributes) {
    real_load();
    if (!gl.eglCreateContext) return NULL;
    void *const made = gl.eglCreateContext(display, config, share, attributes);
    context_shares(made, share);
    return made;
}

EXPORT unsigned eglDestroyContext(void *display, void *context) {
    real_load();
    context_forget(context);
    return gl.eglDestroyContext ? gl.eglDestroyContext(display, context) : 0;
}

/* ---- toolkits ---- */

EXPORT void glfwSwapBuffers(void *window) {
    finish_frame();
    CALL(glfwSwapBuffers, window);
}

EXPORT void SDL_GL_SwapWindow(void *window) {
    finish_frame();
    CALL(SDL_GL_SwapWindow, window);
}

/* ---- single-buffered windows ---- */

/* Some draw for minutes without clearing, a little at a time: what was shown is not drawn again. */
static void show_single_buffer(void) {
    struct context *const context = context_current();
    if (!context || context->in_begin || context->frame.inked == context->frame.count) return;
    GLboolean twice = GL_TRUE;
    gl.glGetBooleanv(GL_DOUBLEBUFFER, &twice);
    if (twice) return;
    frame_ink(context);
    frame_reset(context);
}

EXPORT void glFlush(void) {
    show_single_buffer();
    CALL(glFlush);
}

EXPORT void glFinish(void) {
    show_single_buffer();
    CALL(glFinish);
}

/* ---- functions by name ---- */

EXPORT __GLXextFuncPtr glXGetProcAddressARB(const GLubyte *name) {
    real_load();
    const any_function own = name ? real_replacement((const char *)name) : NULL;
    if (own || !gl.glXGetProcAddressARB) return own;
    return gl.glXGetProcAddressARB(name);
}

EXPORT __GLXextFuncPtr glXGetProcAddress(const GLubyte *name) { return glXGetProcAddressARB(name); }

EXPORT any_function eglGetProcAddress(const char *name) {
    real_load();
    const any_function own = name ? real_replacement(name) : NULL;
    if (own || !gl.eglGetProcAddress) return own;
    return gl.eglGetProcAddress(name);
}
