/* Draws one triangle; succeeds when its outline is one stroke of three segments and some pixel got
 * dark. */
#include <drypoint/drypoint.h>

static dp_result count(void *user, const dp_chain_stroke *stroke, dp_diag *diag) {
    (void)diag;
    *(size_t *)user += stroke->closed ? stroke->count : 0;
    return DP_OK;
}

int main(void) {
    static const float corners[] = {-1, -1, 0, 1, -1, 0, 0, 1, 0};
    static uint8_t rgba[64 * 64 * 4];
    const dp_batch triangle = {
        .positions = corners, .vertex_count = 3, .corner_count = 3, .polygon_count = 1};
    const dp_fit fit = {.min = {-1, -1, 0}, .max = {1, 1, 0}, .direction = {0, 0, 1}, .aspect = 1};
    const dp_target target = {.width = 64, .height = 64, .rgba = rgba};
    dp_context *context = NULL;
    dp_source *source = NULL;
    dp_camera camera;
    if (dp_version_check(NULL) || dp_context_create(NULL, &context, NULL) ||
        dp_camera_fit(&camera, &fit) || dp_source_from_arrays(&triangle, NULL, &source, NULL) ||
        dp_draw(context, source, &camera, NULL, &target, NULL))
        return 2;
    size_t segments = 0;
    const dp_sink sink = {.user = &segments, .stroke = count};
    if (dp_send(context, &sink, NULL) || segments != 3) return 3;
    dp_source_destroy(source);
    dp_context_destroy(context);
    for (int i = 0; i < 64 * 64; i++)
        if (rgba[4 * i] < 64) return 0;
    return 1;
}
