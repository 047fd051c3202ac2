// Shading: G-buffer → colours, as src/shade does (which has the papers). STYLE: number of dp_shading; TEXTURED,
// ANCHORED: what strokes on the surface have.
#include "gbuffer.glsl"

layout(location = 0) out vec4 color;

// Phong's, strength (r·v)^50 towards white.
vec3 add_highlight(vec3 c, vec3 n, ivec2 p) {
    float strength = shading.light.w, twice = 2.0 * dot(n, shading.light.xyz);
    if (strength <= 0.0 || twice <= 0.0) return c;
    vec2 v = is_perspective() ? -ray_of(p) : vec2(0.0);
    vec3 r = twice * n - shading.light.xyz;
    float k = max((r.x * v.x + r.y * v.y + r.z) / sqrt(v.x * v.x + v.y * v.y + 1.0), 0.0);
    float k2 = k * k, k4 = k2 * k2, k8 = k4 * k4, k16 = k8 * k8;
    return c + (1.0 - c) * min(strength * (k16 * k16 * k16 * k2), 1.0);
}

#if STYLE == 4
layout(std430, binding = 4) readonly buffer Shades { uint shades[]; }; // R, G, B, A from the lowest byte on
const float TIE = 1e-4; // shades: faces that lie on the border of two take the lighter one
vec3 toon(float n_l) {
    float count = float(shading.counts.x), at = (0.5 + 0.5 * n_l) * count + TIE;
    uint c = shades[uint(min(max(at, 0.0), count - 1.0))];
    return vec3(c & 255u, c >> 8 & 255u, c >> 16 & 255u) * (1.0 / 255.0);
}
#endif

#if STYLE == 5 || STYLE == 6
#include "strokes.glsl"
#endif

void main() {
    ivec2 p = ivec2(gl_FragCoord.xy);
    uint id = id_of(what_at(p));
    color = vec4(0.0);
    if (id == 0u) return;
    color = base_at(p);
    vec3 n = geometry_at(p).xyz;
    float n_l = dot(n, shading.light.xyz);
#if STYLE == 2
    color.rgb = add_highlight(color.rgb * (0.3 + 0.7 * max(n_l, 0.0)), n, p);
#elif STYLE == 3
    vec4 g = shading.gooch;
    vec3 cool = vec3(0.0, 0.0, g.x) + g.z * GOOCH_KD, warm = vec3(g.yy, 0.0) + g.w * GOOCH_KD;
    color.rgb = add_highlight(clamp(cool + (warm - cool) * (0.5 + 0.5 * n_l), 0.0, 1.0), n, p);
#elif STYLE == 4
    color.rgb = add_highlight(color.rgb * toon(n_l), n, p);
#elif STYLE == 5 || STYLE == 6
    color.rgb = mix(color.rgb, shading.ink.rgb, ink_at(p, n, n_l));
#endif
}
