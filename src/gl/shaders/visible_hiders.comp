// What hides segments beyond their ends, within two pixels. Asked only when somebody reads them: points further and further
// on along the line, which are not lifted along the normal here, but towards the eye by as much.
#define COMPUTE 64
#include "hide.glsl"
#include "segments.glsl"

layout(std430, binding = 4) readonly buffer Counters { uint counters[]; };
layout(std430, binding = 5) buffer Segments { Segment segments[]; };

void main() {
    uint i = dp_item() / 2u, end = dp_item() % 2u, hider;
    if (i >= min(counters[1], picture.counts.w) || segments[i].hider[end] == ENDS) return;
    Segment s = segments[i];
    vec3 along = (s.b - s.a) / float(s.k1 - s.k0); // from one sample point to the next, a quarter of a pixel
    for (float step = 0.5, found = 0.0; step < 8.0 && found == 0.0; step += 1.25) {
        vec3 at = end == 0u ? s.a - along * step : s.b + along * step;
        if (!is_hidden(query_of(at.xy, limit_at(double(at.z)) + depth_steps(at.z, 0.1), s.triangle, s.other),
                       hider))
            hider = NONE;
        found = hider == NONE ? 0.0 : 1.0;
    }
    segments[i].hider[end] = hider;
}
