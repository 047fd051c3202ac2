// The last pass: pixels that several surfaces share mix their colour with that of the neighbour that the rest belongs to, or
// with the paper, as shade/compose.c does.
#include "gbuffer.glsl"
#include "ids.glsl"
#ifdef EIGHT_BITS // distances have been rounded by now
#include "detect.glsl"
#else
vec4 stored_at(ivec2 p) { return geometry_at(p); }
#endif

uniform sampler2D shown;
layout(location = 0) out vec4 color;

// The paper, but for what the application's own things cover of it.
vec4 background(ivec2 p) {
    vec4 c = picture.paper;
#ifdef FOREIGN
    float foreign = 0.0, none = 0.0;
    for (int i = 0; i < SAMPLES; i++) {
        uint id = id_at(p, i);
        foreign += id == ID_FOREIGN ? 1.0 : 0.0;
        none += is_triangle(id) ? 0.0 : 1.0;
    }
    if (none > 0.0) c.a *= 1.0 - foreign / none;
#endif
    return c;
}

uvec4 bytes_of(vec4 c) { return uvec4(c * 255.0 + 0.5); }

// The colour of what covers the rest of a pixel.
vec4 other_color(ivec2 p, float other) {
    ivec2 best = p;
    float least = 1e38;
    for (int y = -1; y <= 1; y++)
        for (int x = -1; x <= 1; x++) {
            ivec2 q = p + ivec2(x, y);
            if ((x == 0 && y == 0) || !is_within(q) || id_of(what_at(q)) == 0u) continue;
            float away = abs(stored_at(q).w - other);
            if (!(away < least)) continue;
            least = away;
            best = q;
        }
    return texelFetch(shown, best, 0);
}

vec4 mix_colors(uvec4 a, uvec4 b, uint share) {
    uint wa = share * a.a, wb = (255u - share) * b.a, sum = wa + wb;
    if (sum == 0u) return vec4(b) / 255.0;
    return vec4((wa * a.rgb + wb * b.rgb + sum / 2u) / sum, (sum + 127u) / 255u) / 255.0;
}

void main() {
    ivec2 p = ivec2(gl_FragCoord.xy);
    uvec2 what = what_at(p);
    color = background(p);
    if (id_of(what) == 0u) return;
    color = texelFetch(shown, p, 0);
    if (share_of(what) == 255u) return;
    float other = other_at(p);
    bool on_paper = other >= FAR || geometry_at(p).w >= FAR;
    color = mix_colors(bytes_of(color), bytes_of(on_paper ? background(p) : other_color(p, other)), share_of(what));
}
