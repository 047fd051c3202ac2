/* Handing a drawing to a sink, layer by layer and chain by chain. */
#include "sink/sink.h"

#include "base/diag.h"
#include "sink/raster.h"

typedef struct handing {
    const dp_frame *frame;
    const dp_lines *drawing;
    const dp_sink *sink;
    const dp_segment **order; /* the segments of one chain */
    dp_diag *diag;
} handing;

static dp_sheet sheet_of(const handing *h) {
    return (dp_sheet){.width = h->frame->target.width,
                      .height = h->frame->target.height,
                      .paper = h->drawing->paper,
                      .surface = h->drawing->surface,
                      .strokes = h->drawing->chained ? h->drawing->chains.chain_count : 0,
                      .segments = h->drawing->count};
}

static const dp_segment *head_of(const handing *h, const dp_chain *chain) {
    const dp_chain_store *const store = &h->drawing->chains;
    return &h->drawing->segments[store->links[chain->first].segment];
}

static dp_result send_stroke(const handing *h, uint32_t index) {
    const dp_chain_store *const store = &h->drawing->chains;
    const dp_chain *const chain = &store->chains[index];
    for (uint32_t i = 0; i < chain->count; i++)
        h->order[i] = &h->drawing->segments[store->links[chain->first + i].segment];
    const dp_segment *const head = h->order[0];
    const dp_chain_stroke stroke = {.line = head->line,
                                    .chain = index,
                                    .group = head->group,
                                    .level = head->level,
                                    .width = head->width,
                                    .color = head->color,
                                    .closed = chain->closed,
                                    .segments = h->order,
                                    .count = chain->count};
    return h->sink->stroke(h->sink->user, &stroke, h->diag);
}

static dp_result send_layer(const handing *h, uint32_t level, dp_line line) {
    bool any = false;
    for (uint32_t c = 0; c < h->drawing->chains.chain_count; c++) {
        const dp_segment *const head = head_of(h, &h->drawing->chains.chains[c]);
        if (head->line != line || head->level != level) continue;
        dp_result result = DP_OK;
        if (!any && h->sink->layer) result = h->sink->layer(h->sink->user, line, h->diag);
        if (!result && h->sink->stroke) result = send_stroke(h, c);
        if (result) return result;
        any = true;
    }
    return DP_OK;
}

static uint32_t longest_chain(const dp_chain_store *store) {
    uint32_t most = 0;
    for (uint32_t c = 0; c < store->chain_count; c++)
        if (store->chains[c].count > most) most = store->chains[c].count;
    return most;
}

static dp_result send_strokes(handing *h) {
    dp_result result = DP_OK;
    if (!h->sink->stroke && !h->sink->layer) return DP_OK;
    h->order =
        dp_alloc_array(h->frame->memory, longest_chain(&h->drawing->chains) + 1u, sizeof *h->order);
    if (!h->order) return dp_fail(h->diag, DP_ERR_MEMORY, "out of memory for a stroke");
    for (uint32_t level = h->drawing->inks_hidden ? DP_LEVELS + 1 : 1; level-- > 0;)
        for (int i = 0; i < DP_LINE_COUNT && !result; i++)
            result = send_layer(h, level, dp_layers[i]);
    dp_free(h->frame->memory, h->order);
    return result;
}

static dp_result hand_over(handing *h) {
    const dp_sink *const sink = h->sink;
    const dp_sheet sheet = sheet_of(h);
    dp_result result = sink->begin ? sink->begin(sink->user, &sheet, h->diag) : DP_OK;
    if (result) return result;
    if (sink->surface) result = sink->surface(sink->user, &h->frame->target, h->diag);
    if (!result) result = send_strokes(h);
    const dp_result last =
        sink->end ? sink->end(sink->user, result, result ? NULL : h->diag) : DP_OK;
    return result ? result : last;
}

dp_result dp_hand_over(const dp_frame *frame, const dp_lines *drawing, const dp_sink *sink,
                       dp_diag *diag) {
    dp_diag unused;
    dp_diag *const why = diag ? diag : &unused;
    handing h = {.frame = frame, .drawing = drawing, .sink = sink, .diag = why};
    why->result = DP_OK;
    const dp_result result = hand_over(&h);
    if (result && why->result != result) dp_fail(why, result, "the sink failed");
    return result;
}
