// Polar texture coordinates and stroke textures (Hermosilla and Vázquez 2010, 2.3.3; texture/texture.c).

// The centre of the model on the screen, and what repeats around it: fins_centre.comp.
layout(std430, binding = 5) readonly buffer Centre {
    vec2 centre; // px
    float half_height, k;
    float repeats[2]; // silhouettes, borders
    uint box[6];
};

#ifdef COLOURED // colours times ink; ink
#define INK_OF(t) (t).a
#else
#define INK_OF(t) (t).r
#endif
uniform sampler2D stroke, border_stroke;

// Within 1e-7: by the tangent of an eighth of a turn less, and a polynomial that meets atan(z) / z at six Chebyshev nodes.
float arc_tangent(float z) { // 0 to 1
    bool high = z > 0.41421356;
    float t = high ? (z - 1.0) / (z + 1.0) : z, s = t * t;
    float p = t * (1.0 +
                   s * (-0.33333307 +
                        s * (0.19998183 +
                             s * (-0.14239533 + s * (0.10569829 + s * -0.06026305)))));
    return high ? 0.78539816 + p : p;
}
// The angle in turns, [0, 1).
float turns_of(vec2 p) {
    vec2 a = abs(p);
    float most = max(a.x, a.y);
    float angle = most > 0.0 ? arc_tangent(min(a.x, a.y) / most) : 0.0;
    if (a.y > a.x) angle = 1.57079633 - angle;
    float turns = angle * 0.15915494;
    if (p.x < 0.0) turns = 0.5 - turns;
    if (p.y < 0.0) turns = 1.0 - turns;
    return turns;
}

float polar_u(vec2 at, uint line) {
    vec2 p = (at - centre) / half_height;
    return (turns_of(vec2(p.x, -p.y)) + k * length(p)) * repeats[line == 0u ? 0 : 1];
}

#ifdef EXACT_LOOKUPS // by four texels in float32, as the CPU does, instead of by the texture unit
vec4 look_up(sampler2D image, vec2 uv) {
    ivec2 size = textureSize(image, 0);
    vec2 at = uv * vec2(size) - 0.5, from = floor(at), share = at - from;
#ifdef LOOKUP_STEPS // as a unit with that many steps between texels would
    share = floor(share * LOOKUP_STEPS + 0.5) / LOOKUP_STEPS;
#endif
    ivec2 low = ivec2(from), high = low + 1;
    low.x = low.x < 0 ? size.x - 1 : low.x;
    high.x = high.x < size.x ? high.x : 0;
    low.y = max(low.y, 0);
    high.y = min(high.y, size.y - 1);
    return mix(mix(texelFetch(image, low, 0), texelFetch(image, ivec2(high.x, low.y), 0), share.x),
               mix(texelFetch(image, ivec2(low.x, high.y), 0), texelFetch(image, high, 0), share.x),
               share.y);
}
#else
vec4 look_up(sampler2D image, vec2 uv) { return textureLod(image, uv, 0.0); }
#endif

vec4 stroke_texel(uint line, float u, float v) {
    vec2 uv = vec2(fract(u), clamp(v, 0.0, 1.0));
    return line == 0u ? look_up(stroke, uv) : look_up(border_stroke, uv);
}
