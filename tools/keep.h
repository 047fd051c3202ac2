/* Stores a source that can be read only once. */
#ifndef TOOL_KEEP_H
#define TOOL_KEEP_H

#include <drypoint/source.h>

/* Replaces *source by one of the same polygons that can be read again, of at most `most` bytes.
 * DP_ERR_MEMORY, DP_ERR_LIMIT, or the source's error; the caller then still destroys *source. */
dp_result keep_source(dp_source **source, double most, dp_diag *diag);

/* Makes a source of the polygons that are left to read. */
dp_result copy_source(dp_source *source, double most, dp_source **out, dp_diag *diag);

#endif
