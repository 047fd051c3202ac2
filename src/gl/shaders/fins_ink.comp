// The ink of a pixel's samples where it is before the surface, over the picture.
#define COMPUTE_PIXELS
#include "picture.glsl"

#if SAMPLES > 1
uniform usampler2DMS ink;
uniform sampler2DMS ink_depths, depths;
#else
uniform usampler2D ink;
uniform sampler2D ink_depths, depths;
#endif
layout(rgba8, binding = 0) uniform image2D shown;

// The operator `over`, not premultiplied, 8 bits a channel (core/blend.h).
vec4 over(vec3 color, float source, vec4 pixel) {
    float alpha = source + pixel.a * (1.0 - source);
    if (!(alpha > 0.0)) return pixel;
    return vec4((color * source + pixel.rgb * pixel.a * (1.0 - source)) / alpha, alpha);
}

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (p.x >= int(picture.size.x) || p.y >= int(picture.size.y)) return;
    vec4 sum = vec4(0.0);
    for (int i = 0; i < SAMPLES; i++) {
        uint c = texelFetch(ink, p, i).x;
        if (c == 0u || !(texelFetch(ink_depths, p, i).x > texelFetch(depths, p, i).x)) continue;
        float alpha = float(c & 0xFFu) / 255.0;
        sum += vec4(alpha * vec3(float(c >> 24), float(c >> 16 & 0xFFu), float(c >> 8 & 0xFFu)), alpha);
    }
    if (!(sum.a > 0.0)) return;
    vec3 color = floor(sum.rgb / sum.a + 0.5) / 255.0;
    imageStore(shown, p, over(color, sum.a / float(SAMPLES), imageLoad(shown, p)));
}
