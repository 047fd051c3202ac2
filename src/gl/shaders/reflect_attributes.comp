// What the corners of a mirror image carry, by the corner that each was kept from. NORMALS, TEXCOORDS or COLORS.
#define COMPUTE 64
#include "picture.glsl"
#include "normals16.glsl"

layout(std430, binding = 3) readonly buffer From { uint from[]; };
layout(std430, binding = 4) readonly buffer Corners { uint corners[]; };
layout(std430, binding = 5) writeonly buffer To { uint to[]; };
layout(std430, binding = 6) readonly buffer Origins { uint origins[]; };
layout(std430, binding = 7) readonly buffer Indices { uint indices[]; };

uniform uint corner_count, vertex_count, indices_at;
uniform uint by_vertex, at, stride; // the application's normals: floats
uniform vec4 row0, row1, row2;      // turns and reflects

uint vertex_of(uint corner) { return indices_at == NONE ? corner : indices[indices_at + corner]; }

void main() {
    uint i = dp_item();
    if (i >= corner_count) return;
    uint origin = origins[i];
#ifdef NORMALS
    vec3 n;
    uint mark = 0u;
    if (by_vertex != 0u) {
        uint v = at + min(vertex_of(origin), vertex_count - 1u) * stride;
        n = uintBitsToFloat(uvec3(from[v], from[v + 1u], from[v + 2u]));
    } else {
        uvec2 w = uvec2(from[2u * origin], from[2u * origin + 1u]);
        n = unpack_normal(w);
        mark = w.y & 0xffff0000u;
    }
    uvec2 w = pack_normal(vec3(dot(row0.xyz, n), dot(row1.xyz, n), dot(row2.xyz, n)));
    to[2u * i] = w.x;
    to[2u * i + 1u] = w.y | mark;
#endif
#ifdef TEXCOORDS
    to[2u * i] = from[2u * origin];
    to[2u * i + 1u] = from[2u * origin + 1u];
#endif
#ifdef COLORS
    uint v = vertex_of(origin);
    to[corners[i]] = v < vertex_count ? from[v] : 0u;
#endif
}
