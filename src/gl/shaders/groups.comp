// How many groups of invocations a list needs, for an indirect dispatch of dp_item's kind.
#define COMPUTE 1
#include "picture.glsl"

layout(std430, binding = 4) buffer Counters { uint counters[]; };
uniform uint count_at, groups_at, room, times;

void main() {
    uint groups = (times * min(counters[count_at], room) + 63u) / 64u, rows = (groups + 32767u) / 32768u;
    counters[groups_at] = rows > 1u ? 32768u : groups;
    counters[groups_at + 1u] = rows;
    counters[groups_at + 2u] = 1u;
}
