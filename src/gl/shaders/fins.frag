// Pixel shader of (Hermosilla and Vázquez 2010, Listing 2.3): tells the surface, whose v is 2, from silhouettes, which take their
// ink from the texture. Out comes, of the surface, 1 + triangle; of silhouettes, the ink's colour.
#include "picture.glsl"

#ifdef TEXTURED
#include "stroke_texture.glsl"
#define PER_SAMPLE sample
#else
#define PER_SAMPLE
#endif
PER_SAMPLE in vec3 place;
flat in uint what;

layout(location = 0) out uint value;

const float LEAST_INK = 0.1; // fragments with less are discarded (Listing 2.3)

uint to_byte(float c) { return uint(c * 255.0 + 0.5); }

void main() {
    if (place.z > 1.5) {
        value = what;
        return;
    }
    vec4 color = picture.colors[what];
#ifdef TEXTURED
    vec4 texel = stroke_texel(what, polar_u(place.xy, what), place.z);
    float ink = INK_OF(texel);
    if (ink < LEAST_INK) discard;
#ifdef COLOURED
    color.rgb = min(texel.rgb / ink, vec3(1.0));
#endif
    color.a *= ink;
#endif
    value = to_byte(color.r) << 24 | to_byte(color.g) << 16 | to_byte(color.b) << 8 |
            to_byte(color.a);
    if (value == 0u) discard;
}
