/* Output files that are either whole or not there. */
#ifndef DP_WRITE_FILE_H
#define DP_WRITE_FILE_H

#include <drypoint/base.h>

#include <stdio.h>

typedef struct dp_output {
    FILE *file;
    char *target;    /* as given, for messages */
    char *final;     /* where the temporary file goes in the end; NULL: written in place */
    char *temporary; /* beside it; NULL: written in place */
} dp_output;

/* "-" is standard output. DP_ERR_IO, DP_ERR_MEMORY; nothing is left behind then. */
dp_result dp_output_open(dp_output *output, const char *path, dp_diag *diag);
/* DP_ERR_IO once anything since the opening could not be written. */
dp_result dp_output_write(dp_output *output, const void *bytes, size_t size, dp_diag *diag);
/* Puts the file in its place. Whatever the result, the output is closed. */
dp_result dp_output_commit(dp_output *output, dp_diag *diag);
/* Throws away what was written (what went to a device or pipe is gone). */
void dp_output_abandon(dp_output *output);

#endif
