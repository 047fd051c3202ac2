/* Fills the table of OpenGL's functions. */
#include "gl/api.h"

#include "base/diag.h"

#include <string.h>

/* An object's address as a function's, as POSIX allows. */
static void put(void *function, const dp_gl_desc *desc, const char *name) {
    void *const address = desc->get_proc_address(desc->user, name);
    memcpy(function, &address, sizeof address);
}

dp_result dp_gl_api_load(dp_gl_api *api, const dp_gl_desc *desc, dp_diag *diag) {
    const char *missing = NULL;
    *api = (dp_gl_api){0};
#define LOAD(name, type) put(&api->name, desc, "gl" #name);
#define CHECK(name, type)                                                                          \
    if (!api->name && !missing) missing = "gl" #name;
    DP_GL_NEEDED(LOAD)
    DP_GL_OPTIONAL(LOAD)
    DP_GL_NEEDED(CHECK)
#undef LOAD
#undef CHECK
    if (!missing) return DP_OK;
    return dp_fail(diag, DP_ERR_UNSUPPORTED,
                   "the OpenGL here has no %s: is a context of version 4.3 or later current?",
                   missing);
}
