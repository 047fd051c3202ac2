// What the application has drawn with the same camera hides what is behind it.
#include "picture.glsl"

#ifdef FOREIGN_SAMPLES
uniform sampler2DMS foreign;
#else
uniform sampler2D foreign;
#endif
uniform vec2 depth_range;
layout(location = 0) out uint id;

void main() {
    ivec2 p = ivec2(gl_FragCoord.xy);
    float z = texelFetch(foreign, ivec2(p.x, int(picture.size.y) - 1 - p.y), 0).x;
    if (z >= 1.0) discard; // the far plane: nothing
    // clip space: z_clip / w = 2 z - 1; along the axis, z_clip = a * distance + b and w = c * distance + e
    dvec3 s = picture.sight.xyz;
    double l = dot(s, s), a = dot(picture.clip[2].xyz, s) / l,
           b = picture.clip[2].w - a * picture.sight.w, c = dot(picture.clip[3].xyz, s) / l,
           e = picture.clip[3].w - c * picture.sight.w, n = double(z) * 2.0 - 1.0;
    double distance = (n * e - b) / (a - n * c);
    double d = is_perspective() ? 1.0 / distance : -distance;
    gl_FragDepth = clamp(float(d) * depth_range.x + depth_range.y, 0.0, 1.0);
    id = ID_FOREIGN;
}
