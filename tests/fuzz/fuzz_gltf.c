/* Fuzzes the reader of glTF and the scenes that it makes: poses at odd times, small pictures. A
 * file that names others gets the file itself. */
#include "reader.h"

#include <drypoint/drypoint.h>

#include <math.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static bool open_beside(void *user, const char *name, const void **data, size_t *size) {
    const dp_memory_file *const file = user;
    if (!*name || *name == '!') return false;
    *data = file->data;
    *size = file->size;
    return true;
}

static void draw(dp_source *source) {
    static dp_context *context;
    static uint8_t rgba[4 * 48 * 32];
    dp_diag diag = {0};
    dp_extent extent;
    dp_camera camera = {{0}, {0}};
    const dp_context_desc desc = {.threads = 1};
    const dp_target target = {.width = 48, .height = 32, .rgba = rgba};
    if (!context && dp_context_create(&desc, &context, &diag)) abort();
    if (dp_source_extent(source, &extent, &diag)) abort();
    if (extent.polygons > 20000) return; /* it would take long */
    dp_camera_look_at(&camera, (const double[3]){2, 1.5, 2.5}, (const double[3]){0, 0, 0},
                      (const double[3]){0, 1, 0});
    dp_camera_perspective(&camera, 40, 1.5, 0.1, 20);
    const dp_result result = dp_draw(context, source, &camera, NULL, &target, &diag);
    if (result == DP_ERR_ARGUMENT || (result && !diag.message[0])) abort();
}

/* The sum of what a source hands out at a time. */
static uint64_t sum_at(dp_source *source, double time) {
    dp_diag diag;
    if (dp_source_set_time(source, time, &diag)) abort();
    return dp_fuzz_drain(source);
}

static void pose(dp_source *source) {
    static const double times[] = {0, 0.3, -1e300, 1e300, 0.7, 4e-320};
    const dp_scene_desc *const scene = dp_scene_of(source);
    if (!scene) abort();
    for (uint32_t clip = 0; clip <= scene->clip_count && clip < 4; clip++) {
        if (dp_scene_play(source, clip, NULL)) abort();
        const double duration = dp_source_duration(source);
        if (!(duration >= 0) || !isfinite(duration)) abort();
        const uint64_t first = sum_at(source, 0.3);
        for (size_t i = 0; i < sizeof times / sizeof *times; i++) sum_at(source, times[i]);
        sum_at(source, duration);
        if (sum_at(source, 0.3) != first) abort(); /* whatever came before */
        draw(source);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    dp_memory_file file = {
        .data = data, .size = size, .name = "model.gltf", .open_beside = open_beside};
    const dp_file_options options = {.format = DP_FORMAT_GLTF};
    dp_source *source = NULL;
    dp_diag diag = {0};
    file.user = &file;
    const dp_result result = dp_source_open_memory(&file, &options, &source, &diag);
    if (!source != !!result || (result && (diag.result != result || !diag.message[0]))) abort();
    if (result == DP_ERR_ARGUMENT) abort(); /* the reader is to see what a scene refuses */
    if (source) pose(source);
    dp_source_destroy(source);
    return 0;
}
