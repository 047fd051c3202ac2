// The operator `over` (Porter and Duff 1984), not premultiplied, rounded to 8 bits a channel (core/blend.h).
vec4 lay_over(vec4 under, vec4 color, float coverage) {
    float source = coverage * color.a, alpha = source + under.a * (1.0 - source);
    if (!(alpha > 0.0)) return under;
    vec3 mixed = (color.rgb * source + under.rgb * under.a * (1.0 - source)) / alpha;
    return floor(vec4(mixed, alpha) * 255.0 + 0.5) / 255.0;
}
