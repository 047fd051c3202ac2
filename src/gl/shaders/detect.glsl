// What detectors of edges read (Nienhaus and Döllner 2003, 4.1.2): the samples around a pixel, at the picture's border repeated.
//
//    A B C        AS_PRINTED   differences of distance between near and far; else of depth, in px sizes, minus the slope's
//    D X E        EIGHT_BITS   the G-buffer rounded to 8 bits a channel, as the paper's textures are
//    F G H
#include "gbuffer.glsl"

#if defined(AS_PRINTED) || defined(EIGHT_BITS)
layout(std430, binding = 4) readonly buffer Range { uint range_bits[2]; }; // near, far: as range.comp has them
float from_order(uint u) { return uintBitsToFloat((u & 0x80000000u) != 0u ? u ^ 0x80000000u : ~u); }
vec2 near_far() {
    float near = from_order(range_bits[0]), far = from_order(range_bits[1]);
    if (range_bits[0] > range_bits[1]) return vec2(0.0, 1.0); // nothing is enhanced
    return vec2(near, far > near ? far : near + 1.0);
}
#endif

ivec2 clamped(ivec2 p) { return clamp(p, ivec2(0), ivec2(picture.size.xy) - 1); }

#ifdef EIGHT_BITS
vec4 to_steps(vec4 v) { return floor(clamp(v, 0.0, 1.0) * 255.0 + 0.5) * (1.0 / 255.0); }
#endif

// Normal and distance.
vec4 stored_at(ivec2 at) {
    ivec2 p = clamped(at);
    vec4 g = geometry_at(p);
#ifdef EIGHT_BITS
    if (what_at(p).x == 0u) return g;
    vec2 range = near_far();
    vec4 t = to_steps(vec4(g.xyz * 0.5 + 0.5, (g.w - range.x) * (1.0 / (range.y - range.x))));
    g = vec4(2.0 * t.xyz - 1.0, g.w < FAR ? range.x + (range.y - range.x) * t.w : g.w);
#endif
    return g;
}
// What differences are taken of.
float measure_at(vec4 stored) {
#ifdef AS_PRINTED
    return stored.w;
#else
    return depth_of(stored.w);
#endif
}
