// Does something that the polygons of a line's edge do not know change what the eye sees there? As find/dispute.c: the
// samples beside every fourth sample point are asked whose they are. Such lines are taken out, and their edges looked at.
#define COMPUTE 64
#define EYE_ACCESS readonly
#include "eye.glsl"
#include "ids.glsl"
#include "candidates.glsl"

layout(std430, binding = 4) buffer Counters { uint counters[]; };
layout(std430, binding = 5) buffer Candidates { Candidate candidates[]; };
layout(std430, binding = 6) writeonly buffer Disputed { uint disputed[]; };
layout(std430, binding = 7) readonly buffer Mates { uint mates[]; };

const uint STEP = 4u;
// px: where samples are looked at, and where else if all of that pixel lie on the other side; nearer than LEAST they may be
// won by either side.
const float BESIDE[2] = float[2](0.5, 1.25), LEAST = 0.02, STEEPEST = 64.0;

// What is expected on either side of the edge: numbers of polygons, NONE: nothing that is known; and its plane about the
// sample point.
struct Expected {
    uint polygon[2], first[2];
};

bool reaches(uint first, uint n, uint flags, Lookout at, vec2 side, bool past_cracks) {
    return covers(first, n, flags, at.at + dvec2(NEAR * side)) ||
           (past_cracks && covers(first, n, flags, at.at + dvec2(head.crack * side)));
}

// Does polygon `first`, with this plane about the sample point, lie in the edge there, and reach it; or just over it?
bool disputes(uint first, vec3 plane, Lookout at, vec2 side, uint half_edge, bool nothing_expected) {
    float gap = plane.x - at.d, tolerance = touching_of(plane.yz, at.d);
    if (gap < -tolerance || gap > max(tolerance, over_of(plane.yz, at.d))) return false;
    uint n = corner_count(first);
    if (is_sliver(first, n)) return false;
    uint flags = (polygon_facing(first, n).front ? FRONT : 0u) | (is_clipped(first, n) ? CLIPPED : 0u);
    if (gap > tolerance) {
        uint own = first_of(half_edge / 3u);
        return covers(first, n, flags, at.at) && !are_neighbours(first, n, own, corner_count(own));
    }
    uint shared_ = (flags & CLIPPED) != 0u ? 0u : shared_ends(first, n, half_edge);
    return shared_ < 2u && reaches(first, n, flags, at, side, nothing_expected) &&
           (holds_edge(plane.yz, at, shared_ > 0u) ||
            edge_along(first, n, flags, at, double(head.crack)) != NONE);
}

bool is_disputed_by(ivec2 pixel, Lookout at, uint side, Expected e, uint half_edge,
                    inout bool looked) {
    vec2 towards = side == 1u ? at.right : -at.right;
    float most = abs(depth_steps(at.d, STEEPEST));
    uint last = NONE;
    for (int i = 0; i < SAMPLES; i++) {
        dvec2 away = dvec2(pixel) + dvec2(place_of(i)) - at.at;
        if (dot(vec2(away), towards) < LEAST) continue;
        looked = true;
        uint id = id_at(pixel, i);
        if (!is_triangle(id) || id == last) continue;
        uint number = polygon_of(id - 1u);
        if (number == e.polygon[0] || number == e.polygon[1]) continue;
        uint first = first_of(id - 1u);
        vec3 plane = plane_about(area_normal(id - 1u), corner_at(first, 0u), at.at);
        float d = plane.x + dot(plane.yz, vec2(away));
        if (abs(d - at.d) > most) continue;
        if (e.polygon[side] != NONE) { // does that surface go on here?
            uint p = e.first[side];
            vec3 there = plane_about(area_normal(p), corner_at(p, 0u), at.at);
            if (abs(there.x + dot(there.yz, vec2(away)) - d) <= touching_of(there.yz, at.d)) continue;
        }
        last = id;
        if (disputes(first, plane, at, towards, half_edge, e.polygon[side] == NONE)) return true;
    }
    return false;
}
bool is_disputed_at(Lookout at, uint side, Expected e, uint half_edge) {
    vec2 towards = side == 1u ? at.right : -at.right;
    bool looked = false;
    for (int i = 0; i < 2 && !looked; i++) {
        ivec2 pixel = ivec2(floor(vec2(at.at) + BESIDE[i] * towards));
        if (is_in_picture(pixel) && is_disputed_by(pixel, at, side, e, half_edge, looked)) return true;
    }
    return false;
}

void expect(uint triangle, bool opposite, inout Expected e) {
    uint first = first_of(triangle);
    uint side = uint(polygon_facing(first, corner_count(first)).front == opposite);
    e.polygon[side] = polygon_of(triangle), e.first[side] = triangle;
}

bool is_disputed(Candidate c) {
    uint half_edge = 3u * c.a + c.edge;
    Spine s = spine_of(half_edge);
    if (!s.is_there || !(length(s.b.xy - s.a.xy) > 0.0)) return false;
    uvec2 range = range_of(s, 0.0);
    if (range.x >= range.y) return false;
    Expected e = Expected(uint[2](NONE, NONE), uint[2](NONE, NONE));
    if ((c.seen & 1u) != 0u) expect(c.a, false, e);
    if ((c.seen & 2u) != 0u && c.b != NONE) expect(c.b, (mates[half_edge] & MATE_ALIKE) == 0u, e);
    for (uint k = range.y - range.x > 2u ? range.x + 1u : range.x; k < range.y; k += STEP) {
        Lookout at = lookout_at(s, double(k) + 0.5);
        if (is_disputed_at(at, 0u, e, half_edge) || is_disputed_at(at, 1u, e, half_edge)) return true;
    }
    return false;
}

void main() {
    uint i = dp_item();
    if (i >= min(counters[4], head.candidates_room)) return;
    Candidate c = candidates[i];
    if (c.line == NONE || c.edge == NONE || !is_disputed(c)) return;
    candidates[i].line = NONE;
    uint at = atomicAdd(counters[5], 1u);
    if (at < head.disputed_room) disputed[at] = 3u * c.a + c.edge;
}
