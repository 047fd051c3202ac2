/* Opens the file of a model. The web page has another function of that name, which looks into files that were dropped on it
 * (web/c/files.c). */
#include "apart.h"
#include "commands.h"
#include "progress.h"

#include <drypoint/io.h>

#include <string.h>
#include <sys/stat.h>

/* Own formats are read here, all others in a process of their own. What is no regular file can be
 * read only once, and is no other format: Assimp wants to go back in it. */
dp_result open_file(const tool_settings *s, const char *model, dp_source **out, dp_diag *diag) {
    const dp_file_options options = {.progress = progress_report};
    struct stat status;
    if (!strcmp(model, "-") || stat(model, &status) || !S_ISREG(status.st_mode))
        return dp_io_open(model, &options, out, diag);
    const dp_result result = dp_source_open(model, &options, out, diag);
    return result == DP_ERR_UNSUPPORTED ? open_apart(model, s->read_time, out, diag) : result;
}
