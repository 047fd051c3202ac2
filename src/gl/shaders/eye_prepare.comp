// How many groups the next passes have (emerge.c).
#define COMPUTE 1
#include "eye.glsl"

layout(std430, binding = 4) readonly buffer Counters { uint counters[]; };
uniform uint step_;

uvec4 groups_of(uint count) {
    uint groups = (count + 63u) / 64u, rows = (groups + 32767u) / 32768u;
    return uvec4(rows > 1u ? 32768u : groups, max(rows, 1u), 1u, 0u);
}
void main() {
    if (step_ == 0u) {
        head.groups[0] = groups_of(head.all_edges != 0u ? 0u : min(counters[4], head.candidates_room));
        return;
    }
    if (step_ == 3u) {
        head.groups[7] = groups_of(min(head.suspects, head.suspects_room));
        return;
    }
    if (step_ == 1u) {
        head.groups[1] = groups_of(min(counters[5], head.disputed_room));
        return;
    }
    head.groups[2] = groups_of(min(head.looked, head.looked_room));
    head.groups[3] = groups_of(min(head.chunks, head.chunks_room));
    head.groups[4] = groups_of(head.looked > 0u ? picture.counts.y : 0u);
    head.groups[5] = groups_of(head.looked > 0u && head.all_edges == 0u ?
                                   min(counters[4], head.candidates_room) : 0u);
    head.groups[6] = uvec4(head.looked > 0u ? head.cells_x : 0u, head.cells_y, 1u, 0u);
}
