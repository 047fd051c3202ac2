// The picture of the reflected scene as the mirror shows it: faded towards the paper as far as things stand from it, and tinted.
// FADES; EIGHT_BITS: distances are those of the rounded G-buffer.
#include "picture.glsl"
#ifdef FADES
#include "gbuffer.glsl"
#ifdef EIGHT_BITS
#include "detect.glsl"
#else
vec4 stored_at(ivec2 p) { return geometry_at(p); }
#endif
layout(std140, binding = 1) uniform Reflection {
    dvec4 placement[3];
    dvec4 plane;
};
uniform float fade; // world units
#endif

uniform sampler2D colors;
uniform vec4 tint; // w: its share
layout(location = 0) out vec4 color;

// How much of its image a point still has.
float left_at(ivec2 p) {
#ifdef FADES
    float z = stored_at(p).w;
    if (id_of(what_at(p)) == 0u || z >= FAR) return 0.0;
    dvec2 at = dvec2(p) + 0.5;
    dvec3 q = picture.corner.xyz + at.x * picture.across.xyz + at.y * picture.down.xyz;
    if (is_perspective())
        q = picture.eye.xyz + (q - picture.eye.xyz) * double(z);
    else
        q += (1.0 + double(z)) * picture.forward.xyz / length(picture.sight.xyz);
    return max(1.0 - float(abs(dot(plane.xyz, q) - plane.w)) / fade, 0.0);
#else
    return 1.0;
#endif
}

void main() {
    ivec2 p = ivec2(gl_FragCoord.xy);
    vec4 c = texelFetch(colors, p, 0), faded = picture.paper + (c - picture.paper) * left_at(p);
    color = faded + (vec4(tint.rgb, 1.0) - faded) * tint.w;
}
