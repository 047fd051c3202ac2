// Reading the G-buffer (gbuffer.h).
#include "shading.glsl"

uniform sampler2D g_geometry;
uniform usampler2D g_what;
uniform sampler2D g_base;
uniform sampler2D g_other;
uniform sampler2D g_texcoord;

vec4 geometry_at(ivec2 p) { return texelFetch(g_geometry, p, 0); } // normal, distance
uvec2 what_at(ivec2 p) { return texelFetch(g_what, p, 0).xy; }
uint id_of(uvec2 what) { return what.y & 0xffffu; } // 1 + group; 0: no surface
uint share_of(uvec2 what) { return what.y >> 16; }  // of 255
vec4 base_at(ivec2 p) { return texelFetch(g_base, p, 0); }
float other_at(ivec2 p) { return texelFetch(g_other, p, 0).x; }
vec2 texcoord_at(ivec2 p) { return texelFetch(g_texcoord, p, 0).xy; }
bool is_within(ivec2 p) {
    return all(greaterThanEqual(p, ivec2(0))) && all(lessThan(p, ivec2(picture.size.xy)));
}

// Distance of the surface, also of one in a partial pixel.
float surface_distance(ivec2 p) {
    float z = geometry_at(p).w;
    return z < FAR ? z : other_at(p);
}
