// Marks the cells in which there are sample points.
#define COMPUTE 64
#include "eye.glsl"

layout(std430, binding = 4) readonly buffer LookedAt { Looked looked[]; };
layout(std430, binding = 5) readonly buffer Chunks { uint chunks[]; };

void main() {
    uint i = dp_item();
    if (i >= min(head.chunks, head.chunks_room) || chunks[i] >= head.looked_room) return;
    Looked e = looked[chunks[i]];
    Spine s = spine_of(e.half_edge);
    uint first = (i - e.chunk) * CHUNK, last = min(first + CHUNK, places_of(e)), had = NONE;
    for (uint p = first; p < last; p++) {
        uint cell = cell_number(cell_of(vec2(place_of_edge(e, s, p).at)));
        uint at = head.cells_at + cell / 32u, bit = 1u << (cell % 32u);
        if (cell != had && (words[at] & bit) == 0u) atomicOr(words[at], bit);
        had = cell;
    }
}
