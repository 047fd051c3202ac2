// How polygons lie to the eye, and their normals. In float32 where that is sure, else as facing.glsl has it.
#define COMPUTE 64
#include "scene.glsl"
#include "facing.glsl"
#include "polygons.glsl"
#include "sides.glsl"

layout(std430, binding = 3) writeonly buffer Sides { Side sides[]; };

uniform uint has_fans;

// Twice the area on the screen and the reach (facing.glsl); false: a corner is not on the screen.
bool area_of(uint triangle, out float area, out float reach) {
    vec4 a = screen_of(corners[3u * triangle]), b = screen_of(corners[3u * triangle + 1u]),
         c = screen_of(corners[3u * triangle + 2u]);
    vec2 u = b.xy - a.xy, v = c.xy - a.xy;
    area = u.x * v.y - u.y * v.x;
    reach = max(max(abs(u.x), abs(u.y)), max(abs(v.x), abs(v.y)));
    return !(is_off_screen(a) || is_off_screen(b) || is_off_screen(c));
}
uint kind_of_facing(Facing f) {
    return (f.front ? SIDE_FRONT : 0u) | (f.edge_on ? SIDE_EDGE_ON : 0u);
}
vec3 area_vector(uint triangle) {
    vec3 o = world_of(corners[3u * triangle]);
    return cross(world_of(corners[3u * triangle + 1u]) - o,
                 world_of(corners[3u * triangle + 2u]) - o);
}

Side side_of(uint triangle) {
    float area, reach;
    vec3 n = area_vector(triangle);
    float l = length(n);
    if (l > 1e-18 && l < 1e18 && area_of(triangle, area, reach) &&
        abs(area) > 2.0 * picture.step_.z * reach)
        return Side(n / l, area < 0.0 ? SIDE_FRONT : 0u);
    dvec3 exact = area_normal(triangle);
    double size = length(exact);
    if (!(size > 0.0)) return Side(vec3(0.0), SIDE_NO_AREA | SIDE_EDGE_ON);
    return Side(vec3(exact / size), kind_of_facing(facing_of(triangle)));
}

// A polygon's facing in space, from its normal.
Facing polygon_in_space(dvec3 normal, uint first, bool edge_on) {
    double sine = dot(normal, view_vector(corner_at(first, 0u)));
    return Facing(sine < (edge_on ? -SEEN_EDGE_ON : -1e-12), edge_on);
}
// As dp_outline_facing: by the sum of the areas of its triangles, whose reach is from its first corner.
Facing facing_of_polygon(uint first, uint n, dvec3 normal) {
    vec4 o = screen_of(vertex_at(first, 0u)), a = o;
    double area = 0.0, reach = 0.0;
    bool off_screen = is_off_screen(o);
    for (uint i = 1u; i < n; i++) {
        vec4 b = screen_of(vertex_at(first, i));
        dvec2 u = dvec2(a.xy) - dvec2(o.xy), v = dvec2(b.xy) - dvec2(o.xy);
        off_screen = off_screen || is_off_screen(b);
        reach = max(reach, max(abs(v.x), abs(v.y)));
        area += u.x * v.y - u.y * v.x;
        a = b;
    }
    if (off_screen) return polygon_in_space(normal, first, false);
    if (abs(area) > double(picture.step_.z) * reach) return Facing(area < 0.0, false);
    return polygon_in_space(normal, first, abs(area) <= EDGE_ON * reach);
}

void main() {
    uint t = dp_item();
    if (t >= picture.counts.y) return;
    uint n = has_fans != 0u && first_of(t) == t ? corner_count(t) : 3u;
    if (has_fans != 0u && first_of(t) != t) return; // the first of its polygon does it
    if (n == 3u) {
        sides[t] = side_of(t);
        return;
    }
    dvec3 normal = normal_of(t, n);
    Side side = Side(vec3(normal), kind_of_facing(facing_of_polygon(t, n, normal)));
    if (!(dot(normal, normal) > 0.0)) side = Side(vec3(0.0), SIDE_NO_AREA | SIDE_EDGE_ON);
    for (uint i = 0u; i + 2u < n; i++) sides[t + i] = side;
}
