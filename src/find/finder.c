/* A worker's memory for finding lines: see finder.h. */
#include "find/finder.h"

bool dp_finder_begin(dp_finder *finder, const dp_frame *frame, dp_found *found) {
    finder->found = found;
    found->piece_count = found->geometry_count = 0;
    finder->lines.owners = NULL;
    finder->lines.levels = 0;
    finder->finds_hidden = false;
    finder->lines.streamed = false;
    dp_one_rings_init(&finder->rings, frame->flat_cosine);
    return dp_tile_begin(&finder->tile, frame);
}

void dp_finder_free(dp_finder *finder) {
    const dp_allocator memory = finder->tile.memory;
    if (!memory.free) return; /* never used */
    dp_one_rings_free(&finder->rings, &memory);
    dp_edge_store_free(&finder->table, &memory);
    dp_emergence_free(&finder->emergence, &memory);
    dp_intersecting_free(&finder->intersecting, &memory);
    dp_line_store_free(&finder->lines, &memory);
    dp_hidden_store_free(&finder->hidden, &memory);
    dp_end_store_free(&finder->ends, &memory);
    dp_tile_free(&finder->tile);
}

uint64_t dp_finder_bytes(const dp_finder *finder) {
    return dp_one_rings_bytes(&finder->rings) + dp_edge_store_bytes(&finder->table) +
           dp_emergence_bytes(&finder->emergence) + dp_intersecting_bytes(&finder->intersecting) +
           dp_line_store_bytes(&finder->lines) + dp_hidden_store_bytes(&finder->hidden) +
           dp_end_store_bytes(&finder->ends) + dp_tile_bytes(&finder->tile);
}

void dp_finder_open(dp_finder *finder, uint32_t index) {
    dp_tile_open(&finder->tile, index);
    finder->lines.candidate_count = finder->lines.probe_count = 0;
    finder->emergence.unpaired_count = finder->emergence.drawn_count =
        finder->emergence.served_count = 0;
}
