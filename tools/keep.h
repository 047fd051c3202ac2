/* Keeping a source that can be read only once. */
#ifndef TOOL_KEEP_H
#define TOOL_KEEP_H

#include <drypoint/source.h>

/* Replaces *source by one of the same polygons that can be read again; `most` bytes may be kept.
 * DP_ERR_MEMORY, DP_ERR_LIMIT, or what the source fails with; *source is still to be destroyed
 * then. */
dp_result keep_source(dp_source **source, double most, dp_diag *diag);

#endif
