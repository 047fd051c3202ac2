// Normals of a mesh's corners, turned as the mesh stands, behind those of the meshes before it; 16 bits a component.
//
//    kind 0    none: zero
//    kind 1    `source` has those of corners, packed: x, y; z, and 1 where a computed one is to be taken
//    kind 2    `source` has those of the application's vertices, as floats
#define COMPUTE 64
#define NO_VERTICES
#include "scene.glsl"
#include "normals16.glsl"

layout(std430, binding = 3) readonly buffer Source { uint source[]; };
layout(std430, binding = 4) readonly buffer Made { uvec2 made[]; };
layout(std430, binding = 5) writeonly buffer Normals { uvec2 normals[]; };

uniform uint kind, mends, first_vertex, first_corner, corner_count, at, stride;
uniform uint is_turned;
uniform vec4 row0, row1, row2;

vec3 turned(vec3 n) { return vec3(dot(row0.xyz, n), dot(row1.xyz, n), dot(row2.xyz, n)); }

void main() {
    uint i = dp_item();
    if (i >= corner_count) return;
    uvec2 out_ = uvec2(0u);
    if (kind == 1u) {
        out_ = uvec2(source[2u * i], source[2u * i + 1u]);
        if (mends != 0u && out_.y >> 16 != 0u) out_ = made[i];
        out_.y &= 0xffffu;
        if (is_turned != 0u) out_ = pack_normal(turned(unpack_normal(out_)));
    } else if (kind == 2u) {
        uint v = at + (corners[first_corner + i] - first_vertex) * stride;
        vec3 n = uintBitsToFloat(uvec3(source[v], source[v + 1u], source[v + 2u]));
        out_ = pack_normal(is_turned != 0u ? turned(n) : n);
    }
    normals[first_corner + i] = out_;
}
