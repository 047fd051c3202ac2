// A face that lies close behind the surface (Raskar 2001, 2.4): an intersection. By default by the between-test of planes, of two
// polygons that do not touch, and are both seen from the front or do cross; INTERVAL: by depth alone.
#include "quads_surface.glsl"
#include "quads_records.glsl"
#include "crossing.glsl"

uniform float reach;
uniform vec2 depth_range;
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
    return (faces_eye(a) && faces_eye(b)) || cross_polygons(first_of(a), first_of(b), x);
}

void main() {
    uint id = surface_id();
    if (!is_triangle(id)) discard;
    uint other = id - 1u;
    if (other == triangle) discard;
    vec2 p = sample_at();
    Plane s = face_plane(other);
    float surface = plane_at(s, p), limit = surface * trap.x + trap.y;
    // most are far behind, as the device's own depth tells
    if ((gl_FragCoord.z - depth_range.y) / depth_range.x < limit - 3.0 * (surface - limit)) discard;
    Plane own = face_plane(triangle);
    float d = plane_at(own, p), off = 2.0 * hold_off(d);
#ifdef INTERVAL // moved nearer, so that the surface itself and its duplicates are none
    d += off;
    if (d >= surface || d < limit) discard;
#else
    if (polygon_of(other) == polygon_of(triangle)) discard;
    d -= off;
    if (d > surface || d < limit) discard;
    if (!cross_within(surface - d, s.slope - own.slope, reach)) discard;
    if (!may_intersect(triangle, other)) discard;
#endif
    ink = INTERSECTION + 1u;
}
