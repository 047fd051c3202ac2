// Hatching and halftoning: a texture of priorities and a smooth threshold (Freudenberg et al. 2002), as shade/hatch.inc does.
// Texels are fetched and mixed here: the device's filtering has eight bits, which the threshold would show.
uniform sampler2D g_strokes;

#ifdef ANCHORED
layout(std430, binding = 5) readonly buffer Anchors { float anchors[]; }; // [axis][u or v][exponent]
#endif

const float SHARPNESS = 5.0, TEXELS_PER_PX = 1.0;

float texel(ivec2 at) { return floor(texelFetch(g_strokes, at, 0).x * 255.0 + 0.5); }

// Bilinear, wrapped; in texels.
float stroke_at(vec2 uv) {
    vec2 size = shading.strokes.xy, whole = floor(uv);
    vec2 within = min(max(whole - size * floor(whole / size), 0.0), size - 1.0), part = uv - whole;
    ivec2 low = ivec2(within),
          high = ivec2(within.x < size.x - 1.0 ? low.x + 1 : 0, within.y < size.y - 1.0 ? low.y + 1 : 0);
    float top = texel(low), under = texel(ivec2(low.x, high.y));
    float a = top + part.x * (texel(ivec2(high.x, low.y)) - top),
          b = under + part.x * (texel(high) - under);
    return (a + part.y * (b - a)) * (1.0 / 255.0);
}

float stroke_power(vec2 uv, float power, int axis) {
    vec2 at = uv * power;
#ifdef ANCHORED
    int exponent = int(floatBitsToUint(power) >> 23 & 255u);
    if (axis >= 0) at += vec2(anchors[axis * 512 + exponent], anchors[axis * 512 + 256 + exponent]);
#endif
    return stroke_at(at);
}

// Strokes of constant width: about `texels` texels per unit, by the two powers of two around it.
float stroke_scaled(vec2 uv, float texels, int axis) {
    float wanted = min(max(texels, 1e-30), 1e30), low = uintBitsToFloat(floatBitsToUint(wanted) & 0x7f800000u);
    float fine = stroke_power(uv, low, axis), coarse = stroke_power(uv, low + low, axis);
    return fine + (coarse - fine) * (wanted / low - 1.0);
}

vec3 to_world(vec3 v) {
    return shading.rotation[0].xyz * v.x + shading.rotation[1].xyz * v.y + shading.rotation[2].xyz * v.z;
}

// Along the axes nearest to the normal; `texels` per world unit.
float stroke_on_axes(ivec2 p, vec3 n, float z, float texels) {
    vec2 r = ray_of(p) * (is_perspective() ? z : 1.0);
    vec3 place = shading.eye.xyz + to_world(vec3(r, -z)), share = to_world(n);
    share = share * share * share;
    share = share * share;
    share /= share.x + share.y + share.z;
    float value = 0.0;
    for (int k = 0; k < 3; k++) {
        if (!(share[k] > 0.02)) continue;
        float u = place[(k + 1) % 3], v = place[(k + 2) % 3];
        vec2 uv = vec2(0.8 * u + 0.6 * v, 0.8 * v - 0.6 * u); // no axis lies along strokes
        value += share[k] * stroke_scaled(uv, texels, k);
    }
    return value;
}

#ifdef TEXTURED
// Texture units per px, least over the neighbours of the same group; 0: unknown.
float texture_step(ivec2 p) {
    vec2 own = texcoord_at(p);
    float most = 0.0;
    if (own.x >= NO_TEXCOORD) return 0.0;
    for (int k = 0; k < 4; k++) {
        ivec2 q = p + (k < 2 ? ivec2(1 - 2 * k, 0) : ivec2(0, 5 - 2 * k));
        if (!is_within(q) || id_of(what_at(q)) != id_of(what_at(p))) continue;
        vec2 to = texcoord_at(q) - own;
        float away = length(to);
        if (texcoord_at(q).x < NO_TEXCOORD && away > 0.0 && (most <= 0.0 || away < most)) most = away;
    }
    return most;
}
#endif

float stroke_on_surface(ivec2 p, vec3 n) {
    float wanted = TEXELS_PER_PX / shading.strokes.z, z = surface_distance(p),
          px = (is_perspective() ? z : 1.0) / shading.lens.w;
#ifdef TEXTURED
    float along = texture_step(p);
    if (along > 1e-12) return stroke_scaled(texcoord_at(p), wanted / along, -1);
#endif
    return stroke_on_axes(p, n, z, wanted / px);
}

// On the screen, turned by 37 degrees.
float stroke_on_screen(ivec2 p) {
    float scale = TEXELS_PER_PX / shading.strokes.z, c = 0.8 * scale, s = 0.6 * scale;
    return stroke_at(vec2(c * float(p.x) + s * float(p.y), c * float(p.y) - s * float(p.x)));
}

float ink_at(ivec2 p, vec3 n, float n_l) {
    float priority = shading.strokes.w > 0.0 ? stroke_on_surface(p, n) : stroke_on_screen(p);
    float lit = 0.35 * n_l + 0.65 * max(n_l, 0.0) + 0.12, tone = min(0.08 + 0.98 * max(lit, 0.0), 1.2);
    float ink = min(max(0.5 + SHARPNESS * (priority - tone), 0.0), 1.0);
    return priority > 0.0 ? ink * shading.ink.a : 0.0;
}
