/* Reads a picture's source into the frame's polygons, or finds that it is to be streamed. */
#include "draw/context.h"

#include "base/diag.h"
#include "stream/stream.h"

/* Everything but plain lines over one colour looks at all polygons at once. */
static bool may_stream(const dp_context *c) {
    const dp_style *const style = &c->frame.styles[0];
    return style->ink == DP_INK_STROKES && c->frame.style_count == 1 && !c->frame.hidden &&
           style->edges != DP_EDGES_ADJACENCY && !c->shade.active && !style->smooth &&
           !dp_needs_centre(&c->frame) && !(style->stroke.light > 0) && !style->line_light.lighting;
}

static dp_result tell_gathered(void *arg, double done, dp_diag *diag) {
    return dp_tell_progress(arg, DP_GATHERED * done, diag);
}

/* Whether to stream is decided by the source's size where it tells, else while it is gathered. */
dp_result dp_gather_picture(dp_context *c, dp_source *source, bool *streams, dp_diag *diag) {
    const dp_style *const style = &c->frame.styles[0];
    const bool may = may_stream(c), rewindable = dp_source_rewindable(source);
    *streams = may && (dp_stream_is_large(source, c->limit) || (!rewindable && style->passes == 1));
    if (*streams) return DP_OK;
    c->polygons.limit = may ? c->limit : 0;
    c->polygons.tell = tell_gathered, c->polygons.tell_arg = c;
    const dp_result result =
        dp_gather(source, &c->polygons, &c->memory, &c->frame.polygons, &c->stats, diag);
    if (!result || !c->polygons.is_beyond) return result;
    if (!rewindable)
        return dp_fail(
            diag, DP_ERR_LIMIT,
            "the model takes more than %zu MB and can be read only once: allow more memory, draw "
            "it with one pass, or from a file",
            c->limit >> 20);
    dp_polygon_store_free(&c->polygons, &c->memory);
    c->stats = (dp_stats){0};
    c->share_from = dp_max(c->share_from, c->told); /* progress goes on from there */
    *streams = true;
    return DP_OK;
}
