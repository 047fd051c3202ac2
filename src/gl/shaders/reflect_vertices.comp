// A mesh's vertices, as the mesh stands, reflected in the mirror's plane; in double precision, as mesh/reflect.c has it.
#define COMPUTE 64
#include "picture.glsl"
#include "reflection.glsl"

layout(std430, binding = 0) readonly buffer Positions { float positions[]; };
layout(std430, binding = 3) writeonly buffer Reflected { float reflected[]; };

uniform uint vertex_count, positions_at, stride; // words

void main() {
    uint i = dp_item();
    if (i >= vertex_count) return;
    uint at = positions_at + i * stride;
    dvec4 q = dvec4(positions[at], positions[at + 1u], positions[at + 2u], 1.0);
    vec3 p = vec3(q.xyz);
    if (is_placed != 0u)
        p = vec3(float(dot(placement[0], q)), float(dot(placement[1], q)), float(dot(placement[2], q)));
    precise double twice = 2.0 * side_of(p);
    for (uint k = 0u; k < 3u; k++) {
        precise double r = double(p[k]) - twice * plane[k];
        reflected[3u * i + k] = float(r);
    }
}
