// A face that lies close behind the surface (Raskar 2001, 2.4): an intersection. By default by the between-test of planes, of two
// polygons that do not touch, and are both seen from the front or do cross; INTERVAL: by depth alone.
#include "quads_surface.glsl"
#include "quads_records.glsl"
#include "quads_crossing.glsl"

uniform float reach;
layout(location = 0) out uint ink;
flat in uint triangle;

void main() {
    uint id = surface_id();
    if (!is_triangle(id)) discard;
    uint other = id - 1u;
    vec2 p = sample_at();
    Plane s = plane_of(other), own = plane_of(triangle);
    float surface = plane_at(s, p), d = plane_at(own, p), off = 2.0 * hold_off(d);
#ifdef INTERVAL // moved nearer, so that the surface itself and its duplicates are none
    d += off;
    if (d >= surface || d < surface * trap.x + trap.y) discard;
#else
    if (polygon_of(other) == polygon_of(triangle)) discard;
    d -= off;
    if (d > surface || d < surface * trap.x + trap.y) discard;
    if (!cross_within(surface - d, s.slope - own.slope, reach)) discard;
    if (!may_intersect(triangle, other)) discard;
#endif
    ink = INTERSECTION + 1u;
}
