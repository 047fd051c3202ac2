/* Output files that are either complete or not written at all. */
#ifndef DP_WRITE_FILE_H
#define DP_WRITE_FILE_H

#include <drypoint/base.h>

#include <stdio.h>

typedef struct dp_output {
    FILE *file;
    char *target;    /* as given, for messages */
    char *final;     /* path to rename to; NULL: written in place */
    char *temporary; /* path while it is written; NULL: written in place */
} dp_output;

/* Opens an output; "-" is standard output. DP_ERR_IO, DP_ERR_MEMORY, and no file is left then. */
dp_result dp_output_open(dp_output *output, const char *path, dp_diag *diag);
/* DP_ERR_IO if anything since the opening could not be written. */
dp_result dp_output_write(dp_output *output, const void *bytes, size_t size, dp_diag *diag);
/* Renames the file to its target. The output is closed in any case. */
dp_result dp_output_commit(dp_output *output, dp_diag *diag);
/* Removes what was written (not what went to a device or pipe). */
void dp_output_abandon(dp_output *output);

#endif
