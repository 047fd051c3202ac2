// The first pass: fills the G-buffer with one surface a pixel (Nienhaus and Döllner 2003, 4.1.1), as gbuffer/fill.c does.
//
//    FACETS      normals are the polygons' own
//    TEXTURED    there are texture coordinates
//    COLORED     groups or vertices have colours
#include "surface_pick.glsl"
#include "facing.glsl"
#include "shading.glsl"
#include "normals16.glsl"

layout(location = 0) out vec4 geometry;
layout(location = 1) out uvec2 what;
layout(location = 2) out vec4 base;
layout(location = 3) out float other;

#ifndef FACETS
layout(std430, binding = 3) readonly buffer Normals { uvec2 normals[]; };
#endif
#ifdef TEXTURED
layout(std430, binding = 4) readonly buffer TexCoords { vec2 texcoords[]; };
layout(location = 4) out vec2 texcoord;
#endif
#ifdef COLORED
layout(std430, binding = 5) readonly buffer Colors { uint vertex_colors[]; }; // none: one word
layout(std430, binding = 6) readonly buffer Groups { uint group_colors[]; };
uniform uint has_vertex_colors;
#endif

const float REACH = 8.0; // px sizes that a plane may differ in depth between a sample and the pixel's centre

bool is_clipped(uint t) {
    return is_off_screen(screen_of(corners[3u * t])) || is_off_screen(screen_of(corners[3u * t + 1u])) ||
           is_off_screen(screen_of(corners[3u * t + 2u]));
}

vec3 screen_weights(uint t, vec2 at) {
    vec3 e = max(areas_at(t, at), 0.0);
    if (!is_perspective()) return e;
    return e * vec3(screen_of(corners[3u * t]).z, screen_of(corners[3u * t + 1u]).z,
                    screen_of(corners[3u * t + 2u]).z);
}

// The place at (x, y, d) on the screen.
dvec3 unproject(vec2 at, float d) {
    dvec3 q = picture.corner.xyz + double(at.x) * picture.across.xyz + double(at.y) * picture.down.xyz;
    if (is_perspective()) return picture.eye.xyz + (q - picture.eye.xyz) / double(d);
    return q + (1.0 - double(d)) * picture.forward.xyz / length(picture.sight.xyz);
}

// The same in space, for a triangle with corners that are not on the screen.
vec3 space_weights(uint t, vec2 at, float d) {
    dvec3 q = unproject(at, d), n = area_normal(t);
    dvec3 a = dvec3(world_of(corners[3u * t])) - q, b = dvec3(world_of(corners[3u * t + 1u])) - q,
          c = dvec3(world_of(corners[3u * t + 2u])) - q;
    dvec3 e = dvec3(dot(cross(b, c), n), dot(cross(c, a), n), dot(cross(a, b), n));
    double sum = abs(e.x) + abs(e.y) + abs(e.z);
    return sum > 0.0 ? vec3(max(e, dvec3(0.0)) / sum) : vec3(0.0);
}

#ifndef FACETS
vec3 normal_of(uint corner) { return unpack_normal(normals[corner]); }
#endif

// 1 / sqrt(length2) where that lies between the bounds, else 0.
float inverse_length(float length2, float least, float most) {
    return length2 > least && length2 < most ? 1.0 / sqrt(length2) : 0.0;
}

// Unit, camera space, on the visible side: a normal that lies clearly on the other side contradicts the winding and is turned
// round. Where there is none, the polygon's, from its plane's gradient on the screen.
vec3 shading_normal(uint t, Plane plane, vec3 weights) {
    vec2 s = plane.slope;
    vec3 facet = vec3(-shading.lens.z * s.x, shading.lens.w * s.y,
                      is_perspective() ? plane_at(plane, shading.lens.xy) : 1.0);
    facet *= inverse_length(dot(facet, facet), 0.0, 1e38);
#ifdef FACETS
    return facet;
#else
    vec3 w = normal_of(3u * t) * weights.x + normal_of(3u * t + 1u) * weights.y +
             normal_of(3u * t + 2u) * weights.z;
    float unit = inverse_length(dot(w, w), 1e-30, 1e30);
    if (unit <= 0.0) return facet;
    if (!is_front(t)) w = -w;
    vec3 n = unit * vec3(dot(shading.rotation[0].xyz, w), dot(shading.rotation[1].xyz, w),
                         dot(shading.rotation[2].xyz, w));
    return dot(n, facet) < -0.25 ? -n : n;
#endif
}

// Depth of the plane at the pixel's centre, near the sample's, as planes seen edge-on are unbounded.
float centre_depth(uint t, Plane plane, Pick s, ivec2 p) {
    float nearest = NOTHING, away = depth_steps(s.d, REACH);
    for (uint k = 0u; k < 3u; k++) nearest = max(nearest, screen_of(corners[3u * t + k]).z);
    float most = is_clipped(t) ? s.d + away : min(s.d + away, max(nearest, s.d));
    return min(max(plane_at(plane, vec2(p) + 0.5), s.d - away), most);
}

#ifdef COLORED
vec4 bytes_of(uint c) { return vec4(c >> 24, c >> 16 & 255u, c >> 8 & 255u, c & 255u); }
vec4 color_of(uint t, vec3 weights) {
    vec4 own = bytes_of(group_colors[group_of(t)]) / 255.0;
    if (has_vertex_colors == 0u) return own;
    vec4 sum = vec4(0.0);
    for (uint k = 0u; k < 3u; k++) {
        uint c = vertex_colors[corners[3u * t + k]];
        if (c == 0u) return own;
        sum += weights[k] * bytes_of(c);
    }
    float all = weights.x + weights.y + weights.z;
    vec4 mixed = all > 0.0 ? floor(sum / all + 0.5) : vec4(0.0);
    return mixed == vec4(0.0) ? own : mixed / 255.0;
}
#endif

void put_nothing() {
    geometry = vec4(0.0, 0.0, 0.0, FAR);
    what = uvec2(0u);
    base = vec4(0.0);
    other = FAR;
#ifdef TEXTURED
    texcoord = vec2(NO_TEXCOORD);
#endif
}

#ifdef TEXTURED
vec2 texcoord_of(uint t, vec3 weights) {
    vec2 sum = vec2(0.0);
    float all = weights.x + weights.y + weights.z;
    for (uint k = 0u; k < 3u; k++) {
        vec2 c = texcoords[3u * t + k];
        if (c.x >= NO_TEXCOORD) return vec2(NO_TEXCOORD);
        sum += weights[k] * c;
    }
    return all > 0.0 ? sum / all : vec2(NO_TEXCOORD);
}
#endif

// A mixed pixel's rest. If most of it is paper, the pixel becomes a partial one: background for the detectors.
void share_pixel(Pick s, inout float distance) {
    bool paper = s.other <= NOTHING;
    other = paper || s.share == 255u ? FAR : distance_of(s.other);
    if (s.share >= 128u || !paper) return;
    other = distance;
    distance = FAR;
}

void main() {
    ivec2 p = ivec2(gl_FragCoord.xy);
    Pick s;
    put_nothing();
    if (!pick(p, s)) return;
    uint t = s.triangle;
    Plane plane = plane_seen(t);
    vec3 weights = is_clipped(t) ? space_weights(t, s.at, s.d) : screen_weights(t, s.at);
    float distance = distance_of(centre_depth(t, plane, s, p));
    vec3 n = shading_normal(t, plane, weights);
    share_pixel(s, distance);
    geometry = vec4(n, distance);
    what = uvec2(t + 1u, min(group_of(t) + 1u, 65535u) | s.share << 16);
    base = shading.base;
#ifdef COLORED
    base = color_of(t, weights);
#endif
#ifdef TEXTURED
    texcoord = texcoord_of(t, weights);
#endif
}
