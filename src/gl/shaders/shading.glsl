// What all passes of shading know; shading.h has the same in C (dp_gl_shading_block).
#include "picture.glsl"

layout(std140, binding = 2) uniform Shading {
    vec4 lens;        // cx, cy, fx, fy: the ray of pixel (x, y) is ((x - cx) / fx, (cy - y) / fy, -1), camera space
    vec4 rotation[3]; // rows: world to camera space
    vec4 eye;
    vec4 light; // xyz: towards it, camera space, unit; w: highlight
    vec4 gooch; // blue, yellow, alpha, beta
    vec4 ink;
    vec4 base; // the surface's colour, where nothing else has one
    vec4 inner, profile;
    vec4 strength; // inner: threshold and scale; profile: the same
    vec4 measure;  // scale of differences of depth; sides; profile_depth; slope of C1
    vec4 strokes;  // texture's width and height; scale; 1: on the surface
    uvec4 counts;  // shades, radius of the detector, enhanced groups, is anchored
} shading;

const float FAR = 1e30; // distance of the background: beyond everything, and finite
const float NO_TEXCOORD = 1e30;
const uint MIRROR_ID = 65535u; // 1 + DP_MIRROR_GROUP

float empty_depth() { return is_perspective() ? 0.0 : -FAR; }
// Distance of depth d, and back.
float distance_of(float d) { return is_perspective() ? 1.0 / d : -d; }
float depth_of(float distance) {
    return distance < FAR ? (is_perspective() ? 1.0 / distance : -distance) : empty_depth();
}
// Through the pixel's centre, at distance 1, or towards -z in orthographic views.
vec2 ray_of(ivec2 p) {
    vec2 q = vec2(p) + 0.5;
    return vec2(q.x - shading.lens.x, shading.lens.y - q.y) / shading.lens.zw;
}
