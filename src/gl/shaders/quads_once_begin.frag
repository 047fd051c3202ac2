// Before the pass: nothing, or what the application has drawn.
#include "picture.glsl"
#include "ids.glsl"
#define STATE_ACCESS writeonly
#include "quads_state.glsl"
void main() {
    ivec2 p = ivec2(gl_FragCoord.xy);
    for (int i = 0; i < SAMPLES; i++)
        states[place_in_states(p, i)] =
            id_at(p, i) == ID_FOREIGN ? state_of(min(depth_at(p, i), 0.99999994), 0u) : 0u;
}
