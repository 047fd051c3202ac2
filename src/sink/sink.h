/* Handing a drawing to a sink. */
#ifndef DP_SINK_SINK_H
#define DP_SINK_SINK_H

#include "strokes/lines.h"
#include <drypoint/sink.h>

/* Calls the sink's functions in their order (drypoint/sink.h). A sink that takes layers or strokes,
 * or looks at how many there are, needs a drawing that is chained (dp_chain_lines). */
dp_result dp_hand_over(const dp_frame *frame, const dp_lines *drawing, const dp_sink *sink,
                       dp_diag *diag);

/* A sink that writes a drawing as text. */
typedef struct dp_tracing {
    dp_text_writer *write;
    void *user;
    size_t strokes, segments;
} dp_tracing;
dp_sink dp_trace_sink(dp_tracing *tracing);

#endif
