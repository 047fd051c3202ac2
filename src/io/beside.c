/* Finds the files that a model names: in the model's folder, or, for a model in memory, through the
 * application (dp_memory_file).
 *
 * Only regular files are opened, so that no pipe or device blocks. A model in memory never opens a
 * file of the system. */
#include "io/beside.h"

#include "base/diag.h"

#include <errno.h>
#include <string.h>
#include <sys/stat.h>

enum { PATH = 4096 };

/* Copies a name, with slashes for backslashes. */
static void copy_name(const char *name, size_t length, char *to) {
    for (size_t i = 0; i < length; i++) to[i] = name[i] == '\\' ? '/' : name[i];
    to[length] = 0;
}

/* The file's path: in the model's folder, unless it begins with a slash. False if too long. */
static bool find_place(const char *path, const char *name, size_t length, char place[PATH]) {
    const char *const slash = strrchr(path, '/');
    const bool absolute = *name == '/' || *name == '\\';
    const size_t folder = absolute || !slash ? 0 : (size_t)(slash + 1 - path);
    if (folder + length + 3 > PATH) return false;
    memcpy(place, path, folder);
    size_t at = folder;
    if (!folder && !absolute) place[at++] = '.', place[at++] = '/'; /* "-" is a file, too */
    copy_name(name, length, place + at);
    return true;
}

static dp_result open_in_folder(const dp_stream *model, const char *name, size_t length,
                                dp_stream **out, dp_diag *diag) {
    char place[PATH];
    struct stat status;
    errno = ENAMETOOLONG;
    if (!find_place(model->path, name, length, place) || stat(place, &status))
        return dp_fail(diag, DP_ERR_IO, "%s", strerror(errno));
    if (!S_ISREG(status.st_mode)) return dp_fail(diag, DP_ERR_IO, "not a file");
    const dp_file_options options = {.allocator = &model->allocator};
    return dp_stream_open(place, &options, out, diag);
}

static dp_result open_in_memory(const dp_stream *model, const char *name, size_t length,
                                dp_stream **out, dp_diag *diag) {
    char text[PATH];
    const void *data = NULL;
    size_t size = 0;
    const dp_memory_file *const file = model->file;
    if (!file->open_beside) return DP_ERR_UNSUPPORTED;
    if (length >= PATH) return dp_fail(diag, DP_ERR_IO, "%s", strerror(ENAMETOOLONG));
    copy_name(name, length, text);
    if (!file->open_beside(file->user, text, &data, &size) || (size && !data))
        return dp_fail(diag, DP_ERR_IO, "it was not given with the model");
    const dp_file_options options = {.allocator = &model->allocator};
    const dp_result result =
        dp_stream_open_memory(data, size, DP_STREAM_WINDOW, &options, out, diag);
    if (!result)
        (*out)->closed = file->close_beside, (*out)->closed_user = file->user;
    else if (file->close_beside)
        file->close_beside(file->user, data, size);
    return result;
}

dp_result dp_open_beside(const dp_stream *model, const char *name, size_t length, dp_stream **out,
                         dp_diag *diag) {
    if (model->path) return open_in_folder(model, name, length, out, diag);
    if (model->file) return open_in_memory(model, name, length, out, diag);
    return DP_ERR_UNSUPPORTED;
}
