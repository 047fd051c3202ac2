/* Finds an OpenGL that needs no window, by EGL. libEGL is loaded when it is asked for, so that the program runs without
 * it; what is used of its interface is declared here, so that it is built without its headers.
 *
 * Displays are tried in this order, until one has a context of the version:
 *
 *     devices that are graphics hardware      EGL_EXT_platform_device; none with LIBGL_ALWAYS_SOFTWARE=1
 *     Mesa without a window                   EGL_MESA_platform_surfaceless
 *     devices that are programs               llvmpipe
 *     the default display                     a window system's
 *
 * Not here: surfaces. Pictures are drawn into framebuffers of textures, so the context needs EGL_KHR_surfaceless_context. */
#include "egl.h"
#include "report.h"

#include <dlfcn.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ------- EGL 1.5 and its extensions, as far as they are used ------- */

typedef void *egl_handle; /* EGLDisplay, EGLContext, EGLConfig, EGLDeviceEXT */
typedef void (*egl_proc)(void);

enum {
    EGL_CONTEXT_MAJOR = 0x3098,
    EGL_CONTEXT_MINOR = 0x30FB,
    EGL_PROFILE_MASK = 0x30FD,
    EGL_CORE_PROFILE = 1,
    EGL_NO_MORE = 0x3038,
    EGL_OPENGL = 0x30A2,
    EGL_RENDERABLE_TYPE = 0x3040,
    EGL_OPENGL_BIT = 8,
    EGL_SURFACE_TYPE = 0x3033,
    EGL_EXTENSION_NAMES = 0x3055,
    EGL_SURFACELESS = 0x31DD,
    EGL_DEVICE = 0x313F
};

struct egl_context {
    void *library;
    egl_handle display, context;
    egl_proc (*get_proc)(const char *name);
    unsigned (*initialize)(egl_handle display, int *major, int *minor);
    unsigned (*terminate)(egl_handle display);
    unsigned (*bind_api)(unsigned api);
    unsigned (*choose_config)(egl_handle display, const int *attributes, egl_handle *configs,
                              int size, int *count);
    egl_handle (*create_context)(egl_handle display, egl_handle config, egl_handle share,
                                 const int *attributes);
    unsigned (*destroy_context)(egl_handle display, egl_handle context);
    unsigned (*make_current)(egl_handle display, egl_handle draw, egl_handle read,
                             egl_handle context);
    egl_handle (*get_display)(void *native);
    /* of extensions: NULL where they are missing */
    egl_handle (*platform_display)(unsigned platform, void *native, const int *attributes);
    unsigned (*query_devices)(int most, egl_handle *devices, int *count);
    const char *(*device_string)(egl_handle device, int name);
};

/* Stores a function's address, whatever its type. */
static bool put(void *to, const void *address) {
    memcpy(to, &address, sizeof address);
    return address != NULL;
}

/* What is wrong with the first name is what is told: the others are spellings of it. */
static bool load_library(egl_context *e) {
    static const char *const names[] = {"libEGL.so.1", "libEGL.so", "libEGL.dylib"};
    char first[256] = "";
    for (size_t k = 0; k < sizeof names / sizeof *names && !e->library; k++) {
        e->library = dlopen(names[k], RTLD_NOW | RTLD_LOCAL);
        if (!e->library && !k) snprintf(first, sizeof first, "%s", dlerror());
    }
    if (e->library) return true;
    return wrong_usage("--gl: there is no libEGL here (%s): install libegl1 and libgl1-mesa-dri, "
                       "or leave --gl out",
                       first);
}

static bool load_functions(egl_context *e) {
    const struct {
        void *to;
        const char *name;
    } needed[] = {{&e->get_proc, "eglGetProcAddress"},
                  {&e->initialize, "eglInitialize"},
                  {&e->terminate, "eglTerminate"},
                  {&e->bind_api, "eglBindAPI"},
                  {&e->choose_config, "eglChooseConfig"},
                  {&e->create_context, "eglCreateContext"},
                  {&e->destroy_context, "eglDestroyContext"},
                  {&e->make_current, "eglMakeCurrent"},
                  {&e->get_display, "eglGetDisplay"}};
    for (size_t k = 0; k < sizeof needed / sizeof *needed; k++)
        if (!put(needed[k].to, dlsym(e->library, needed[k].name))) return false;
    put(&e->platform_display, egl_function(e, "eglGetPlatformDisplayEXT"));
    put(&e->query_devices, egl_function(e, "eglQueryDevicesEXT"));
    put(&e->device_string, egl_function(e, "eglQueryDeviceStringEXT"));
    return true;
}

void *egl_function(void *context, const char *name) {
    egl_context *const e = context;
    const egl_proc found = e->get_proc(name);
    void *address;
    memcpy(&address, &found, sizeof address);
    return address;
}

/* ------- one display ------- */

static egl_handle some_config(egl_context *e) {
    static const int attributes[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, 0,
                                     EGL_NO_MORE};
    egl_handle config = NULL;
    int count = 0;
    return e->choose_config(e->display, attributes, &config, 1, &count) && count ? config : NULL;
}

/* Makes a context of a display and makes it current. False: it has none. */
static bool try_display(egl_context *e, egl_handle display, int major, int minor) {
    const int attributes[] = {
        EGL_CONTEXT_MAJOR, major,      EGL_CONTEXT_MINOR, minor, EGL_PROFILE_MASK,
        EGL_CORE_PROFILE,  EGL_NO_MORE};
    if (!display || !e->initialize(display, NULL, NULL)) return false;
    e->display = display;
    if (e->bind_api(EGL_OPENGL)) {
        e->context = e->create_context(display, NULL, NULL, attributes);
        if (!e->context) e->context = e->create_context(display, some_config(e), NULL, attributes);
        if (e->context && e->make_current(display, NULL, NULL, e->context)) return true;
        if (e->context) e->destroy_context(display, e->context);
    }
    e->terminate(display);
    e->display = e->context = NULL;
    return false;
}

/* ------- all of them ------- */

enum { DEVICES_MOST = 16 };

static bool is_program(const egl_context *e, egl_handle device) {
    const char *const names =
        e->device_string ? e->device_string(device, EGL_EXTENSION_NAMES) : NULL;
    return names && strstr(names, "EGL_MESA_device_software");
}

static bool try_devices(egl_context *e, bool programs, int major, int minor) {
    egl_handle devices[DEVICES_MOST];
    int count = 0;
    if (!e->platform_display || !e->query_devices) return false;
    if (!e->query_devices(DEVICES_MOST, devices, &count)) return false;
    for (int k = 0; k < count; k++)
        if (is_program(e, devices[k]) == programs &&
            try_display(e, e->platform_display(EGL_DEVICE, devices[k], NULL), major, minor))
            return true;
    return false;
}

static bool wants_program(void) {
    const char *const asked = getenv("LIBGL_ALWAYS_SOFTWARE");
    return asked && *asked && strcmp(asked, "0") && strcmp(asked, "false");
}

static bool try_all(egl_context *e, int major, int minor) {
    if (!wants_program() && try_devices(e, false, major, minor)) return true;
    if (e->platform_display &&
        try_display(e, e->platform_display(EGL_SURFACELESS, NULL, NULL), major, minor))
        return true;
    return try_devices(e, true, major, minor) || try_display(e, e->get_display(NULL), major, minor);
}

/* No display has the version: is there an older one? Says what would help. */
static void explain(egl_context *e, int major, int minor) {
    enum { VERSION = 0x1F02 };
    const unsigned char *(*get_string)(unsigned name) = NULL;
    const bool older = try_all(e, 3, 2) && put(&get_string, egl_function(e, "glGetString"));
    const unsigned char *const version = older ? get_string(VERSION) : NULL;
    if (version)
        wrong_usage("--gl: OpenGL %d.%d or later is needed, here is %s: install a newer driver, "
                    "try LIBGL_ALWAYS_SOFTWARE=1, or leave --gl out",
                    major, minor, (const char *)version);
    else
        wrong_usage("--gl: no OpenGL %d.%d or later was found through EGL: install libgl1-mesa-dri "
                    "or the driver of the graphics hardware, or leave --gl out",
                    major, minor);
}

egl_context *egl_open(int major, int minor) {
    egl_context *const e = calloc(1, sizeof *e);
    if (!e)
        wrong_usage("out of memory for a context of OpenGL");
    else if (!load_library(e))
        ; /* it has been said */
    else if (!load_functions(e))
        wrong_usage("--gl: this libEGL is too old; version 1.5 is needed");
    else if (!try_all(e, major, minor))
        explain(e, major, minor);
    else
        return e;
    egl_close(e);
    return NULL;
}

/* The library stays: drivers do not like to be unloaded. */
void egl_close(egl_context *e) {
    if (!e) return;
    if (e->context) {
        e->make_current(e->display, NULL, NULL, NULL);
        e->destroy_context(e->display, e->context);
    }
    if (e->display) e->terminate(e->display);
    free(e);
}
