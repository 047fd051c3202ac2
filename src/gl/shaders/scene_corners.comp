// A mesh's triangles, put behind those of the meshes before it. Indices out of range make a triangle without
// area and without lines.
#define COMPUTE 64
#define NO_VERTICES
#define SCENE_ACCESS
#include "scene.glsl"

layout(std430, binding = 3) readonly buffer Indices { uint indices[]; };
layout(std430, binding = 4) readonly buffer Kinds { uvec2 kinds[]; }; // as `triangles`

uniform uint first_vertex, first_triangle, first_polygon, zero_group, other_groups, vertex_count, triangle_count;
uniform uint indices_at;  // words; NONE: there are no indices
uniform uint has_kinds;

void main() {
    uint t = dp_item();
    if (t >= triangle_count) return;
    uint v[3];
    bool good = true;
    for (uint k = 0u; k < 3u; k++) {
        v[k] = indices_at == NONE ? 3u * t + k : indices[indices_at + 3u * t + k];
        good = good && v[k] < vertex_count;
    }
    for (uint k = 0u; k < 3u; k++)
        corners[3u * (first_triangle + t) + k] = first_vertex + (good ? v[k] : 0u);
    uvec2 kind = has_kinds != 0u ? kinds[t] : uvec2(t, 7u);
    kind.x += first_polygon;
    uint group = kind.y >> 16;
    kind.y = (kind.y & 0xffffu) | min(group != 0u ? other_groups + group : zero_group, 65535u) << 16;
    if (!good) kind.y &= ~63u;
    triangles[first_triangle + t] = kind;
}
