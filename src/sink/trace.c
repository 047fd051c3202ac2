/* The trace sink: a drawing as text, for tests and for a look at what a sink gets. The format is
 * described in drypoint/sink.h. Numbers have six digits, which is a hundredth of a pixel up to
 * 10000 px, and a point in any locale. */
#include "sink/sink.h"

#include "base/print.h"

#include <stdarg.h>
#include <stdio.h>

enum { LINE_MOST = 256, DIGITS = 6 };

static dp_result put(const dp_tracing *t, dp_diag *diag, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

static dp_result put(const dp_tracing *t, dp_diag *diag, const char *format, ...) {
    char line[LINE_MOST];
    va_list arguments;
    va_start(arguments, format);
    const int length = vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    return t->write(t->user, line, (size_t)length, diag);
}

static const char *number(char text[DP_NUMBER_TEXT], float value) {
    return dp_print_number(text, (double)value, DIGITS);
}

static dp_result begin(void *user, const dp_sheet *sheet, dp_diag *diag) {
    dp_tracing *const t = user;
    t->strokes = t->segments = 0;
    return put(t, diag, "drypoint trace 1\npicture %u %u paper #%08x surface #%08x\n", sheet->width,
               sheet->height, (unsigned)sheet->paper, (unsigned)sheet->surface);
}

static dp_result layer(void *user, dp_line line, dp_diag *diag) {
    return put(user, diag, "layer %s\n", dp_line_name(line));
}

/* Place and kind of an end; a vertex goes without saying where a stroke runs on. */
static dp_result put_end(const dp_tracing *t, const dp_segment *s, int end, bool runs_on,
                         dp_diag *diag) {
    static const char *const kinds[] = {" vertex", " crossing", " hidden", " picture", " detail"};
    const bool known = s->end[end] == DP_END_HIDDEN && s->hider[end] != UINT64_MAX;
    char by[40] = "";
    if (known) snprintf(by, sizeof by, " by %llu", (unsigned long long)s->hider[end]);
    return put(t, diag, "%s%s\n", runs_on && s->end[end] == DP_END_VERTEX ? "" : kinds[s->end[end]],
               by);
}

static dp_result put_place(const dp_tracing *t, const char *word, const float at[3],
                           dp_diag *diag) {
    char x[DP_NUMBER_TEXT], y[DP_NUMBER_TEXT], z[DP_NUMBER_TEXT];
    return put(t, diag, "%s %s %s %s", word, number(x, at[0]), number(y, at[1]), number(z, at[2]));
}

static dp_result put_edge(const dp_tracing *t, const dp_segment *s, dp_diag *diag) {
    char other[40] = "";
    if (s->other != UINT64_MAX)
        snprintf(other, sizeof other, " other %llu", (unsigned long long)s->other);
    if (s->edge == UINT32_MAX && s->line != DP_LINE_INTERSECTION)
        return put(t, diag, " within %llu%s", (unsigned long long)s->polygon, other);
    if (s->edge == UINT32_MAX)
        return put(t, diag, " crossing %llu%s", (unsigned long long)s->polygon, other);
    return put(t, diag, " edge %llu %u%s", (unsigned long long)s->polygon, s->edge, other);
}

/* Does a segment begin where the one before it in the stroke ends? */
static bool meets(const dp_segment *before, const dp_segment *s) {
    const float *const p = before->reversed ? before->a : before->b, *const q =
                                                                         s->reversed ? s->b : s->a;
    return p[0] == q[0] && p[1] == q[1] && p[2] == q[2];
}

static dp_result put_segment(const dp_tracing *t, const dp_chain_stroke *stroke, size_t i,
                             dp_diag *diag) {
    const dp_segment *const s = stroke->segments[i];
    const int first = s->reversed, last = !first;
    const bool runs_on = i + 1 < stroke->count || stroke->closed;
    dp_result result = DP_OK;
    if (i == 0) {
        result = put_place(t, "from", first ? s->b : s->a, diag);
        if (!result) result = put_end(t, s, first, stroke->closed, diag);
    } else if (!meets(stroke->segments[i - 1], s)) {
        result = put_place(t, "gap", first ? s->b : s->a, diag);
        if (!result) result = put_end(t, s, first, false, diag);
    }
    if (!result) result = put_place(t, "to", last ? s->b : s->a, diag);
    if (!result) result = put_edge(t, s, diag);
    return result ? result : put_end(t, s, last, runs_on, diag);
}

static dp_result stroke(void *user, const dp_chain_stroke *s, dp_diag *diag) {
    dp_tracing *const t = user;
    char width[DP_NUMBER_TEXT];
    dp_result result =
        put(t, diag, "stroke %u group %u level %u width %s color #%08x%s\n", s->chain, s->group,
            s->level, number(width, s->width), (unsigned)s->color, s->closed ? " closed" : "");
    for (size_t i = 0; i < s->count && !result; i++) result = put_segment(t, s, i, diag);
    t->strokes++;
    t->segments += s->count;
    return result;
}

static dp_result end(void *user, dp_result so_far, dp_diag *diag) {
    const dp_tracing *const t = user;
    if (so_far) return so_far;
    return put(t, diag, "end %zu strokes %zu segments\n", t->strokes, t->segments);
}

dp_sink dp_trace_sink(dp_tracing *tracing) {
    return (dp_sink){.user = tracing, .begin = begin, .layer = layer, .stroke = stroke, .end = end};
}
