// Before the pass: nothing, or what the application has drawn.
#include "picture.glsl"
#include "ids.glsl"
#define STATE_ACCESS writeonly
#include "quads_state.glsl"
#if SAMPLES > 1
uniform sampler2DMS depths;
#else
uniform sampler2D depths;
#endif
void main() {
    ivec2 p = ivec2(gl_FragCoord.xy);
    for (int i = 0; i < SAMPLES; i++)
        states[place_in_states(p, i)] =
            id_at(p, i) == ID_FOREIGN ? state_of(min(texelFetch(depths, p, i).x, 0.99999994), 0u) : 0u;
}
