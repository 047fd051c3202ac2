// Marks the half-edges that have made lines, which are not to be drawn again.
#define COMPUTE 64
#include "eye.glsl"
#include "candidates.glsl"

layout(std430, binding = 4) readonly buffer Counters { uint counters[]; };
layout(std430, binding = 5) readonly buffer Candidates { Candidate candidates[]; };
layout(std430, binding = 7) readonly buffer Mates { uint mates[]; };

void mark(uint half_edge) { atomicOr(words[half_edge / 32u], 1u << (half_edge % 32u)); }

void main() {
    uint i = dp_item();
    if (i >= min(counters[4], head.candidates_room)) return;
    Candidate c = candidates[i];
    if (c.line == NONE || c.edge == NONE) return;
    mark(3u * c.a + c.edge);
    uint mate = mates[3u * c.a + c.edge];
    if (c.b != NONE && is_mate(mate)) mark(mate_of(mate));
}
