/* drypoint/sink.h: where a drawing goes: a table of functions that takes it stroke by stroke.
 *
 * dp_draw inks its strokes into the target's pixels. Afterwards the same drawing can be handed to
 * any number of other sinks, the application's own among them:
 *
 *     static dp_result count(void *user, const dp_chain_stroke *stroke, dp_diag *diag) {
 *         *(size_t *)user += stroke->count;
 *         return DP_OK;
 *     }
 *     size_t segments = 0;
 *     dp_draw(context, source, &camera, NULL, &target, &diag);
 *     dp_send(context, &(dp_sink){.user = &segments, .stroke = count}, &diag);
 */
#ifndef DRYPOINT_SINK_H
#define DRYPOINT_SINK_H

#include <drypoint/draw.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What is drawn on, and how much there is to come. */
typedef struct dp_sheet {
    uint32_t width, height;  /* px */
    dp_color paper, surface; /* of the picture */
    size_t strokes;          /* to come; 0 where the sink takes neither layers nor strokes */
    size_t segments;
} dp_sheet;

/* A chain of segments of one class, level and colour (but for the light that falls on stylized ones,
 * dp_style.line_light), drawn without lifting the pen. Consecutive
 * segments meet at one point; those of stylized strokes (strokes.h) may leave a gap of a few px,
 * over which the stroke runs. */
typedef struct dp_chain_stroke {
    dp_line line;
    uint32_t chain;                    /* as in dp_segment */
    uint32_t group;                    /* of the first segment */
    uint32_t level;                    /* of all its segments; 0: visible */
    float width;                       /* px, the whole line, of the first segment */
    dp_color color;                    /* of the first segment */
    bool closed;                       /* the last segment ends where the first begins */
    const dp_segment *const *segments; /* [count] in the order in which they follow each other;
                                           one that is `reversed` is drawn from b to a */
    size_t count;
} dp_chain_stroke;

/* What a drawing is handed to: the lines as found, before a style bends or textures them. Any
 * function may be NULL, all of them too. A function must not call anything that draws with, or sends
 * from, the same context; to stop, it returns DP_ERR_CANCELLED, or what has failed. They are called in this order, from the
 * thread that sends: begin, surface, then for each class that has strokes, from the bottom up
 * (valleys, intersections, ridges, borders, silhouettes), layer and its strokes, then end. Hidden
 * lines come before, the highest level first, and each level has its own layers in that order: which
 * level a layer is of, its strokes tell. What is
 * pointed to is borrowed until the function returns. They may ask the context for its segments and
 * statistics, or send to another sink, but not draw with it. A result other than DP_OK ends the
 * drawing; its reason goes into `diag`, which may be NULL. */
typedef struct dp_sink {
    void *user;
    dp_result (*begin)(void *user, const dp_sheet *sheet, dp_diag *diag);
    /* The finished picture, lines included: the planes of the last drawing's target, which the
     * caller must not have freed. Draw with style.lines = DP_NO_LINES for the surface alone. */
    dp_result (*surface)(void *user, const dp_target *target, dp_diag *diag);
    dp_result (*layer)(void *user, dp_line line, dp_diag *diag);
    dp_result (*stroke)(void *user, const dp_chain_stroke *stroke, dp_diag *diag);
    /* Called if begin succeeded or was NULL. `so_far`: what stopped the drawing, or DP_OK.
     * Its own result is that of the whole unless something stopped it before; then that one's
     * reason stands, and `diag` is NULL here. */
    dp_result (*end)(void *user, dp_result so_far, dp_diag *diag);
} dp_sink;

/* Hands the lines of the last dp_draw to a sink, which may be done any number of times. Strokes
 * come in an order that does not depend on threads. Drawings with DP_INK_QUADS have none, but for
 * those whose edges come by adjacency. Like all that takes a context, it serves one thread at a
 * time. DP_ERR_ARGUMENT (nothing has been drawn, or the last dp_draw failed), DP_ERR_MEMORY, and
 * whatever the sink returns. */
DP_API dp_result dp_send(dp_context *context, const dp_sink *sink, dp_diag *diag);

/* Text, written piece by piece; a result other than DP_OK ends it. */
typedef dp_result dp_text_writer(void *user, const char *text, size_t size, dp_diag *diag);

/* Hands the lines of the last dp_draw to a writer as text:
 *
 *     drypoint trace 1
 *     picture 320 240 paper #ffffffff surface #ffffffff
 *     layer silhouette
 *     stroke 0 group 0 level 0 width 2 color #000000ff
 *     from 102.5 88.25 4.125 vertex
 *     to 110.375 90 4.125 edge 17 2 other 18
 *     to 131 97.5 4.0625 edge 18 0 other 22 hidden by 40
 *     end 1 strokes 2 segments
 *
 * `stroke` is followed by the number of its chain, and has `closed` at its end where it is closed.
 * `from` begins it, each `to` ends one segment; where a segment does not begin where the one before
 * ended (stylized strokes), a line `gap` says where it begins. `level` is 0 for visible lines;
 * hidden ones come first, with layers of their own. Positions are x and y, px, and the
 * distance along the line of sight. `edge` gives polygon and corner of the source, `crossing` the
 * polygon of an intersection, `within` that of a line on its patch (dp_style.smooth), `other` the second polygon where it is known. What ends a segment comes
 * last: `vertex` (left out where the stroke runs on), `crossing`, `picture` or `hidden`, by a polygon
 * where it is known. */
DP_API dp_result dp_trace(dp_context *context, dp_text_writer *write, void *user, dp_diag *diag);

#ifdef __cplusplus
}
#endif
#endif
