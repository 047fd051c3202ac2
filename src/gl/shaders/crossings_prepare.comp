// How many groups the next passes have (crossings.c).
#define COMPUTE 1
#include "crossings.glsl"

void main() {
    uint groups = (min(head.pairs, head.pairs_room) + 63u) / 64u, rows = (groups + 32767u) / 32768u;
    head.groups = uvec4(rows > 1u ? 32768u : groups, max(rows, 1u), 1u, 0u);
}
