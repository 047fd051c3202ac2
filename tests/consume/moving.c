/* Three frames of a small assembly: a lid that one clip opens and another one turns, on a box that is
 * twisted, cut open and seen through. Succeeds when no two frames are alike, each has a section, and
 * one drawn again is the same. */
#include <drypoint/drypoint.h>

#include <string.h>

enum { WIDTH = 160, HEIGHT = 120, BYTES = WIDTH * HEIGHT * 4 };

static const float corners[8][3] = {{-1, -1, -1}, {1, -1, -1}, {-1, 1, -1}, {1, 1, -1},
                                    {-1, -1, 1},  {1, -1, 1},  {-1, 1, 1},  {1, 1, 1}};
static const uint32_t indices[] = {0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4,
                                   2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5};
static const uint32_t firsts[] = {0, 4, 8, 12, 16, 20, 24};

/* A box, its lid, and two ways in which the lid moves. */
static dp_result make_scene(dp_source **out) {
    static const double times[] = {0, 1};
    static const float lifts[] = {0, 1.2f, 0, 0, 2, 0}, turns[] = {0, 0, 0, 1, 0, 1, 0, 0};
    const dp_scene_node nodes[] = {
        {.name = "box"}, {.name = "lid", .translation = {0, 1.2, 0}, .scale = {1.1, 0.15, 1.1}}};
    const dp_scene_mesh mesh = {.name = "cube",
                                .batch = {.positions = corners[0],
                                          .vertex_count = 8,
                                          .indices = indices,
                                          .corner_count = 24,
                                          .firsts = firsts,
                                          .polygon_count = 6}};
    const dp_scene_instance instances[] = {{.node = 1, .mesh = 1}, {.node = 2, .mesh = 1}};
    const dp_scene_channel lift = {
        .node = 2, .path = DP_SCENE_TRANSLATION, .times = times, .values = lifts, .key_count = 2};
    const dp_scene_channel turn = {
        .node = 2, .path = DP_SCENE_ROTATION, .times = times, .values = turns, .key_count = 2};
    const dp_scene_clip clips[] = {{.name = "open", .channels = &lift, .channel_count = 1},
                                   {.name = "turn", .channels = &turn, .channel_count = 1}};
    const dp_scene_desc desc = {.nodes = nodes,
                                .node_count = 2,
                                .meshes = &mesh,
                                .mesh_count = 1,
                                .instances = instances,
                                .instance_count = 2,
                                .clips = clips,
                                .clip_count = 2};
    const dp_result result = dp_source_from_scene(&desc, NULL, out, NULL);
    return result ? result : dp_scene_play(*out, 1, NULL);
}

/* The same, twisted, and then cut in two. Each source owns the one that it is made of. */
static dp_result make_model(dp_source **out) {
    const dp_deform twist = {
        .kind = DP_DEFORM_TWIST, .amplitude = 30, .speed = 0.1, .axis = {0, 1, 0}};
    const dp_clip cut = {.planes = {{{0, 0, 1}, 0.3}}, .plane_count = 1};
    dp_source *scene = NULL, *twisted = NULL;
    dp_result result = make_scene(&scene);
    if (!result) result = dp_source_deform(scene, &twist, NULL, &twisted, NULL);
    if (!result) scene = NULL, result = dp_source_clip(twisted, &cut, NULL, out, NULL);
    if (!result) return DP_OK;
    dp_source_destroy(twisted);
    dp_source_destroy(scene);
    return result;
}

static dp_result draw(dp_context *context, dp_source *model, double time, uint8_t *rgba) {
    const dp_fit fit = {.min = {-1.5f, -1, -1.5f},
                        .max = {1.5f, 2.2f, 1.5f},
                        .direction = {1, 1, 3},
                        .aspect = 4 / 3.0};
    const dp_style style = {.surface = DP_RGB(240, 230, 210)};
    dp_style groups[1];
    const dp_target target = {.width = WIDTH, .height = HEIGHT, .rgba = rgba};
    dp_camera camera;
    groups[0] = style; /* the box */
    groups[0].xray = 0.4f;
    groups[0].section = DP_RGB(220, 120, 90);
    dp_result result = dp_camera_fit(&camera, &fit);
    if (!result) result = dp_source_set_time(model, time, NULL);
    if (!result)
        result = dp_draw_grouped(context, model, &camera, &style, groups, 1, &target, NULL);
    return result;
}

static int has_section(dp_context *context) {
    size_t count;
    const dp_segment *const segments = dp_segments(context, &count);
    for (size_t i = 0; i < count; i++)
        if (segments[i].line == DP_LINE_SECTION) return 1;
    return 0;
}

int main(void) {
    static uint8_t frames[4][BYTES];
    static const double times[] = {0, 0.5, 1, 0.5};
    dp_context *context = NULL;
    dp_source *model = NULL;
    if (make_model(&model) || dp_context_create(NULL, &context, NULL)) return 2;
    for (int k = 0; k < 4; k++)
        if (draw(context, model, times[k], frames[k]) || !has_section(context)) return 3;
    dp_source_destroy(model);
    dp_context_destroy(context);
    if (!memcmp(frames[0], frames[1], BYTES) || !memcmp(frames[1], frames[2], BYTES)) return 4;
    return memcmp(frames[1], frames[3], BYTES) ? 5 : 0;
}
