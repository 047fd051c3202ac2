/* Files that a model's file names: its material libraries. */
#ifndef DP_IO_BESIDE_H
#define DP_IO_BESIDE_H

#include "io/stream.h"

/* Opens the file called name[0..length) from within `model`, which is still being opened.
 * DP_ERR_UNSUPPORTED: nothing lies beside the model, as it comes from a pipe or from memory alone.
 * DP_ERR_IO, with the reason as diag's message (which is needed): it is not there, or not a regular
 * file. DP_ERR_MEMORY. */
dp_result dp_open_beside(const dp_stream *model, const char *name, size_t length, dp_stream **out,
                         dp_diag *diag);

#endif
