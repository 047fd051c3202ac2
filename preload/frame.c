/* frame.c: keeps what is drawn with lines until the surfaces are finished.
 *
 *     for each draw call of polygons
 *       if its state allows lines: draw it (as paper, if wanted), and keep its triangles and matrices
 *     when the buffers are swapped, or someone reads the picture, or draws over everything
 *       draw the lines of all that was kept onto the picture (lines.c)
 *     when the depth buffer is cleared, or after the swap
 *       forget it
 *
 * So the order of draw calls does not matter, nor which of two neighbours comes first, and valleys see the
 * finished surfaces on both of their sides.
 * Invariant: own->count corners are covered by the draws without a mesh; inked <= count.
 *
 * Not handled: what is blended over solids afterwards lies below their lines. A frame of more than
 * MESH_CORNERS_MAX corners gets its lines in parts, each from the surfaces so far. */
#include "lines.h"

#include <stdlib.h>
#include <string.h>

enum { DRAWS_MAX = 1 << 16 };

bool frame_open_draw(struct context *context) {
    context->recording = false;
    if (context->in_begin || !context_draws_lines(context)) return false;
    context_read_state(context);
    if (context->verdict == DRAW_ABOVE_ALL) frame_ink(context);
    if (context->verdict != DRAW_WITH_LINES) return false;
    context->papered = settings()->paper_white && !context->list;
    if (context->papered) {
        lines_set_constants(&context->painter);
        gl.glUseProgram(context->painter.paper);
    }
    return context->recording = true;
}

void frame_close_draw(struct context *context) {
    if (context->papered) gl.glUseProgram(0);
    context->papered = context->recording = false;
}

static bool draws_reserve(struct frame *frame) {
    if (frame->count < frame->room) return true;
    const size_t room = frame->room ? 2 * frame->room : 64;
    struct draw *const grown = realloc(frame->draws, room * sizeof *grown);
    if (!grown) return false;
    frame->draws = grown;
    frame->room = room;
    return true;
}

/* Does a draw continue the one before, with the same state? Immediate mode makes thousands of those. */
static bool extends_last(const struct frame *frame, const struct draw_state *state, size_t first) {
    if (!frame->count || frame->count == frame->inked) return false;
    const struct draw *const draw = &frame->draws[frame->count - 1];
    return !draw->mesh && draw->first + draw->count == first &&
           memcmp(&draw->state, state, sizeof *state) == 0;
}

static void add_draw(struct context *context, struct mesh *mesh, size_t first, size_t count) {
    struct frame *const frame = &context->frame;
    if (!count) return;
    if (!mesh && extends_last(frame, &context->state, first)) {
        frame->draws[frame->count - 1].count += count;
        return;
    }
    if (!draws_reserve(frame)) return;
    struct draw *const draw = &frame->draws[frame->count++];
    *draw = (struct draw){mesh ? mesh_share(mesh) : NULL, first, count, context->state};
}

/* Draws what there is when there is too much of it. */
static void make_room(struct context *context) {
    const struct frame *const frame = &context->frame;
    const bool full =
        frame->count >= DRAWS_MAX ||
        (frame->own && frame->own->count + 3 * context->builder.count > MESH_CORNERS_MAX);
    if (!full) return;
    say_once(SAY_MEMORY, "frames of more than %d triangles get their lines in parts",
             MESH_CORNERS_MAX / 3);
    frame_close_draw(context);
    frame_ink(context);
    frame_reset(context);
}

void frame_add_polygons(struct context *context) {
    struct frame *const frame = &context->frame;
    make_room(context);
    if (!frame->own) frame->own = mesh_create();
    if (!frame->own) return;
    const size_t first = frame->own->count;
    if (builder_end(&context->builder, frame->own))
        add_draw(context, NULL, first, frame->own->count - first);
}

void frame_add_mesh(struct context *context, struct mesh *mesh) {
    context->builder.count = 0;
    make_room(context);
    add_draw(context, mesh, 0, mesh->count);
}

void frame_ink(struct context *context) {
    struct frame *const frame = &context->frame;
    if (frame->inked == frame->count || context->in_begin || context->list) return;
    frame->inked = frame->count;
    lines_draw(context);
}

void frame_reset(struct context *context) {
    struct frame *const frame = &context->frame;
    for (size_t i = 0; i < frame->count; i++) mesh_release(frame->draws[i].mesh);
    frame->count = frame->inked = 0;
    if (frame->own) frame->own->count = 0;
}

/* Clears as GL would; the background of a drawing is paper. */
static void clear(struct context *context, GLbitfield mask) {
    GLfloat color[4];
    GLint target = 0;
    const float *const paper = settings()->paper;
    gl.glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &target);
    const bool white = (mask & GL_COLOR_BUFFER_BIT) && target == 0 && settings()->paper_white &&
                       context_draws_lines(context);
    if (white) {
        gl.glGetFloatv(GL_COLOR_CLEAR_VALUE, color);
        gl.glClearColor(paper[0], paper[1], paper[2], color[3]);
    }
    gl.glClear(mask);
    if (white) gl.glClearColor(color[0], color[1], color[2], color[3]);
}

void frame_clear(struct context *context, GLbitfield mask) {
    if (!context_able(context)) {
        gl.glClear(mask);
        return;
    }
    const bool all = (mask & GL_COLOR_BUFFER_BIT) && !gl.glIsEnabled(GL_SCISSOR_TEST);
    if ((mask & GL_DEPTH_BUFFER_BIT) && !all) frame_ink(context);
    if (mask & GL_DEPTH_BUFFER_BIT) frame_reset(context);
    clear(context, mask);
}
