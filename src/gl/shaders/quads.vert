// A corner of an added polygon, pulled from the list: two triangles each.
#include "corner.glsl"
#include "quads_records.glsl"

out float gl_ClipDistance[1];
uniform vec2 depth_move;  // moves it: d * x + y
#ifdef ORDERED
layout(std430, binding = 4) readonly buffer Order { uint order[]; };
#endif

flat out uint line, triangle;
flat out vec3 at; // a point of its plane: x, y, d
flat out vec2 slope;
flat out vec4 root;
flat out float nearest;
flat out vec3 outward; // of a quad: x, y unit, out of its polygon; z: px from there. 0 of others

void main() {
    uint place = uint(gl_VertexID) / 6u, i = uint(gl_VertexID) % 6u;
#ifdef ORDERED
    place = order[place];
#endif
    Added a = added[place];
    uint c = i < 3u ? i : i == 3u ? 0u : i - 2u;
    line = floatBitsToUint(a.points[0].w), triangle = floatBitsToUint(a.points[1].w);
    at = a.points[0].xyz;
    slope = vec2(a.points[2].w, a.points[3].w);
    root = a.root;
    vec2 along = root.zw - root.xy, n = vec2(-along.y, along.x);
    n = dot(n, a.points[2].xy - root.xy) < 0.0 ? -n : n;
    outward = along != vec2(0.0) ? vec3(n, -dot(n, root.xy)) / length(n) : vec3(0.0);
    nearest = max(max(a.points[0].z, a.points[1].z), max(a.points[2].z, a.points[3].z));
#ifdef ORDERED
    if ((line & ADDED_FACE) != 0u) {
        Corner corner = corner_at(corners[3u * triangle + min(c, 2u)]);
        gl_Position = corner.position;
        gl_ClipDistance[0] = corner.before_far;
        if (i >= 3u) gl_Position = vec4(0.0, 0.0, 0.0, -1.0);
        nearest = 3.4e38;
        return;
    }
#endif
    vec3 p = a.points[c].xyz;
    gl_ClipDistance[0] = 1.0;
#ifdef ORDERED // depth is made by the fragments
    gl_Position = window_position_in(p, 1.0, vec2(0.0, 0.5));
#else
    gl_Position = window_position(vec3(p.xy, p.z * depth_move.x + depth_move.y), 1.0);
#endif
}
