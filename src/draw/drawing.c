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
    return dp_drawing_make(&c->drawing, c->frame.target.width, c->frame.target.height, desc,
                           &c->given, out, diag);
}
