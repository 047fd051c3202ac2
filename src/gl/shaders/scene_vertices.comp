// A mesh's vertices: to the scene's space, to the screen, and a key that stands for the position.
#define COMPUTE 64
#define VERTICES_ACCESS
#include "scene.glsl"

layout(std430, binding = 3) readonly buffer Positions { float positions[]; };

uniform uint first_vertex, vertex_count, positions_at, stride; // words
uniform uint is_placed;
layout(std140, binding = 1) uniform Placement {
    dvec4 placement[3]; // rows: the mesh's own space to the scene's
};

uint mix_(uint h) {
    h ^= h >> 16;
    h *= 0x7feb352du;
    h ^= h >> 15;
    h *= 0x846ca68bu;
    return h ^ (h >> 16);
}
// -0 counts as 0.
uint bits_of(float v) { return v == 0.0 ? 0u : floatBitsToUint(v); }
uint key_of(vec3 p) {
    return mix_(bits_of(p.x) * 0x9e3779b1u + mix_(bits_of(p.y) * 0x85ebca77u + mix_(bits_of(p.z))));
}

void main() {
    uint i = dp_item();
    if (i >= vertex_count) return;
    uint at = positions_at + i * stride;
    vec3 p = vec3(positions[at], positions[at + 1u], positions[at + 2u]);
    if (is_placed != 0u) {
        dvec4 q = dvec4(dvec3(p), 1.0);
        p = vec3(float(dot(placement[0], q)), float(dot(placement[1], q)),
                 float(dot(placement[2], q)));
    }
    ClipPoint c = to_clip(p);
    vec3 s = vec3(intBitsToFloat(0x7fc00000), 0.0, 0.0);
    if (is_inside(c)) s = vec3(to_screen(c));
    vertices[first_vertex + i] =
        Vertex(vec4(s, uintBitsToFloat(key_of(p))), vec4(p, float(c.c.w - c.c.z)));
}
