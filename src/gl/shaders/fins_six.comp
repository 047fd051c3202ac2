// The index buffer with adjacency (Hermosilla and Vázquez 2010, Figure 2.2): corners at 0, 2 and 4, between them the third corner
// of the triangle across. Where there is none, the triangle's own: it is its own back.
#define COMPUTE 64
#define NO_VERTICES
#include "scene.glsl"

layout(std430, binding = 3) readonly buffer Mates { uint mates[]; };
layout(std430, binding = 4) writeonly buffer Six { uint six[]; };

void main() {
    uint t = dp_item();
    if (t >= picture.counts.y) return;
    for (uint k = 0u; k < 3u; k++) {
        uint half_edge = 3u * t + k, mate = mates[half_edge];
        six[6u * t + 2u * k] = corners[half_edge];
        six[6u * t + 2u * k + 1u] = corners[last_in(is_mate(mate) ? mate_of(mate) : half_edge)];
    }
}
