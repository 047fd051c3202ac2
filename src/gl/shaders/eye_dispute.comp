// Does something that the polygons of a line's edge do not know change what the eye sees there? As find/dispute.c, of what
// eye_suspect.comp has listed. Such lines are taken out, and their edges looked at.
#define COMPUTE 64
#define EYE_ACCESS readonly
#include "eye.glsl"
#include "candidates.glsl"

layout(std430, binding = 4) buffer Counters { uint counters[]; };
layout(std430, binding = 5) buffer Candidates { Candidate candidates[]; };
layout(std430, binding = 6) writeonly buffer Disputed { uint disputed[]; };
layout(std430, binding = 7) readonly buffer Suspects { uvec4 suspects[]; };

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

void main() {
    uint i = dp_item();
    if (i >= min(head.suspects, head.suspects_room)) return;
    uvec4 suspect = suspects[i];
    Candidate c = candidates[suspect.x];
    if (c.line == NONE) return;
    uint half_edge = 3u * c.a + c.edge, first = first_of(suspect.w);
    Lookout at = lookout_at(spine_of(half_edge), double(suspect.y) + 0.5LF);
    vec3 plane = plane_about(area_normal(suspect.w), corner_at(first, 0u), at.at);
    vec2 towards = (suspect.z & 1u) != 0u ? at.right : -at.right;
    if (!disputes(first, plane, at, towards, half_edge, (suspect.z & 2u) != 0u)) return;
    if (atomicExchange(candidates[suspect.x].line, NONE) == NONE) return;
    uint to = atomicAdd(counters[5], 1u);
    if (to < head.disputed_room) disputed[to] = half_edge;
}
