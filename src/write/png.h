/* Pictures as PNG in memory. */
#ifndef DP_WRITE_PNG_H
#define DP_WRITE_PNG_H

#include <drypoint/base.h>

/* [height][width][4] RGBA, not premultiplied, as a PNG, which the caller frees with free().
 * DP_ERR_MEMORY, DP_ERR_LIMIT, DP_ERR_ARGUMENT. */
dp_result dp_png_encode(const uint8_t *rgba, uint32_t width, uint32_t height, void **png,
                        size_t *size, dp_diag *diag);

#endif
