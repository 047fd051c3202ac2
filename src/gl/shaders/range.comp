// Near and far of the enhanced groups: least and greatest distance of their vertices before the eye (Nienhaus and Döllner 2003,
// 4.1.1), as gbuffer/gbuffer.c fits them. One item a vertex, or with CHOSEN one a triangle.
#define COMPUTE 64
#include "scene.glsl"
#include "shading.glsl"

layout(std430, binding = 4) buffer Range { uint range_bits[2]; };
#ifdef CHOSEN
layout(std430, binding = 5) readonly buffer Enhanced { uint enhanced[]; };
#endif

// In the order of floats.
uint to_order(float f) {
    uint u = floatBitsToUint(f);
    return (u & 0x80000000u) != 0u ? ~u : u | 0x80000000u;
}

void extend(uint vertex) {
    vec4 s = screen_of(vertex);
    if (is_off_screen(s)) return;
    uint u = to_order(distance_of(s.z));
    atomicMin(range_bits[0], u);
    atomicMax(range_bits[1], u);
}

void main() {
    uint i = dp_item();
#ifdef CHOSEN
    if (i >= picture.counts.y) return;
    uint group = group_of(i);
    if (group >= shading.counts.z || enhanced[group] == 0u) return;
    for (uint k = 0u; k < 3u; k++) extend(corners[3u * i + k]);
#else
    if (i < picture.counts.x) extend(i);
#endif
}
