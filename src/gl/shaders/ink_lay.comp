// Lays classes of lines over the picture, from the bottom up, in 8 bits a channel as core/blend.h does.
#define COMPUTE_PIXELS
#include "picture.glsl"
#include "over.glsl"

layout(binding = 0, rgba8) uniform image2D inked;
uniform sampler2D coverage0, coverage1;

const uint LAYERS[5] = uint[5](VALLEY, INTERSECTION, RIDGE, BORDER, SILHOUETTE); // dp_layers

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (p.x >= int(picture.size.x) || p.y >= int(picture.size.y)) return;
    vec4 share[2] = vec4[2](texelFetch(coverage0, p, 0),
                            draws(BORDER) ? texelFetch(coverage1, p, 0) : vec4(0.0));
    if (share[0] == vec4(0.0) && share[1] == vec4(0.0)) return;
    vec4 under = imageLoad(inked, p);
    for (int i = 0; i < 5; i++) {
        float s = share[LAYERS[i] / 4u][LAYERS[i] % 4u];
        if (s > 0.0) under = lay_over(under, picture.colors[LAYERS[i]], s);
    }
    imageStore(inked, p, under);
}
