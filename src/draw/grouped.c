/* dp_draw_grouped: a style per group of polygons.
 *
 * Data structure: the context's `styles`, the picture's first, then one for each group: the
 * picture's own, but for what a group may have of its own. Invariant: what holds for the whole
 * picture is the same in all of them, so that no stage can ask the wrong one. */
#include "draw/context.h"

#include "base/diag.h"

#include <string.h>

enum { MOST = 65536 /* dp_batch.groups has 16 bits */ };

/* The picture's style with a group's own members (drypoint/draw.h names them). */
static dp_style style_of_group(const dp_style *picture, const dp_style *own) {
    dp_style style = *picture;
    style.lines = own->lines;
    memcpy(style.line, own->line, sizeof style.line);
    memcpy(style.hidden.line, own->hidden.line, sizeof style.hidden.line);
    style.ridge_angle = own->ridge_angle;
    style.valley_angle = own->valley_angle;
    style.surface = own->surface;
    style.section = own->section;
    style.xray = own->xray;
    style.cull_back_faces = own->cull_back_faces;
    style.shade.model_colors = own->shade.model_colors;
    return style;
}

/* Says whose style it is. */
static dp_result fail_group(dp_result result, uint32_t group, dp_diag *diag) {
    char message[sizeof diag->message];
    if (!diag) return result;
    memcpy(message, diag->message, sizeof message);
    return dp_fail(diag, result, "the style of group %u: %s", group, message);
}

static dp_result resolve_styles(dp_context *c, const dp_style *style, const dp_style *groups,
                                uint32_t count, dp_diag *diag) {
    static const dp_style usual = {0};
    const dp_style *const picture = style ? style : &usual;
    if (!dp_reserve(&c->memory, &c->styles, &c->styles_cap, (size_t)count + 1, sizeof *c->styles))
        return dp_fail(diag, DP_ERR_MEMORY, "out of memory for the styles of %u groups", count);
    dp_result result = dp_style_resolve(picture, &c->styles[0], diag);
    for (uint32_t g = 0; g < count && !result; g++) {
        const dp_style own = style_of_group(picture, &groups[g]);
        result = dp_style_resolve(&own, &c->styles[1 + g], diag);
        if (result) result = fail_group(result, g, diag);
    }
    return result;
}

dp_result dp_draw_grouped(dp_context *context, dp_source *source, const dp_camera *camera,
                          const dp_style *style, const dp_style *groups, uint32_t count,
                          const dp_target *target, dp_diag *diag) {
    if (context) dp_forget_drawing(context);
    if (!context || !source || !camera || !target || (count && !groups))
        return dp_fail(diag, DP_ERR_ARGUMENT,
                       "dp_draw_grouped: context, source, camera, target or groups is NULL");
    if (count > MOST)
        return dp_fail(diag, DP_ERR_LIMIT, "styles of %u groups; there are %d groups at most",
                       count, MOST);
    if (style && style->mirror.size > 0 && count > DP_MIRROR_GROUP)
        return dp_fail(diag, DP_ERR_LIMIT,
                       "styles of %u groups leave the mirror none, which is group %u", count,
                       DP_MIRROR_GROUP);
    dp_result result = resolve_styles(context, style, groups, count, diag);
    if (!result)
        result =
            dp_draw_resolved(context, source, camera, context->styles, count + 1, target, diag);
    return dp_context_settle(context, result, diag);
}
