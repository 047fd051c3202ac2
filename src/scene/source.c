/* A scene as a polygon source: one stable batch, posed when it is read for the first time at a
 * time.
 *
 * Invariant: once it is made, no memory is taken or given back. */
#include "scene/scene.h"

#include "base/diag.h"
#include "mesh/source.h"

#include <string.h>

static void pose(dp_scene *s) {
    if (s->is_posed) return;
    dp_scene_move(s);
    dp_scene_place(s);
    s->is_posed = true;
}

static dp_result scene_next(void *user, dp_batch *batch, dp_diag *diag) {
    dp_scene *const s = user;
    (void)diag;
    if (s->is_read) return DP_OK;
    pose(s);
    s->is_read = true;
    *batch = s->batch;
    return DP_OK;
}

static dp_result scene_rewind(void *user, dp_diag *diag) {
    (void)diag;
    ((dp_scene *)user)->is_read = false;
    return DP_OK;
}

static dp_result scene_set_time(void *user, double time, dp_diag *diag) {
    dp_scene *const s = user;
    (void)diag;
    s->is_read = false;
    s->is_posed &= time == s->time || !s->clip;
    s->time = time;
    return DP_OK;
}

static double scene_duration(void *user) {
    const dp_scene *const s = user;
    return s->clip ? s->clips[s->clip - 1].duration : 0;
}

static const char *scene_group_name(void *user, uint32_t group) {
    const dp_scene *const s = user;
    return group < s->desc.instance_count && *s->placed[group].name ? s->placed[group].name : NULL;
}

static uint32_t scene_group_color(void *user, uint32_t group) {
    const dp_scene *const s = user;
    return group < s->desc.instance_count ? s->placed[group].mesh->color : 0;
}

static const char *scene_remark(void *user) { return ((const dp_scene *)user)->desc.remark; }

static const char *scene_color_remark(void *user) {
    return ((const dp_scene *)user)->desc.color_remark;
}

static void scene_lend(void *user, dp_threads *threads) { ((dp_scene *)user)->threads = threads; }

static void scene_destroy(void *user) {
    dp_scene *const s = user;
    const dp_allocator memory = s->arena.memory;
    dp_arena_free(&s->arena);
    dp_free(&memory, s);
}

/* ------- making ------- */

/* Fills a scene, at rest. */
static dp_result fill(dp_scene *s, const dp_scene_desc *desc, dp_diag *diag) {
    uint32_t circle = 0;
    double *const farthest = dp_arena_take(&s->arena, desc->mesh_count, sizeof *farthest);
    const bool enough =
        farthest && dp_scene_copy(s, desc) && dp_scene_build(s) && dp_scene_ready(s, &circle);
    if (circle)
        return dp_fail(diag, DP_ERR_ARGUMENT,
                       "a scene's node %u is its own ancestor: nodes must form trees", circle);
    if (!enough) return dp_fail(diag, DP_ERR_MEMORY, "out of memory for a scene");
    dp_scene_move(s);
    dp_scene_settle(s);
    dp_scene_note_spacing(s, farthest);
    dp_scene_place(s);
    s->is_posed = true;
    return DP_OK;
}

static dp_result make_source(dp_scene *s, dp_source **out, dp_diag *diag) {
    const dp_source_callbacks callbacks = {.user = s,
                                           .next = scene_next,
                                           .rewind = scene_rewind,
                                           .destroy = scene_destroy,
                                           .group_name = scene_group_name,
                                           .group_color = scene_group_color,
                                           .remark = scene_remark,
                                           .color_remark = scene_color_remark,
                                           .up = {s->desc.up[0], s->desc.up[1], s->desc.up[2]},
                                           .set_time = scene_set_time,
                                           .duration = scene_duration};
    const dp_result result = dp_source_from_callbacks(&callbacks, &s->arena.memory, out, diag);
    if (result) return result;
    (*out)->constant = !s->desc.clip_count;
    (*out)->lend = scene_lend;
    return DP_OK;
}

dp_result dp_source_from_scene(const dp_scene_desc *desc, const dp_allocator *allocator,
                               dp_source **out, dp_diag *diag) {
    if (!out || !desc)
        return dp_fail(diag, DP_ERR_ARGUMENT, "dp_source_from_scene: desc or out is NULL");
    *out = NULL;
    dp_result result = dp_scene_check(desc, diag);
    if (result) return result;
    const dp_allocator memory = dp_allocator_resolve(allocator);
    dp_scene *const s = dp_alloc_zeroed(&memory, sizeof *s);
    if (!s) return dp_fail(diag, DP_ERR_MEMORY, "out of memory for a scene");
    s->arena.memory = memory;
    result = fill(s, desc, diag);
    if (!result) result = make_source(s, out, diag);
    if (result) scene_destroy(s);
    return result;
}

/* ------- what is played ------- */

static dp_scene *scene_of(const dp_source *source) {
    return source && source->callbacks.next == scene_next ? source->callbacks.user : NULL;
}

const dp_scene_desc *dp_scene_of(const dp_source *source) {
    const dp_scene *const s = scene_of(source);
    return s ? &s->desc : NULL;
}

dp_result dp_scene_play(dp_source *source, uint32_t clip, dp_diag *diag) {
    dp_scene *const s = scene_of(source);
    if (!s) return dp_fail(diag, DP_ERR_ARGUMENT, "dp_scene_play: the source is no scene");
    if (clip > s->desc.clip_count)
        return dp_fail(diag, DP_ERR_ARGUMENT, "there is no clip %u; the scene has %u", clip,
                       s->desc.clip_count);
    s->is_posed &= s->clip == clip;
    s->clip = clip;
    s->is_read = source->holds = false;
    return DP_OK;
}
