/* Fuzzes the reader of camera paths: what it accepts has a camera at any time. */
#include <drypoint/path.h>

#include <math.h>
#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static const float min[3] = {-1, -1, -1}, max[3] = {1, 1, 1};
    dp_camera_path *path;
    dp_diag diag = {0};
    const dp_result result =
        dp_camera_path_read((const char *)data, size, NULL, NULL, &path, &diag);
    if (!path != !!result || (result && (diag.result != result || !diag.message[0]))) abort();
    for (int k = -1; path && k <= 9; k++) {
        const double begin = dp_camera_path_begin(path), end = dp_camera_path_end(path),
                     time = begin + (end - begin) * k / 8;
        dp_key_view view;
        dp_camera camera;
        if (!isfinite(time)) continue;
        if (dp_camera_path_view(path, time, &view)) abort();
        if (!dp_camera_path_at(path, time, 1, min, max, &camera, &diag) &&
            !isfinite(camera.projection[0]))
            abort();
    }
    dp_camera_path_destroy(path);
    return 0;
}
