// The picture, into the application's framebuffer, whose rows run from the bottom up.
#include "picture.glsl"
#include "ids.glsl"

uniform sampler2D shown;
uniform ivec2 from; // the picture's lower left corner in the framebuffer
// 0: all pixels; 1: those of which the application's own things cover nothing; 2: the others
uniform uint part;
layout(location = 0) out vec4 color;

bool is_covered(ivec2 p) {
    bool any = false;
    for (int i = 0; i < SAMPLES; i++) any = any || id_at(p, i) == ID_FOREIGN;
    return any;
}

void main() {
    ivec2 p = ivec2(gl_FragCoord.xy) - from;
    p.y = int(picture.size.y) - 1 - p.y;
    if (part != 0u && is_covered(p) != (part == 2u)) discard;
    color = texelFetch(shown, p, 0);
}
