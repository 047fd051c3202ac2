/* Draws, and compares what was drawn. */
#include "look.h"

#include "draw/context.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const char *const look_kind_names[LOOK_KINDS] = {"outline", "ridge", "valley"};

/* Which kind a class is of. */
static const int kinds[DP_LINE_COUNT] = {
    [DP_LINE_SILHOUETTE] = LOOK_OUTLINE, [DP_LINE_RIDGE] = LOOK_RIDGE,
    [DP_LINE_VALLEY] = LOOK_VALLEY,      [DP_LINE_INTERSECTION] = LOOK_VALLEY,
    [DP_LINE_BORDER] = LOOK_OUTLINE,
};

static void measure(dp_context *context, look *out) {
    size_t count;
    const dp_segment *const segments = dp_segments(context, &count);
    memset(out->length, 0, sizeof out->length);
    memset(out->world_length, 0, sizeof out->world_length);
    for (size_t i = 0; i < count; i++) {
        const dp_segment *const s = &segments[i];
        double world = 0;
        for (int k = 0; k < 3; k++) world += pow((double)s->world_a[k] - (double)s->world_b[k], 2);
        out->length[s->line] +=
            hypot((double)s->a[0] - (double)s->b[0], (double)s->a[1] - (double)s->b[1]);
        out->world_length[s->line] += sqrt(world);
    }
}

static void make_room(look *out, const look_how *how) {
    if (out->width == how->width && out->height == how->height) return;
    free(out->rgba);
    out->width = how->width, out->height = how->height;
    out->rgba = malloc((size_t)4 * out->width * out->height);
    if (out->rgba == NULL) abort();
}

void look_draw_source(dp_context *context, dp_source *source, const dp_camera *camera,
                      const look_how *how, look *out) {
    make_room(out, how);
    const dp_style style = {.ridge_angle = 150,
                            .valley_angle = 210,
                            .edges = how->adjacency ? DP_EDGES_ADJACENCY : DP_EDGES_EMERGENT,
                            .edge_table_off = how->table_off};
    const dp_target target = {
        .width = out->width, .height = out->height, .samples = how->samples, .rgba = out->rgba};
    context->limit = how->streamed ? 1 : SIZE_MAX;
    out->diag = (dp_diag){.result = DP_OK};
    out->diag.result = dp_draw(context, source, camera, &style, &target, &out->diag);
    measure(context, out);
    dp_stats_of(context, &out->stats);
}

/* A source that hands out one batch that does not stay: arrays that lie in memory are never
 * streamed. */
typedef struct passing {
    dp_batch batch;
    bool passed;
} passing;

static dp_result pass(void *user, dp_batch *batch, dp_diag *diag) {
    passing *const p = user;
    (void)diag;
    if (!p->passed) *batch = p->batch;
    p->passed = true;
    return DP_OK;
}

static dp_result pass_again(void *user, dp_diag *diag) {
    (void)diag;
    ((passing *)user)->passed = false;
    return DP_OK;
}

void look_draw(dp_context *context, const dp_batch *arrays, const dp_camera *camera,
               const look_how *how, look *out) {
    passing p = {.batch = *arrays};
    const dp_source_callbacks callbacks = {.user = &p, .next = pass, .rewind = pass_again};
    dp_source *source;
    p.batch.stable = false;
    const dp_result result = how->streamed
                                 ? dp_source_from_callbacks(&callbacks, NULL, &source, NULL)
                                 : dp_source_from_arrays(arrays, NULL, &source, NULL);
    if (result != DP_OK) abort();
    look_draw_source(context, source, camera, how, out);
    dp_source_destroy(source);
}

void look_free(look *l) {
    free(l->rgba);
    *l = (look){0};
}

double look_length(const look *l, int kind) {
    double sum = 0;
    for (int k = 0; k < DP_LINE_COUNT; k++) sum += kinds[k] == kind ? l->length[k] : 0;
    return sum;
}

static bool differ(const uint8_t *a, const uint8_t *b) {
    static const double limit = 3 * (0.3 * 255) * (0.3 * 255); /* squared, of three channels */
    double sum = 0;
    for (int k = 0; k < 3; k++) sum += (a[k] - b[k]) * (a[k] - b[k]);
    return sum > limit;
}

uint32_t look_pixels(const look *a, const look *b) {
    const size_t pixels = (size_t)a->width * a->height;
    uint32_t count = 0;
    for (size_t i = 0; i < pixels; i++) count += differ(a->rgba + 4 * i, b->rgba + 4 * i);
    return count;
}

double look_lengths(const look *a, const look *b, int *kind) {
    double worst = 0;
    *kind = 0;
    for (int k = 0; k < LOOK_KINDS; k++) {
        const double la = look_length(a, k), lb = look_length(b, k);
        const double by = fabs(la - lb), slack = 0.005 * fmax(la, lb) + 4;
        if (by <= slack || by <= worst) continue;
        worst = by;
        *kind = k;
    }
    return worst;
}

void look_difference(const look *a, const look *b, uint8_t *rgba) {
    const size_t pixels = (size_t)a->width * a->height;
    for (size_t i = 0; i < pixels; i++) {
        const uint8_t p = a->rgba[4 * i], q = b->rgba[4 * i];
        const uint8_t both = (uint8_t)(255 - (255 - (p > q ? p : q)) / 3);
        const bool other = differ(a->rgba + 4 * i, b->rgba + 4 * i);
        rgba[4 * i] = other ? q : both;
        rgba[4 * i + 1] = other ? (p < q ? p : q) : both;
        rgba[4 * i + 2] = other ? p : both;
        rgba[4 * i + 3] = 255;
    }
}
