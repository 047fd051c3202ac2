/* A page of drawings as a file that is either whole or not there. */
#include <drypoint/io.h>

#include "base/diag.h"
#include "write/file.h"

static dp_result write_bytes(void *user, const char *bytes, size_t size, dp_diag *diag) {
    return dp_output_write(user, bytes, size, diag);
}

dp_result dp_io_write_page(const char *path, const dp_page *page, dp_format format, dp_diag *diag) {
    dp_output output;
    if (!path || !page)
        return dp_fail(diag, DP_ERR_ARGUMENT, "dp_io_write_page: path or page is NULL");
    dp_result result = dp_output_open(&output, path, diag);
    if (result) return result;
    result = dp_page_write(page, format, write_bytes, &output, diag);
    if (!result) return dp_output_commit(&output, diag);
    dp_output_abandon(&output);
    return result;
}
