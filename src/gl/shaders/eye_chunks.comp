// Which half-edge each chunk of places is of.
#define COMPUTE 64
#define EYE_ACCESS readonly
#include "eye.glsl"

layout(std430, binding = 4) readonly buffer LookedAt { Looked looked[]; };
layout(std430, binding = 5) writeonly buffer Chunks { uint chunks[]; };

void main() {
    uint i = dp_item();
    if (i >= min(head.looked, head.looked_room)) return;
    uint count = (places_of(looked[i]) + CHUNK - 1u) / CHUNK;
    for (uint k = 0u; k < count && looked[i].chunk + k < head.chunks_room; k++)
        chunks[looked[i].chunk + k] = i;
}
