// What hides segments beyond their ends: what hides the next sample point. Asked only when somebody reads them. The point
// is not lifted along the normal here, but towards the eye by as much.
#define COMPUTE 64
#include "hide.glsl"
#include "segments.glsl"

layout(std430, binding = 4) readonly buffer Counters { uint counters[]; };
layout(std430, binding = 5) buffer Segments { Segment segments[]; };

void main() {
    uint i = dp_item() / 2u, end = dp_item() % 2u, hider;
    if (i >= min(counters[1], picture.counts.w) || segments[i].hider[end] == ENDS) return;
    Segment s = segments[i];
    vec3 along = (s.b - s.a) / float(s.k1 - s.k0), at = end == 0u ? s.a - along * 0.5 : s.b + along * 0.5;
    Query q = Query(at.xy, limit_at(double(at.z)) + depth_steps(at.z, 0.1), s.triangle, s.other);
    segments[i].hider[end] = is_hidden(q, hider) ? hider : NONE;
}
