// Intensities of discontinuity, I_N and I_Z (Nienhaus and Döllner 2003, 4.1.2), as gbuffer/diagonal.inc and c1.inc have them.
//
//    C1_PASS undefined    first variant: both, from four diagonal samples
//    C1_PASS 0, 1, 2      second variant: pass 0 gives I_N as before and A, B, C; 1: D, E; 2: F, G, H; what it adds to
//                         I_Z, blended
#include "detect.glsl"

layout(location = 0) out vec2 intensity;

#ifdef AS_PRINTED
float per_px(float x) { return 1.0 / (near_far().y - near_far().x); }
#else
float per_px(float x) { return shading.measure.x / (is_perspective() ? x : 1.0); }
#endif

float together(float a, float b) {
    float p = 1.0 - 0.5 * a, q = 1.0 - 0.5 * b;
    return p * p * (q * q);
}

// What the slope does not explain of a pair's difference; `second` tells the side of the step.
float unexplained(float p, float x, float q, float scale, out float second) {
    second = p + q - 2.0 * x;
    float first = min(abs(p - x), abs(q - x));
    return max(min((abs(second) - 1.75 * first) * scale * 1.5 - 0.5, 1.0), 0.0);
}

vec2 diagonal(ivec2 p, int r) {
    vec4 a = stored_at(p + ivec2(-r, -r)), c = stored_at(p + ivec2(r, -r)), f = stored_at(p + ivec2(-r, r)),
         h = stored_at(p + ivec2(r, r));
    float ah = dot(a.xyz, h.xyz), cf = dot(c.xyz, f.xyz);
#ifdef AS_PRINTED
    float scale = per_px(0.0);
    return vec2(0.5 * (ah + cf),
                together(min(scale * abs(a.w - h.w), 1.0), min(scale * abs(c.w - f.w), 1.0)));
#else
    float x = measure_at(stored_at(p)), scale = per_px(x), far = shading.measure.y, side_ah, side_cf;
    float step_ah = unexplained(measure_at(a), x, measure_at(h), scale, side_ah);
    float step_cf = unexplained(measure_at(c), x, measure_at(f), scale, side_cf);
    return vec2(1.0 - 0.5 * ((1.0 - ah) * (1.0 - step_ah) + (1.0 - cf) * (1.0 - step_cf)),
                together(step_ah * (side_ah < 0.0 ? 1.0 : far), step_cf * (side_cf < 0.0 ? 1.0 : far)));
#endif
}

#ifdef C1_PASS
// The surface's slope, px sizes per px, from its normal.
float slope_at(ivec2 p) {
    vec3 n = stored_at(p).xyz;
    vec2 r = is_perspective() ? ray_of(p) : vec2(0.0);
    float along = n.z - n.x * r.x - n.y * r.y, c = max(along / sqrt(1.0 + dot(r, r)), 1e-4);
    return sqrt(max(1.0 - c * c, 0.0)) / c;
}

float difference(float neighbour, float x, float scale, float slope) {
#ifdef AS_PRINTED
    return min(scale * abs(neighbour - x), 1.0);
#else
    float d = x - neighbour; // behind: positive
    return max(min(max(d, -shading.measure.y * d) * scale - slope, 1.0), 0.0);
#endif
}

float c1(ivec2 p, int r) {
    ivec2 row = ivec2(0, (C1_PASS - 1) * r), aside = ivec2(r, 0);
    float x = measure_at(stored_at(p)), scale = per_px(x);
    float slope = slope_at(p) * shading.measure.w;
    float left = difference(measure_at(stored_at(p + row - aside)), x, scale, slope),
          right = difference(measure_at(stored_at(p + row + aside)), x, scale, slope);
#if C1_PASS == 1
    return 0.25 * left + 0.25 * right;
#else
    return 0.125 * left + 0.25 * difference(measure_at(stored_at(p + row)), x, scale, slope) +
           0.125 * right;
#endif
}
#endif

void main() {
    ivec2 p = ivec2(gl_FragCoord.xy);
    int r = int(shading.counts.y);
    intensity = vec2(1.0, 0.0);
    if (what_at(p).x == 0u) return;
#ifndef C1_PASS
    intensity = diagonal(p, r);
#else
    intensity = vec2(C1_PASS == 0 ? diagonal(p, r).x : 0.0, c1(p, r));
#endif
}
