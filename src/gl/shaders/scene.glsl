// All meshes of a picture, one after the other (gl.h: dp_gl_scene).
#include "picture.glsl"

struct Vertex {
    vec4 screen; // x, y, d; x is NaN outside the guarded frustum. w: key, as bits
    vec4 world; // w: how far before the far plane, in clip space
};
#ifndef VERTICES_ACCESS
#define VERTICES_ACCESS readonly
#endif
layout(std430, binding = 0) VERTICES_ACCESS buffer Vertices { Vertex vertices[]; };
#ifndef SCENE_ACCESS
#define SCENE_ACCESS readonly
#endif
layout(std430, binding = 1) SCENE_ACCESS buffer Corners { uint corners[]; };
layout(std430, binding = 2) SCENE_ACCESS buffer Triangles { uvec2 triangles[]; };

// Of a half-edge: 3 * triangle + corner from which it runs to the next one.
uint next_in(uint half_edge) { return half_edge % 3u == 2u ? half_edge - 2u : half_edge + 1u; }
uint last_in(uint half_edge) { return half_edge % 3u == 0u ? half_edge + 2u : half_edge - 1u; }

// As in gl.h.
const uint MATE_ALIKE = 0x80000000u, MATE_MANY = 0xFFFFFFFEu, MATE_NONE = 0xFFFFFFFFu;
bool is_mate(uint mate) { return mate < MATE_MANY; }
uint mate_of(uint mate) { return mate & ~MATE_ALIKE; }

bool may_be_line(uint half_edge) {
    return (triangles[half_edge / 3u].y >> (half_edge % 3u) & 1u) != 0u;
}
bool is_diagonal(uint half_edge) {
    return (triangles[half_edge / 3u].y >> (half_edge % 3u + 3u) & 1u) != 0u;
}
uint group_of(uint triangle) { return triangles[triangle].y >> 16; }
uint polygon_of(uint triangle) { return triangles[triangle].x; }

bool is_off_screen(vec4 screen) { return screen.x != screen.x; }

#ifndef NO_VERTICES
vec3 world_of(uint vertex) { return vertices[vertex].world.xyz; }
vec4 screen_of(uint vertex) { return vertices[vertex].screen; }

// Not unit; its length is twice the area.
dvec3 area_normal(uint triangle) {
    precise dvec3 a = dvec3(world_of(corners[3u * triangle])),
                  u = dvec3(world_of(corners[3u * triangle + 1u])) - a,
                  v = dvec3(world_of(corners[3u * triangle + 2u])) - a;
    precise dvec3 n = dvec3(u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x);
    return n;
}

// A plane on the screen: d at a corner of it, and its change per px.
struct Plane {
    vec3 at; // x, y, d
    vec2 slope;
};
float plane_at(Plane p, vec2 q) { return p.at.z + dot(p.slope, q - p.at.xy); }

// The plane of a triangle that is not clipped and not edge-on.
Plane plane_of_points(vec3 a, vec3 b, vec3 c) {
    precise vec3 u = b - a, v = c - a;
    precise float k = 1.0 / (u.x * v.y - u.y * v.x);
    return Plane(a, vec2(u.z * v.y - v.z * u.y, v.z * u.x - u.z * v.x) * k);
}
// The plane of any triangle, from its normal: of one that the near plane cuts, say.
Plane plane_in_space(uint triangle) {
    dvec3 n = area_normal(triangle), a = dvec3(world_of(corners[3u * triangle]));
    double x = dot(n, picture.across.xyz), y = dot(n, picture.down.xyz),
           z = dot(n, picture.corner.xyz), from = dot(n, a);
    if (is_perspective()) { // eye + (corner + x across + y down - eye) / d lies in the plane
        double e = dot(n, picture.eye.xyz), k = from - e;
        k = k != 0.0 ? 1.0 / k : 0.0;
        return Plane(vec3(0, 0, float((z - e) * k)), vec2(float(x * k), float(y * k)));
    }
    // corner (at d = 1) + x across + y down + (1 - d) forward / scale lies in the plane
    double f = dot(n, picture.forward.xyz) / length(picture.sight.xyz);
    double k = f != 0.0 ? 1.0 / f : 0.0;
    return Plane(vec3(0, 0, float(1.0 + (z - from) * k)), vec2(float(x * k), float(y * k)));
}
Plane plane_of(uint triangle) {
    vec4 a = screen_of(corners[3u * triangle]), b = screen_of(corners[3u * triangle + 1u]),
         c = screen_of(corners[3u * triangle + 2u]);
    if (is_off_screen(a) || is_off_screen(b) || is_off_screen(c)) return plane_in_space(triangle);
    return plane_of_points(a.xyz, b.xyz, c.xyz);
}
#endif
