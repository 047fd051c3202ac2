// Pixels of the mirror show the picture of the reflected scene.
#include "gbuffer.glsl"

uniform sampler2D colors;
layout(location = 0) out vec4 color;

void main() {
    ivec2 p = ivec2(gl_FragCoord.xy);
    if (id_of(what_at(p)) != MIRROR_ID) discard;
    color = texelFetch(colors, p, 0);
}
