// Which edges are outlines (Hermosilla and Vázquez 2010, Listing 2.1), decided as core/facing.c decides it on the CPU.
//
//     facing     of a triangle: in front, and whether it has an area
//     outline    of a half-edge: SILHOUETTE or BORDER if its triangle draws it, else NO_LINE
//
// Includers define FACING_OF(triangle), which says how a triangle lies.
#include "scene.glsl"
#include "facing.glsl"

const uint FRONT = 1u, NO_AREA = 2u; // facing
const uint NO_LINE = 7u;

layout(std430, binding = 3) readonly buffer Mates { uint mates[]; };
// Half-edges of edges that more than two triangles have: the half-edge; the number of the first of its edge.
layout(std430, binding = 4) readonly buffer Rings {
    uint ring_count, ring_free;
    uvec2 rings[];
};

uint facing_by_angle(vec3 a, vec3 b, vec3 c, double least) {
    precise dvec3 u = dvec3(b) - dvec3(a), v = dvec3(c) - dvec3(a);
    precise dvec3 n = dvec3(u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x);
    double l = length(n), size = max(dot(u, u), dot(v, v));
    if (!(l > 1e-12lf * size)) return NO_AREA; // or not finite
    return dot(n / l, view_vector(dvec3(a))) < -least ? FRONT : 0u;
}
// On the screen, if the area there is clear; else by the angle in space.
uint facing_of_vertices(Vertex a, Vertex b, Vertex c) {
    if (is_off_screen(a.screen) || is_off_screen(b.screen) || is_off_screen(c.screen))
        return facing_by_angle(a.world.xyz, b.world.xyz, c.world.xyz, 1e-12lf);
    precise vec2 u = b.screen.xy - a.screen.xy, v = c.screen.xy - a.screen.xy;
    precise float area = u.x * v.y - u.y * v.x;
    float reach = max(max(abs(u.x), abs(u.y)), max(abs(v.x), abs(v.y)));
    if (abs(area) > picture.step_.z * reach) return area < 0.0 ? FRONT : 0u;
    bool edge_on = abs(area) <= float(EDGE_ON) * reach;
    return facing_by_angle(a.world.xyz, b.world.xyz, c.world.xyz, edge_on ? SEEN_EDGE_ON : 1e-12lf);
}
uint facing_of_triangle(uint t) {
    return facing_of_vertices(vertices[corners[3u * t]], vertices[corners[3u * t + 1u]],
                              vertices[corners[3u * t + 2u]]);
}

// Does the triangle face the eye? One without area goes with a neighbour in front, so that slivers make no lines.
bool faces_front(uint t, uint own) {
    if ((own & NO_AREA) == 0u) return (own & FRONT) != 0u;
    for (uint h = 3u * t; h < 3u * t + 3u; h++)
        if (is_mate(mates[h]) && FACING_OF(mate_of(mates[h]) / 3u) == FRONT) return true;
    return false;
}

// Which side of the edge on the screen the triangle lies on; 0: the eye does not see all of it before it.
int side_of(uint half_edge, ClipPoint from, ClipPoint to) {
    ClipPoint far = to_clip(world_of(corners[last_in(half_edge)]));
    if (!(far.c.w > 0.0lf)) return 0;
    dvec2 s = to_screen(from).xy, t = to_screen(to).xy - s, f = to_screen(far).xy - s;
    return t.x * f.y - t.y * f.x < 0.0lf ? 1 : 2;
}
// An edge of more than two triangles is an outline if all of them lie on one side of it; the first of them draws it.
uint outline_of_ring(uint half_edge) {
    uint low = 0u, high = ring_count; // where the edge begins whose first half-edge this is
    while (low < high) {
        uint middle = (low + high) / 2u;
        if (rings[middle].y < half_edge)
            low = middle + 1u;
        else
            high = middle;
    }
    ClipPoint from = to_clip(world_of(corners[half_edge])),
              to = to_clip(world_of(corners[next_in(half_edge)]));
    if (!(from.c.w > 0.0lf && to.c.w > 0.0lf)) return NO_LINE;
    int sides = 0, n = 0;
    for (; low < ring_count && rings[low].y == half_edge; low++, n++) {
        int side = side_of(rings[low].x, from, to);
        if (side == 0) return NO_LINE;
        sides |= side;
    }
    return n > 0 && sides != 3 ? SILHOUETTE : NO_LINE;
}

// `own`: how its triangle lies; `other`: how the triangle across does, where there is one.
uint outline_of(uint half_edge, uint own, uint other) {
    uint mate = mates[half_edge], t = half_edge / 3u;
    if (!may_be_line(half_edge) || (own & NO_AREA) != 0u) return NO_LINE;
    if (mate == MATE_NONE) return BORDER;
    if (mate == MATE_MANY) return outline_of_ring(half_edge);
    uint across = mate_of(mate) / 3u;
    bool front = (own & FRONT) != 0u, turned = (mate & MATE_ALIKE) != 0u;
    if (front == (faces_front(across, other) != turned)) return NO_LINE;
    if ((other & NO_AREA) != 0u) return SILHOUETTE;
    return (turned ? t < across : front) ? SILHOUETTE : NO_LINE;
}
