// An added polygon that the depth test leaves: 1 + its class.
//
// The device rounds corners to 1/256 px. A sample that truly lies on the polygon's side of its edge may be on the other
// side so, where its quad, which begins at the edge, is on the wrong side of the neighbour's plane: an inked dot on a
// smooth surface. Such samples are left out.
#include "picture.glsl"
#include "ids.glsl"

layout(location = 0) out uint ink;
flat in uint line;
flat in vec3 outward;

void main() {
    int samples = 0;
    for (int i = 0; i < SAMPLES; i++) {
        vec2 p = floor(gl_FragCoord.xy) + place_of(i);
        if (dot(outward.xy, p) + outward.z >= 0.0) samples |= 1 << i;
    }
#if SAMPLES > 1
    gl_SampleMask[0] = samples;
#endif
    if (samples == 0) discard;
    ink = (line & 7u) + 1u;
}
