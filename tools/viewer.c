/* drypoint view ARGUMENTS: the viewer is a program of its own, drypoint-view, as it needs GLFW and OpenGL, and this one
 * neither. It lies beside this one, or on PATH. */
#include "commands.h"
#include "report.h"

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static const char viewer[] = "drypoint-view";

/* The path of the viewer beside this program; false: the system does not tell where that is. */
static bool path_beside(char path[PATH_MAX]) {
    const ssize_t length = readlink("/proc/self/exe", path, PATH_MAX - sizeof viewer - 1);
    if (length <= 0) return false;
    path[length] = 0;
    char *const slash = strrchr(path, '/');
    if (!slash) return false;
    memcpy(slash + 1, viewer, sizeof viewer);
    return true;
}

int view_run(char **words) {
    char path[PATH_MAX];
    words[-1] = (char[]){"drypoint-view"};
    if (path_beside(path)) execv(path, words - 1);
    if (errno == ENOENT) execvp(viewer, words - 1);
    if (errno == ENOENT)
        wrong_usage(
            "the viewer, drypoint-view, is neither beside this program nor on PATH: it is built "
            "where "
            "there is GLFW (\"make setup\", or apt-get install libglfw3-dev, and build again)");
    else
        wrong_usage("cannot start %s: %s", viewer, strerror(errno));
    return EXIT_FAILED;
}
