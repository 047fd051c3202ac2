// How many groups of invocations a list needs, for an indirect dispatch of dp_item's kind.
#define COMPUTE 1
#include "picture.glsl"

layout(std430, binding = 3) buffer Counters { uint counters[]; };
uniform uint count_at, room, times;

const uint GROUPS_AT = 12u; // dp_gl_counters.groups[0]

void main() {
    uint groups = (times * min(counters[count_at], room) + 63u) / 64u,
         rows = (groups + 32767u) / 32768u;
    counters[GROUPS_AT] = rows > 1u ? 32768u : groups;
    counters[GROUPS_AT + 1u] = rows;
    counters[GROUPS_AT + 2u] = 1u;
}
