/* A planar mirror (Nienhaus and Döllner 2003, 5).
 *
 *     draw the reflected scene, with lines of its own, into a picture of the context
 *     draw the scene with the mirror as one more polygon, whose pixels show that picture
 *
 * The mirror's pixels in the G-buffer do what the stencil buffer does in the paper: what stands
 * before the mirror hides it, edges and strokes lie over it, and its outline is anti-aliased like
 * any other. The reflected scene is lit by the reflected light, so that it looks as the scene
 * does. */
#include "draw/mirror.h"

#include "base/diag.h"
#include "draw/context.h"
#include "mesh/reflect.h"

#include <string.h>

static const dp_array arrays[] = {DP_ARRAY(dp_mirror_store, rgba, rgba_cap),
                                  DP_ARRAY(dp_mirror_store, distance, distance_cap)};

void dp_mirror_store_free(dp_mirror_store *store, const dp_allocator *memory) {
    dp_normal_store_free(&store->normals, memory);
    dp_arrays_free(memory, store, DP_ARRAYS(arrays));
    dp_reflection_free(store->reflection);
}

uint64_t dp_mirror_store_bytes(const dp_mirror_store *store) {
    return dp_normal_store_bytes(&store->normals) + dp_arrays_bytes(store, DP_ARRAYS(arrays)) +
           dp_reflection_bytes(store->reflection);
}

dp_plane_equation dp_mirror_plane(const dp_mirror *m, const dp_view *view) {
    const dp_vec3 n = dp_unit(dp_v3(m->normal[0], m->normal[1], m->normal[2]));
    dp_plane_equation p = {{n.x, n.y, n.z}, m->offset};
    const double side =
        view->perspective ? dp_dot(n, view->eye) - p.offset : -dp_dot(n, view->forward);
    for (int k = 0; k < 3 && side < 0; k++) p.n[k] = -p.n[k];
    if (side < 0) p.offset = -p.offset;
    return p;
}

void dp_mirror_square(const dp_mirror *m, const dp_plane_equation *plane, double corners[4][3]) {
    const dp_vec3 n = dp_v3(plane->n[0], plane->n[1], plane->n[2]);
    const dp_vec3 c = dp_v3(m->center[0], m->center[1], m->center[2]);
    const dp_vec3 axis = fabs(n.x) > 0.9 ? dp_v3(0, 0, 1) : dp_v3(1, 0, 0);
    const dp_vec3 u = dp_unit(dp_mad(axis, n, -dp_dot(axis, n))), v = dp_cross(n, u);
    const dp_vec3 middle = dp_mad(c, n, plane->offset - dp_dot(n, c));
    static const int signs[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    for (int i = 0; i < 4; i++) {
        const dp_vec3 p =
            dp_mad(dp_mad(middle, u, signs[i][0] * 0.5 * m->size), v, signs[i][1] * 0.5 * m->size);
        corners[i][0] = p.x, corners[i][1] = p.y, corners[i][2] = p.z;
    }
}

/* Camera axes in world space: rows right, up, back. */
static void axes_of(const dp_camera *camera, dp_vec3 axes[3]) {
    for (int r = 0; r < 3; r++)
        axes[r] = dp_unit(dp_v3(camera->view[r], camera->view[4 + r], camera->view[8 + r]));
}

void dp_mirror_light(const dp_camera *camera, const dp_plane_equation *plane, float light[3]) {
    dp_vec3 axes[3], world = {0, 0, 0};
    const dp_vec3 n = dp_v3(plane->n[0], plane->n[1], plane->n[2]);
    axes_of(camera, axes);
    for (int r = 0; r < 3; r++) world = dp_mad(world, axes[r], light[r]);
    world = dp_mad(world, n, -2 * dp_dot(n, world));
    for (int r = 0; r < 3; r++) light[r] = (float)dp_dot(world, axes[r]);
}

typedef struct tinting {
    const dp_mirror *mirror;
    dp_plane_equation plane;
    dp_view view;
    dp_color paper;
    uint8_t *rgba;
    const float *distance;
    uint32_t width;
} tinting;

/* How much of its image a point still has. */
static double left_of(const tinting *t, uint32_t x, uint32_t y, float distance) {
    if (!(t->mirror->fade > 0)) return 1;
    if (!isfinite(distance)) return 0;
    const double d = t->view.perspective ? 1 / (double)distance : -(double)distance;
    const dp_vec3 p = dp_unproject(&t->view, (dp_pointd){x + 0.5, y + 0.5, d});
    const double away =
        fabs(t->plane.n[0] * p.x + t->plane.n[1] * p.y + t->plane.n[2] * p.z - t->plane.offset);
    return dp_max(1 - away / t->mirror->fade, 0);
}

/* Fade towards the paper, then the tint over it. */
static void tint_row(void *arg, uint32_t y, uint32_t worker) {
    const tinting *const t = arg;
    uint8_t *p = t->rgba + 4 * (size_t)y * t->width;
    (void)worker;
    for (uint32_t x = 0; x < t->width; x++, p += 4) {
        const double left =
                         left_of(t, x, y, t->distance ? t->distance[(size_t)y * t->width + x] : 0),
                     s = t->mirror->tint_share;
        for (int k = 0; k < 4; k++) {
            const double paper = t->paper >> (24 - 8 * k) & 0xff,
                         tint = k < 3 ? t->mirror->tint >> (24 - 8 * k) & 0xff : 255;
            const double faded = paper + (p[k] - paper) * left;
            p[k] = (uint8_t)(faded + (tint - faded) * s + 0.5);
        }
    }
}

/* The scene's normals and the reflected one's. */
static void exchange_normals(dp_context *c) {
    const dp_normal_store other = c->mirror.normals;
    c->mirror.normals = c->normals;
    c->normals = other;
}

/* Fills the context's mirror picture. */
static dp_result draw_image(dp_context *c, dp_source *source, const dp_camera *camera,
                            dp_style *styles, uint32_t style_count, const dp_target *target,
                            const dp_plane_equation *plane, const dp_view *view, dp_diag *diag) {
    dp_style *const style = &styles[0];
    const size_t pixels = (size_t)target->width * target->height;
    const bool fades = style->mirror.fade > 0;
    if (!dp_reserve(&c->memory, &c->mirror.rgba, &c->mirror.rgba_cap, dp_times(4, pixels), 1) ||
        (fades && !dp_reserve(&c->memory, &c->mirror.distance, &c->mirror.distance_cap, pixels,
                              sizeof(float))))
        return dp_fail(diag, DP_ERR_MEMORY, "out of memory for a mirror");
    const dp_target image = {.width = target->width,
                             .height = target->height,
                             .samples = target->samples,
                             .rgba = c->mirror.rgba,
                             .distance = fades ? c->mirror.distance : NULL};
    dp_source *const other = dp_reflect_source(c->mirror.reflection, source, plane);
    const dp_shade shade = style->shade;
    dp_mirror_light(camera, plane, style->shade.light);
    exchange_normals(c);
    const dp_result result = dp_draw_groups(c, other, camera, styles, style_count, &image, diag);
    exchange_normals(c);
    style->shade = shade;
    if (result) return result;
    tinting t = {.mirror = &style->mirror,
                 .plane = *plane,
                 .view = *view,
                 .paper = style->paper,
                 .rgba = c->mirror.rgba,
                 .distance = fades ? c->mirror.distance : NULL,
                 .width = target->width};
    dp_parallel(c->threads, target->height, tint_row, &t);
    return DP_OK;
}

dp_result dp_draw_mirrored(dp_context *c, dp_source *source, const dp_camera *camera,
                           dp_style *styles, uint32_t style_count, const dp_target *target,
                           dp_diag *diag) {
    dp_view view;
    double corners[4][3];
    if (!dp_source_rewindable(source))
        return dp_fail(diag, DP_ERR_UNSUPPORTED, "a mirror needs a source that can be read twice");
    dp_target checked;
    dp_result result = dp_check_target(target, &checked, diag);
    if (result) return result;
    result = dp_view_init(&view, camera, target->width, target->height, diag);
    if (result) return result;
    dp_reflection **const reflection = &c->mirror.reflection;
    if (!*reflection && !(*reflection = dp_reflection_create(&c->memory)))
        return dp_fail(diag, DP_ERR_MEMORY, "out of memory for a mirror");
    const dp_plane_equation plane = dp_mirror_plane(&styles[0].mirror, &view);
    dp_mirror_square(&styles[0].mirror, &plane, corners);
    c->share_to = 0.5; /* two pictures, of much the same work */
    result = draw_image(c, source, camera, styles, style_count, target, &plane, &view, diag);
    c->share_to = 1;
    dp_forget_drawing(c); /* the image's is not the picture's */
    if (result) return result;
    dp_source *const with_mirror =
        dp_add_quad_source(*reflection, source, (const double(*)[3])corners, DP_MIRROR_GROUP);
    c->share_from = 0.5;
    c->shade.mirrored = c->mirror.rgba;
    result = dp_draw_groups(c, with_mirror, camera, styles, style_count, target, diag);
    c->shade.mirrored = NULL;
    c->share_from = 0;
    return result;
}
