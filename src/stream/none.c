/* What stands for streaming in builds without it (DRYPOINT_STREAMING=OFF): no source is large, and one that takes more
 * memory than the context may use is refused. */
#include "stream/stream.h"

#include "base/diag.h"

bool dp_stream_is_large(const dp_source *source, size_t memory) {
    (void)source, (void)memory;
    return false;
}

dp_result dp_stream_read_model(const dp_stream_setup *setup, dp_source *source,
                               dp_stream_draw **stream, dp_diag *diag) {
    (void)source;
    *stream = NULL;
    return dp_fail(
        diag, DP_ERR_LIMIT,
        "the model takes more than %zu MB, and this build reads no model in parts: allow "
        "more memory",
        setup->limit >> 20);
}

dp_result dp_stream_find(dp_stream_draw *stream, dp_diag *diag) {
    (void)stream, (void)diag;
    return DP_OK;
}

void dp_stream_free(dp_stream_draw *stream) { (void)stream; }

uint64_t dp_stream_bytes(const dp_stream_draw *stream) {
    (void)stream;
    return 0;
}
