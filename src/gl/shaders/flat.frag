// Surfaces in one colour each, without light: the mean of a pixel's samples.
#include "scene.glsl"
#include "ids.glsl"
#include "colors.glsl"

layout(location = 0) out vec4 color;

void main() {
    ivec2 p = ivec2(gl_FragCoord.xy);
    vec4 sum = vec4(0.0); // premultiplied
    for (int i = 0; i < SAMPLES; i++) {
        uint id = id_at(p, i);
        vec4 c = is_triangle(id) ? surface_color(id - 1u) : paper_color(id);
        sum += vec4(c.rgb * c.a, c.a);
    }
    sum /= float(SAMPLES);
    color = sum.a > 0.0 ? vec4(sum.rgb / sum.a, sum.a) : vec4(picture.paper.rgb, 0.0);
}
