// One pass, as printed (Raskar 2001, 2.3): z1 and ink of each sample in one word, so that both change at once: 29 bits
// of the window's depth, and 1 + the class of line that is nearest, or 0.
#include "depths.glsl"
layout(std430, binding = 5) STATE_ACCESS buffer States { uint states[]; };

uint state_of(float window, uint ink) { return floatBitsToUint(window) >> 1 << 3 | ink; }
uint ink_of_state(uint s) { return s & 7u; }
float window_of_state(uint s) { return uintBitsToFloat(s >> 3 << 1); }
float to_window(float d) { return clamp(d * depth_range.x + depth_range.y, 0.0, 0.99999994); }
float from_window(float z) { return (z - depth_range.y) / depth_range.x; }
uint place_in_states(ivec2 pixel, int sample_) {
    return uint((pixel.y * int(picture.size.x) + pixel.x) * SAMPLES + sample_);
}
