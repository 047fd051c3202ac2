// The edge map from intensities of discontinuity, as gbuffer/edge_map.c makes it: inner edges in RGB, profile edges in A, 1 where
// there is none (Nienhaus and Döllner 2003, 4.1.2). C1: I_Z is what three passes have added up. GROUPS: edges where groups meet.
#include "detect.glsl"

uniform sampler2D intensities;
layout(location = 0) out vec4 edges;

#ifdef CHOSEN
layout(std430, binding = 5) readonly buffer Enhanced { uint enhanced[]; };
#endif

// Does a neighbour of another group lie behind, or level with a smaller number?
bool meets_group(ivec2 p, uint id, float z, int r) {
    float px = (is_perspective() ? z : 1.0) / shading.lens.w * shading.measure.z;
    for (int k = 0; k < 4; k++) {
        ivec2 q = clamped(p + r * ivec2((k & 1) * 2 - 1, (k & 2) - 1));
        uint other = id_of(what_at(q));
        if (other == id) continue;
        float behind = stored_at(q).w - z;
#ifdef FAR_SIDE
        return true;
#endif
        if (behind > px || (behind > -px && other < id)) return true;
    }
    return false;
}

void main() {
    ivec2 p = ivec2(gl_FragCoord.xy);
    uint id = id_of(what_at(p));
    edges = vec4(1.0);
    if (id == 0u) return;
#ifdef CHOSEN
    if (id > shading.counts.z || enhanced[id - 1u] == 0u) return;
#endif
    vec2 i = texelFetch(intensities, p, 0).xy;
#ifdef C1
    i.y = 1.0 - min((WHOLE) * i.y, 1.0);
#endif
    vec4 t = shading.strength;
    float z = stored_at(p).w;
    vec2 s = clamp((1.0 - i - t.xz) * t.yw, 0.0, 1.0);
    if (z >= FAR) s = vec2(0.0, 1.0); // a partial pixel is outline
#ifdef GROUPS
    if (meets_group(p, id, z, int(shading.counts.y))) s.y = 1.0;
#endif
    edges = 1.0 - s.xxxy;
}
