// A face that lies close behind the surface (Raskar 2001, 2.4): an intersection. By default by the between-test of planes, of two
// polygons that do not touch, and are both seen from the front or do cross; INTERVAL: by depth alone.
#include "quads_surface.glsl"
#include "quads_records.glsl"
#include "crossing.glsl"

uniform float reach;
layout(location = 0) out uint ink;
flat in uint triangle;

// Do two polygons, named by their first triangles, have a corner position in common? Then they meet there by construction.
bool touch(uint a, uint b) {
    uint n = corner_count(a), m = corner_count(b);
    for (uint i = 0u; i < n; i++)
        for (uint k = 0u; k < m; k++)
            if (world_of(vertex_at(a, i)) == world_of(vertex_at(b, k))) return true;
    return false;
}
// Along every outline of a closed model a front and a back face come close without crossing.
bool may_intersect(uint a, uint b) {
    Crossing x;
    if (touch(first_of(a), first_of(b))) return false;
    return (is_front(a) && is_front(b)) || cross_polygons(first_of(a), first_of(b), x);
}

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
