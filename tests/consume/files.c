/* Writes a picture through the component io; succeeds when that worked. */
#include <drypoint/io.h>

#include <stdio.h>

int main(void) {
    static const uint8_t rgba[4] = {0, 0, 0, 255};
    dp_diag diag;
    const dp_result result = dp_io_write_png("consumed.png", rgba, 1, 1, 4, &diag);
    if (result) fprintf(stderr, "%s\n", diag.message);
    return result != DP_OK;
}
