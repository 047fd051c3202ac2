// Of listed pixels, pairs of triangles whose planes cross between neighbouring samples that show them.
#define COMPUTE 64
#include "crossings.glsl"
#include "ids.glsl"

layout(std430, binding = 6) readonly buffer Pixels { uint pixels[]; };
layout(std430, binding = 7) writeonly buffer Hits { uvec2 hits[]; };

uint key_at(uint vertex) { return floatBitsToUint(vertices[vertex].screen.w); }

// Do all corners of the triangle lie on one side of a plane, but for those that another one has, too?
bool is_beside(uint triangle, Plane plane, uint other) {
    bool nearer = false, further = false;
    for (uint i = 0u; i < 3u; i++) {
        uint v = corners[3u * triangle + i], key = key_at(v);
        vec4 s = screen_of(v);
        if (is_off_screen(s)) return false;
        bool apart = key != key_at(corners[3u * other]) && key != key_at(corners[3u * other + 1u]) &&
                     key != key_at(corners[3u * other + 2u]);
        float gap = s.z - plane_at(plane, s.xy);
        nearer = nearer || (apart && gap >= 0.0), further = further || (apart && gap <= 0.0);
    }
    return !(nearer && further);
}
// Two samples show two triangles. Is each the nearer one where it is seen?
bool planes_cross(uint t, vec2 at_t, uint u, vec2 at_u, out Plane p, out Plane q) {
    p = plane_of(t), q = plane_of(u);
    float slopes = abs(p.slope.x) + abs(p.slope.y) + abs(q.slope.x) + abs(q.slope.y),
          gap_t = plane_at(p, at_t) - plane_at(q, at_t), gap_u = plane_at(q, at_u) - plane_at(p, at_u);
    float tolerance = 0.02 * (depth_steps(plane_at(p, at_t), 1.0) + slopes);
    return gap_t >= -tolerance && gap_u >= -tolerance;
}

bool may_cross(uint id, vec2 at, uint other, vec2 other_at) {
    uint t = id - 1u, u = other - 1u;
    if (polygon_of(t) == polygon_of(u)) return false;
    Plane p, q;
    if (!planes_cross(t, at, u, other_at, p, q)) return false;
    return is_fan(t) || is_fan(u) || !(is_beside(t, q, u) || is_beside(u, p, t));
}

void main() {
    uint i = dp_item();
    if (i >= head.pixels) return;
    ivec2 p = ivec2(pixels[i] & 0xFFFFu, pixels[i] >> 16);
    uint id = id_at(p, 0), last = id;
    for (int k = 1; k < SAMPLES + 2; k++) {
        bool here = k < SAMPLES;
        ivec2 q = here ? p : p + ivec2(SAMPLES + 1 - k, k - SAMPLES);
        int place = here ? k : 0;
        if (!is_in_picture(q)) continue;
        uint other = id_at(q, place);
        if (other == last || other == id || !is_triangle(other)) continue;
        last = other;
        if (!may_cross(id, vec2(p) + place_of(0), other, vec2(q) + place_of(place))) continue;
        uint at = atomicAdd(head.hits, 1u);
        if (at < head.hits_room) hits[at] = uvec2(id, other) - 1u;
    }
}
