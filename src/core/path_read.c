#include <drypoint/path.h>
#include "base/diag.h"
dp_result dp_camera_path_read(const char *text, size_t size, const double up[3],
                              const dp_allocator *allocator, dp_camera_path **out, dp_diag *diag) {
    (void)text, (void)size, (void)up, (void)allocator;
    *out = NULL;
    return dp_fail(diag, DP_ERR_FORMAT, "not yet");
}
