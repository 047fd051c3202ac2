// The second pass over the model (Nienhaus and Döllner 2003, 4, "Using the Edge Map"): the edge map, and what was shaded,
// are projected onto its polygons from the camera, and inner edges, then profile edges, laid over the shades.
//
// A polygon's fragment is drawn where the G-buffer says that its pixel shows the polygon.
#include "gbuffer.glsl"

uniform sampler2D edge_map, colors;
layout(rgba8, binding = 0) writeonly uniform image2D edged;
flat in uint triangle;
in vec4 projected;

vec4 lay(vec4 under, vec4 edge, float strength) {
    float s = strength * edge.a, alpha = s + under.a * (1.0 - s);
    if (!(s > 0.0)) return under;
    vec4 c = vec4((edge.rgb * s + under.rgb * under.a * (1.0 - s)) / alpha, alpha);
    return floor(c * 255.0 + 0.5) / 255.0;
}

void main() {
    ivec2 p = ivec2(gl_FragCoord.xy);
    if (what_at(p).x != triangle + 1u) return;
    vec4 strength = 1.0 - textureProj(edge_map, projected.xyw), c = textureProj(colors, projected.xyw);
    c = lay(lay(c, shading.inner, strength.r), shading.profile, strength.a);
    imageStore(edged, p, c);
}
