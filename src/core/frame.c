/* The memory of a frame: see frame.h. */
#include "core/piece.h"

#include "core/frame.h"

static const dp_array arrays[] = {DP_ARRAY(dp_frame, vertices, vertices_cap),
                                  DP_ARRAY(dp_frame, depth, depth_cap),
                                  DP_ARRAY(dp_frame, facing, facing_cap),
                                  DP_ARRAY(dp_frame, outlined, outlined_cap),
                                  DP_ARRAY(dp_frame, tile_pieces, tile_pieces_cap),
                                  DP_ARRAY(dp_frame, closed, closed_cap),
                                  DP_ARRAY(dp_frame, rings, rings_cap)};

void dp_frame_free(dp_frame *frame, const dp_allocator *memory) {
    dp_arrays_free(memory, frame, DP_ARRAYS(arrays));
    dp_bins_free(&frame->polygon_bins, memory);
    dp_bins_free(&frame->mark_bins, memory);
}

uint64_t dp_frame_bytes(const dp_frame *frame) {
    return dp_arrays_bytes(frame, DP_ARRAYS(arrays)) + dp_bins_bytes(&frame->polygon_bins) +
           dp_bins_bytes(&frame->mark_bins);
}
