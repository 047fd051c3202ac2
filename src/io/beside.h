/* Files that a model's file names: its material libraries. */
#ifndef DP_IO_BESIDE_H
#define DP_IO_BESIDE_H

#include "io/stream.h"

/* Opens the file that `model`, which is still being opened, names name[0..length).
 * DP_ERR_UNSUPPORTED: the model is a pipe, or memory without open_beside.
 * DP_ERR_IO: there is no such regular file; diag (not NULL) says why.
 * DP_ERR_MEMORY. */
dp_result dp_open_beside(const dp_stream *model, const char *name, size_t length, dp_stream **out,
                         dp_diag *diag);

#endif
