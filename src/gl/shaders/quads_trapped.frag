// A valley's polygon behind the surface. By default the between-test of planes: both must cross within half of
// the line's width on the screen, and the surface must pass the edge; INTERVAL: z1 > d >= z2 (Raskar 2001, 2.3).
#include "quads_surface.glsl"

uniform float reach;
layout(location = 0) out uint ink;
flat in uint line, triangle;
flat in vec3 at;
flat in vec2 slope;
flat in vec4 root;
flat in float nearest;
flat in vec3 outward;

void main() {
    uint id = surface_id();
    if (!is_triangle(id)) discard;
    vec2 p = sample_at();
    p += outward.xy * max(-dot(outward.xy, p) - outward.z, 0.0) * 2.0; // see quads_line.frag
    Plane s = face_plane(id - 1u);
    float surface = plane_at(s, p), d = min(at.z + dot(slope, p - at.xy), nearest),
          gap = surface - d;
    if (d < surface * trap.x + trap.y) discard;
#ifdef INTERVAL
    if (gap <= 0.0) discard;
#else
    if (gap < 0.0 || polygon_of(id - 1u) == polygon_of(triangle)) discard;
    vec2 g = s.slope - slope;
    if (!cross_within(gap, g, reach) || !passes_root(p, gap, g, root, reach)) discard;
    if (!faces_eye(id - 1u)) discard;
#endif
    ink = (line & 7u) + 1u;
}
