// How polygons lie to the eye, and their normals. In float32 where that is sure; other triangles, and polygons of more
// corners, are listed for sides_exact.comp.
#define COMPUTE 64
#include "scene.glsl"
#include "sides.glsl"

layout(std430, binding = 3) writeonly buffer Sides { Side sides[]; };
layout(std430, binding = 4) buffer Counters { uint counters[]; };
layout(std430, binding = 5) writeonly buffer Unsure { uint unsure[]; };

uniform uint has_fans;

bool is_of_fan(uint t) {
    uint polygon = polygon_of(t);
    return (t > 0u && polygon_of(t - 1u) == polygon) ||
           (t + 1u < picture.counts.y && polygon_of(t + 1u) == polygon);
}

void main() {
    uint t = dp_item();
    if (t >= picture.counts.y) return;
    uint i = corners[3u * t], j = corners[3u * t + 1u], k = corners[3u * t + 2u];
    vec3 o = world_of(i), n = cross(world_of(j) - o, world_of(k) - o);
    vec3 p = world_of(j) - o, q = world_of(k) - o;
    vec2 a = screen_of(i).xy, u = screen_of(j).xy - a, v = screen_of(k).xy - a;
    float area = u.x * v.y - u.y * v.x, l = length(n), size = max(dot(p, p), dot(q, q)),
          reach = max(max(abs(u.x), abs(u.y)), max(abs(v.x), abs(v.y)));
    // of a corner that is not on the screen all is NaN, and nothing is sure
    bool sure = l > 1e-4 * size && l > 1e-18 && l < 1e18 &&
                abs(area) > 2.0 * picture.step_.z * reach;
    if (has_fans != 0u) sure = sure && !is_of_fan(t);
    if (sure) sides[t] = Side(n / l, area < 0.0 ? SIDE_FRONT : 0u);
    else unsure[atomicAdd(counters[8], 1u)] = t;
}
