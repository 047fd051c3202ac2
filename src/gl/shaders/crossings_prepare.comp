// How many groups the next passes have (crossings.c).
#define COMPUTE 1
#include "crossings.glsl"

uvec4 groups_of(uint count) {
    uint groups = (count + 63u) / 64u, rows = (groups + 32767u) / 32768u;
    return uvec4(rows > 1u ? 32768u : groups, max(rows, 1u), 1u, 0u);
}
void main() {
    head.groups[0] = groups_of(head.pixels);
    head.groups[1] = groups_of(min(head.hits, head.hits_room));
    head.groups[2] = groups_of(min(head.pairs, head.pairs_room));
}
