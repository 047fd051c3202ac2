// Lists half-edges of edges that more than two triangles have, with the places of their ends, from the lower one on.
#define COMPUTE 64
#include "scene.glsl"

layout(std430, binding = 3) readonly buffer Mates { uint mates[]; };
struct Many {
    uint half_edge, ends[6], free_;
};
layout(std430, binding = 4) buffer Listed {
    uint count, free_[3];
    Many many[];
};

uniform uint room;

// -0 counts as 0.
uint bits_of(float x) { return x == 0.0 ? 0u : floatBitsToUint(x); }
uvec3 place_of(uint half_edge) {
    vec3 p = world_of(corners[half_edge]);
    return uvec3(bits_of(p.x), bits_of(p.y), bits_of(p.z));
}
bool is_below(uvec3 a, uvec3 b) {
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

void main() {
    uint h = dp_item();
    if (h >= 3u * picture.counts.y || mates[h] != MATE_MANY) return;
    uint at = atomicAdd(count, 1u);
    if (at >= room) return;
    uvec3 a = place_of(h), b = place_of(next_in(h));
    if (is_below(b, a)) {
        uvec3 c = a;
        a = b;
        b = c;
    }
    many[at].half_edge = h;
    many[at].ends = uint[6](a.x, a.y, a.z, b.x, b.y, b.z);
}
