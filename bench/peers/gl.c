/* The context is Mesa's llvmpipe by request, on machines with a GPU too: the CPU is what is
 * compared. */
#include "gl.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <stdio.h>
#include <stdlib.h>

static bool refuse(const char *what) {
    fprintf(stderr, "llvmpipe: %s\n", what);
    return false;
}

static bool load(gl_functions *gl) {
    bool whole = true;
#define GL_LOAD(type, name)                                                                        \
    gl->name = (type)eglGetProcAddress("gl" #name);                                                \
    whole = whole && gl->name;
    GL_FUNCTIONS(GL_LOAD)
#undef GL_LOAD
    return whole || refuse("OpenGL lacks a function");
}

static EGLDisplay open_display(void) {
    const PFNEGLGETPLATFORMDISPLAYEXTPROC get =
        (PFNEGLGETPLATFORMDISPLAYEXTPROC)eglGetProcAddress("eglGetPlatformDisplayEXT");
    return get ? get(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL) : EGL_NO_DISPLAY;
}

bool gl_open(gl_functions *gl) {
    static const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                        4,
                                        EGL_CONTEXT_MINOR_VERSION,
                                        5,
                                        EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                        EGL_NONE};
    setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
    setenv("GALLIUM_DRIVER", "llvmpipe", 1);
    const EGLDisplay display = open_display();
    if (display == EGL_NO_DISPLAY || !eglInitialize(display, NULL, NULL))
        return refuse("no EGL display without a surface");
    if (!eglBindAPI(EGL_OPENGL_API)) return refuse("EGL without OpenGL");
    const EGLContext context =
        eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
    if (context == EGL_NO_CONTEXT) return refuse("no OpenGL 4.5 core context");
    if (!eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context))
        return refuse("the context cannot be made current");
    return load(gl);
}

void gl_close(void) {
    const EGLDisplay display = eglGetCurrentDisplay();
    if (display == EGL_NO_DISPLAY) return;
    eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglTerminate(display);
}
