// One pass over all polygons in the order in which they come, as printed (Raskar 2001, 2.3 and 2.4): what is nearest updates
// z1; a valley, or a face, that is not takes the between-test: z1 > d >= z2.
#ifdef GL_ARB_fragment_shader_interlock
#extension GL_ARB_fragment_shader_interlock : enable
#endif
#include "quads_surface.glsl"
#include "quads_records.glsl"
#define STATE_ACCESS coherent
#include "quads_state.glsl"
#ifdef GL_ARB_fragment_shader_interlock
layout(sample_interlock_ordered) in;
#endif

uniform uint intersections;
uniform vec4 traps; // of valleys, of intersections
flat in uint line, triangle;
flat in vec3 at;
flat in vec2 slope;
flat in float nearest;
flat in vec3 outward;

// A sample's state after this fragment. Nothing is trapped behind a line that stands before the surface.
uint after(uint old, uint mine, float d, bool face, bool may_be_trapped) {
    uint ink = ink_of_state(old), own = ink_of_state(mine);
    bool covered = ink == SILHOUETTE + 1u || ink == RIDGE + 1u || ink == BORDER + 1u;
    bool updates = (line & ADDED_VALLEY) == 0u;
    if (updates && mine >> 3 > old >> 3) return face ? mine & ~7u : mine;
    vec2 t = face ? traps.zw : traps.xy;
    float z2 = from_window(window_of_state(old)) * t.x + t.y;
    if (may_be_trapped && !covered && mine >> 3 < old >> 3 && d >= z2) return (old & ~7u) | own;
    return old;
}

void main() {
    vec2 p = sample_at();
    if (dot(outward.xy, p) + outward.z < 0.0) discard; // see quads_line.frag
    bool face = (line & ADDED_FACE) != 0u;
    float d = min(at.z + dot(slope, p - at.xy), nearest);
    uint mine = state_of(to_window(d), (line & ADDED_LINE) + 1u),
         place = place_in_states(ivec2(gl_FragCoord.xy), gl_SampleID);
    bool may_be_trapped = face ? intersections != 0u && faces_eye(triangle)
                               : (line & ADDED_VALLEY) != 0u;
#ifdef GL_ARB_fragment_shader_interlock
    beginInvocationInterlockARB();
    states[place] = after(states[place], mine, d, face, may_be_trapped);
    endInvocationInterlockARB();
#else
    uint old = states[place];
    for (int i = 0; i < 64; i++) {
        uint next = after(old, mine, d, face, may_be_trapped);
        if (next == old) break;
        uint was = atomicCompSwap(states[place], old, next);
        if (was == old) break;
        old = was;
    }
#endif
}
