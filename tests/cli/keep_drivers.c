/* Keeps every library loaded, in the sanitizers' builds of the program. EGL unloads OpenGL's drivers when a display ends, and
 * what they had allocated for as long as they are there then looks lost: LeakSanitizer tells of 128 bytes from an unknown
 * module, and an unknown module's leaks cannot be told from ours by a suppression. */
#include <dlfcn.h>

int dlclose(void *library) {
    (void)library;
    return 0;
}
