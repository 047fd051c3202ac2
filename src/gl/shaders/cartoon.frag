// The cartoon map (Nienhaus and Döllner 2003, 5): each pixel becomes the mean of itself and its neighbours of the same
// surface, as shade/cartoon_map.c does.
#include "gbuffer.glsl"

uniform sampler2D colors;
layout(location = 0) out vec4 color;

const float STEP = 12.0; // px sizes between neighbours of one surface

uvec3 bytes_at(ivec2 p) { return uvec3(texelFetch(colors, p, 0).rgb * 255.0 + 0.5); }

void main() {
    ivec2 p = ivec2(gl_FragCoord.xy);
    uint id = id_of(what_at(p));
    color = texelFetch(colors, p, 0);
    if (id == 0u || id == MIRROR_ID) return; // the mirror's picture is smooth already
    float z = geometry_at(p).w, near = STEP * (is_perspective() ? z : 1.0) / shading.lens.w;
    uvec3 sum = uvec3(0u);
    uint total = 0u;
    for (int y = -1; y <= 1; y++)
        for (int x = -1; x <= 1; x++) {
            ivec2 q = p + ivec2(x, y);
            if (!is_within(q) || id_of(what_at(q)) != id || abs(geometry_at(q).w - z) > near) continue;
            uint weight = (x == 0 ? 2u : 1u) * (y == 0 ? 2u : 1u);
            sum += weight * bytes_at(q);
            total += weight;
        }
    color.rgb = vec3((sum + total / 2u) / total) / 255.0;
}
