// A segment's capsule: a rectangle around all pixels that the stroke may cover, one instance a segment.
#define SEGMENTS_BINDING 3
#include "scene.glsl"
#include "ink_segments.glsl"

const float MARGIN = 0.53125; // px: half a pixel, in which coverage fades, and rounding to the device's grid

flat out vec3 a, along; // the spine: x, y, d and their change from end to end
flat out float half_width; // px
flat out uint line;
flat out vec3 planes[2]; // d = x + y * (screen x) + z * (screen y) of the polygons that meet there; NaN: none

// As strokes/segments.inc makes it: the plane through `at` (world space) with a polygon's normal.
vec3 plane_through(uint triangle, dvec3 at) {
    dvec3 n = normalize(area_normal(triangle));
    double c = dot(n, at);
    dvec3 o = picture.corner.xyz, eye = picture.eye.xyz;
    double under = is_perspective() ? c - dot(n, eye) : dot(n, picture.forward.xyz),
           over = is_perspective() ? dot(n, o - eye) : dot(n, o) - c;
    return vec3(float(over / under + (is_perspective() ? 0.0 : 1.0)),
                float(dot(n, picture.across.xyz) / under), float(dot(n, picture.down.xyz) / under));
}
vec3 plane_beside(uint triangle, bool seen) {
    if (triangle == NONE || !seen) return vec3(intBitsToFloat(0x7fc00000), 0.0, 0.0);
    return plane_through(triangle, dvec3(world_of(corners[3u * triangle])));
}

void main() {
    Segment s = segments[gl_InstanceID];
    a = s.a, along = s.b - s.a;
    line = s.line;
    half_width = picture.widths[line].x * 0.5;
    planes[0] = plane_beside(s.triangle, (s.seen & 1u) != 0u);
    planes[1] = plane_beside(s.other, (s.seen & 2u) != 0u);
    float l = length(along.xy), reach = half_width + MARGIN;
    vec2 u = l > 0.0 ? along.xy / l * reach : vec2(reach, 0.0);
    bool end = (gl_VertexID & 1) != 0;
    vec2 p = (end ? s.b.xy + u : s.a.xy - u) + ((gl_VertexID & 2) != 0 ? vec2(-u.y, u.x) : vec2(u.y, -u.x));
    gl_Position = vec4(p * picture.size.zw * 2.0 - 1.0, 0.0, 1.0);
}
