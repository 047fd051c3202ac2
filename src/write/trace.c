/* A drawing's trace as a file that is either whole or not there. */
#include <drypoint/io.h>
#include <drypoint/sink.h>

#include "base/diag.h"
#include "write/file.h"

static dp_result write_text(void *user, const char *text, size_t size, dp_diag *diag) {
    return dp_output_write(user, text, size, diag);
}

dp_result dp_io_write_trace(const char *path, dp_context *context, dp_diag *diag) {
    dp_output output;
    if (!path || !context)
        return dp_fail(diag, DP_ERR_ARGUMENT, "dp_io_write_trace: path or context is NULL");
    dp_result result = dp_output_open(&output, path, diag);
    if (result) return result;
    result = dp_trace(context, write_text, &output, diag);
    if (!result) return dp_output_commit(&output, diag);
    dp_output_abandon(&output);
    return result;
}
