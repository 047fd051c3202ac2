/* Writing a file so that a reader finds the old one or the new one, never half of one.
 *
 * A regular file is written under another name in the same directory and renamed over its target
 * when complete. It takes the old file's permissions; of a symbolic link, the target is replaced.
 * Devices and pipes are written in place. Errors of the system (a full disk, say) may come as late
 * as closing: only the result of dp_output_commit is final.
 *
 * Not handled: fsync (a power failure may still lose the new file), locks, Windows. */
#define _XOPEN_SOURCE 700 /* realpath */
#include "write/file.h"

#include "base/diag.h"
#include "base/print.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { BUFFER = 1 << 16, TRIES = 1000 };

static dp_result refuse(dp_diag *diag, const char *target, int code) {
    const char *const name = strcmp(target, "-") ? target : "standard output";
    const char *advice = "";
    if (code == ENOSPC)
        advice = "; make room or choose another place";
    else if (code == ENOENT)
        advice = "; does its directory exist?";
    else if (code == EACCES || code == EROFS)
        advice = "; choose a place you may write to";
    else if (code == EISDIR)
        advice = "; name a file in it";
    return dp_fail(diag, DP_ERR_IO, "cannot write %.120s: %s%s", name,
                   dp_print_error((char[DP_ERROR_TEXT]){0}, code), advice);
}

static dp_result out_of_memory(dp_diag *diag) {
    return dp_fail(diag, DP_ERR_MEMORY, "out of memory for an output file");
}

static char *copy(const char *text) {
    const size_t size = strlen(text) + 1;
    char *const block = malloc(size);
    return block ? memcpy(block, text, size) : NULL;
}

static dp_result open_in_place(dp_output *output, const char *path, dp_diag *diag) {
    const bool standard = !strcmp(path, "-");
    const int descriptor = standard ? dup(STDOUT_FILENO) : open(path, O_WRONLY | O_NOCTTY);
    if (descriptor < 0) return refuse(diag, path, errno);
    output->file = fdopen(descriptor, "wb");
    if (output->file) return DP_OK;
    close(descriptor);
    return out_of_memory(diag);
}

/* ".drypoint-PID-N.tmp" beside the target: short, so that any name fits the directory's limit. */
static int create_beside(char *name, size_t size, const char *target) {
    const char *const slash = strrchr(target, '/');
    const int directory = slash ? (int)(slash - target + 1) : 0;
    for (int k = 0; k < TRIES; k++) {
        snprintf(name, size, "%.*s.drypoint-%ld-%d.tmp", directory, target, (long)getpid(), k);
        const int descriptor = open(name, O_WRONLY | O_CREAT | O_EXCL | O_NOCTTY, 0666);
        if (descriptor >= 0 || errno != EEXIST) return descriptor;
    }
    return -1;
}

static dp_result open_temporary(dp_output *output, const struct stat *old, dp_diag *diag) {
    const size_t size = strlen(output->final) + 64;
    output->temporary = malloc(size);
    if (!output->temporary) return out_of_memory(diag);
    const int descriptor = create_beside(output->temporary, size, output->final);
    if (descriptor < 0) {
        const int code = errno;
        free(output->temporary);
        output->temporary = NULL;
        return refuse(diag, output->target, code);
    }
    if (old) (void)fchmod(descriptor, old->st_mode & 07777); /* may fail, no harm */
    output->file = fdopen(descriptor, "wb");
    if (output->file) return DP_OK;
    close(descriptor);
    return out_of_memory(diag);
}

static dp_result open_regular(dp_output *output, const struct stat *old, dp_diag *diag) {
    const char *const path = output->target;
    if (old && access(path, W_OK)) return refuse(diag, path, errno);
    output->final = old ? realpath(path, NULL) : copy(path);
    if (!output->final) return errno == ENOMEM ? out_of_memory(diag) : refuse(diag, path, errno);
    return open_temporary(output, old, diag);
}

dp_result dp_output_open(dp_output *output, const char *path, dp_diag *diag) {
    *output = (dp_output){0};
    output->target = copy(path);
    if (!output->target) return out_of_memory(diag);
    struct stat old;
    const bool exists = strcmp(path, "-") && !stat(path, &old);
    dp_result result;
    if (!strcmp(path, "-"))
        result = open_in_place(output, path, diag);
    else if (!exists)
        result = open_regular(output, NULL, diag);
    else if (S_ISREG(old.st_mode))
        result = open_regular(output, &old, diag);
    else if (S_ISDIR(old.st_mode))
        result = refuse(diag, path, EISDIR);
    else
        result = open_in_place(output, path, diag);
    if (result)
        dp_output_abandon(output);
    else
        setvbuf(output->file, NULL, _IOFBF, BUFFER);
    return result;
}

dp_result dp_output_write(dp_output *output, const void *bytes, size_t size, dp_diag *diag) {
    errno = 0;
    if (fwrite(bytes, 1, size, output->file) == size) return DP_OK;
    return refuse(diag, output->target, errno ? errno : EIO);
}

dp_result dp_output_commit(dp_output *output, dp_diag *diag) {
    errno = 0;
    const bool failed = ferror(output->file);
    const int closed = fclose(output->file); /* flushes: errors may come only now */
    int code = closed ? errno : failed ? EIO : 0;
    output->file = NULL;
    if (!code && output->temporary && rename(output->temporary, output->final)) code = errno;
    const dp_result result = code ? refuse(diag, output->target, code) : DP_OK;
    if (!result) {
        free(output->temporary); /* renamed: nothing to remove */
        output->temporary = NULL;
    }
    dp_output_abandon(output);
    return result;
}

void dp_output_abandon(dp_output *output) {
    if (output->file) fclose(output->file);
    if (output->temporary) unlink(output->temporary);
    free(output->temporary);
    free(output->final);
    free(output->target);
    *output = (dp_output){0};
}
