// Lays classes of lines over the picture, from the bottom up: `over` (Porter and Duff 1984). It is premultiplied
// meanwhile, and rounded once, where core/blend.h rounds after each class: half a step less exact for each more.
#include "picture.glsl"

layout(binding = 0, rgba8) uniform image2D inked;
uniform sampler2D coverage0, coverage1;

const uint LAYERS[5] = uint[5](VALLEY, INTERSECTION, RIDGE, BORDER, SILHOUETTE); // dp_layers

void main() {
    ivec2 p = ivec2(gl_FragCoord.xy);
    vec4 share[2] = vec4[2](texelFetch(coverage0, p, 0),
                            draws(BORDER) ? texelFetch(coverage1, p, 0) : vec4(0.0));
    if (share[0] == vec4(0.0) && share[1] == vec4(0.0)) discard;
    vec4 under = imageLoad(inked, p);
    under.rgb *= under.a;
    for (int i = 0; i < 5; i++) {
        vec4 c = picture.colors[LAYERS[i]];
        float s = share[LAYERS[i] / 4u][LAYERS[i] % 4u] * c.a;
        under = vec4(c.rgb, 1.0) * s + under * (1.0 - s);
    }
    if (under.a > 0.0) under.rgb /= under.a;
    imageStore(inked, p, under);
}
