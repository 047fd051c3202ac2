/* real.c: finds the functions behind ours, and ours by name.
 *
 * `gl` is filled once under pthread_once, and only read afterwards. Functions of newer GL versions are
 * not exported by every libGL: what dlsym does not find, glXGetProcAddress or eglGetProcAddress may.
 *
 * Not handled: programs that dlopen libGL and take glBegin itself out of it by dlsym. Those
 * that ask glXGetProcAddress, as GLEW does, get ours. */
#define _GNU_SOURCE /* RTLD_NEXT */
#include "real.h"

#include <dlfcn.h>
#include <pthread.h>
#include <stddef.h>
#include <string.h>

struct real_functions gl;

struct entry {
    const char *name;
    size_t offset;    /* of its pointer in struct real_functions */
    any_function own; /* NULL: not replaced */
};

#define PLAIN(name)                               {#name, offsetof(struct real_functions, name), NULL},
#define OWN(name)                                 {#name, offsetof(struct real_functions, name), (any_function)name},
#define OWN_OF_THREE(name, parameters, arguments) OWN(name)
static const struct entry entries[] = {PLAIN_FUNCTIONS(PLAIN) OWN_FUNCTIONS(OWN) VERTEX_NAMES(
    OWN) STATE_FUNCTIONS(OWN_OF_THREE) READ_FUNCTIONS(OWN_OF_THREE)};
enum { entry_count = sizeof entries / sizeof entries[0] };

/* The pointer of an entry; POSIX lets functions travel through void * bytes. */
static void set_real(const struct entry *entry, const void *address) {
    memcpy((char *)&gl + entry->offset, &address, sizeof address);
}

static bool has_real(const struct entry *entry) {
    const void *address;
    memcpy(&address, (const char *)&gl + entry->offset, sizeof address);
    return address != NULL;
}

static void find_all(void) {
    for (size_t i = 0; i < entry_count; i++)
        set_real(&entries[i], dlsym(RTLD_NEXT, entries[i].name));
    for (size_t i = 0; i < entry_count; i++) {
        if (has_real(&entries[i]) || strncmp(entries[i].name, "gl", 2) != 0) continue;
        if (strncmp(entries[i].name, "glfw", 4) == 0) continue;
        any_function found = NULL;
        if (gl.glXGetProcAddressARB)
            found = gl.glXGetProcAddressARB((const GLubyte *)entries[i].name);
        else if (gl.eglGetProcAddress)
            found = gl.eglGetProcAddress(entries[i].name);
        const void *address;
        memcpy(&address, &found, sizeof address);
        set_real(&entries[i], address);
    }
}

void real_load(void) {
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, find_all);
}

any_function real_replacement(const char *name) {
    real_load();
    for (size_t i = 0; i < entry_count; i++)
        if (strcmp(entries[i].name, name) == 0)
            return has_real(&entries[i]) ? entries[i].own : NULL;
    return NULL;
}
