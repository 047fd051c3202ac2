// Sums of the groups before each group, and the command that draws all: 64 invocations, each for a stretch of groups.
#define COMPUTE 64
#include "picture.glsl"

layout(std430, binding = 7) buffer Sums { uint command[4], sums[]; };

shared uint stretches[64];

void main() {
    uint groups = (picture.counts.y + 63u) / 64u, me = gl_LocalInvocationIndex,
         length_ = (groups + 63u) / 64u, first = min(me * length_, groups),
         last = min(first + length_, groups), sum = 0u;
    for (uint i = first; i < last; i++) sum += sums[i];
    stretches[me] = sum;
    barrier();
    uint before = 0u;
    for (uint i = 0u; i < me; i++) before += stretches[i];
    for (uint i = first; i < last; i++) {
        uint own = sums[i];
        sums[i] = before;
        before += own;
    }
    if (me == 63u) { // points of a strip, strips
        command[0] = 6u;
        command[1] = before;
        command[2] = 0u;
        command[3] = 0u;
    }
}
