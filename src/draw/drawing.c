/* A cleaned drawing of the context's last picture. */
#include "draw/context.h"
#include "vector/drawing.h"

#include "base/diag.h"

dp_result dp_drawing_create(dp_context *c, const dp_drawing_desc *desc, dp_drawing **out,
                            dp_diag *diag) {
    if (out) *out = NULL;
    if (!c || !out)
        return dp_fail(diag, DP_ERR_ARGUMENT, "dp_drawing_create: context or out is NULL");
    if (!c->drawn)
        return dp_fail(diag, DP_ERR_ARGUMENT, "dp_drawing_create: nothing has been drawn");
    size_t count;
    if (c->drawing.count && !dp_segments(c, &count))
        return dp_fail(diag, DP_ERR_MEMORY, "out of memory for the chains of a drawing");
    const dp_frame *const f = &c->frame;
    const dp_drawn drawn = {.segments = c->drawing.segments,
                            .count = c->drawing.count,
                            .width = f->target.width,
                            .height = f->target.height,
                            .paper = c->drawing.paper,
                            .hidden_look = c->drawing.hidden_look,
                            .perspective = f->view.perspective,
                            .focal = f->view.focal};
    return dp_drawing_make(&drawn, desc, &c->given, out, diag);
}
