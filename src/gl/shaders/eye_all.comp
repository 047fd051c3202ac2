// Every edge is looked at: dp_style.edge_table_off.
#define COMPUTE 64
#define EYE_ACCESS readonly
#include "eye.glsl"

layout(std430, binding = 4) buffer Counters { uint counters[]; };
layout(std430, binding = 6) writeonly buffer Disputed { uint disputed[]; };

void main() {
    uint triangle = dp_item();
    if (triangle >= picture.counts.y) return;
    for (uint k = 0u; k < 3u; k++) {
        uint half_edge = 3u * triangle + k;
        if (!may_be_line(half_edge) || is_diagonal(half_edge)) continue;
        uint at = atomicAdd(counters[5], 1u);
        if (at < head.disputed_room) disputed[at] = half_edge;
    }
}
