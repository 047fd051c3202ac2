// The same in double precision, as core/outline.c has it, of what is listed.
#define COMPUTE 64
#include "scene.glsl"
#include "facing.glsl"
#include "polygons.glsl"
#include "sides.glsl"

layout(std430, binding = 3) writeonly buffer Sides { Side sides[]; };
layout(std430, binding = 4) readonly buffer Counters { uint counters[]; };
layout(std430, binding = 5) readonly buffer Unsure { uint unsure[]; };

uniform uint has_fans;

const double NO_AREA = 1e-12LF; // of the squared size

struct Outline {
    dvec3 sum;   // of the areas of its triangles in space, …
    double size; // … their squared size, …
    double area; // … and areas on the screen, twice
    double reach;
    bool off_screen;
};
Outline outline_of(uint first, uint n) {
    dvec3 o = corner_at(first, 0u), p = dvec3(0.0);
    vec4 s = screen_of(vertex_at(first, 0u));
    dvec2 u = dvec2(0.0);
    Outline r = Outline(dvec3(0.0), 0.0LF, 0.0LF, 0.0LF, is_off_screen(s));
    for (uint i = 1u; i < n; i++) {
        dvec3 q = corner_at(first, i) - o;
        vec4 at = screen_of(vertex_at(first, i));
        dvec2 v = dvec2(at.xy) - dvec2(s.xy);
        r.off_screen = r.off_screen || is_off_screen(at);
        r.sum += cross_of(p, q);
        r.size = max(r.size, dot(q, q));
        r.area += u.x * v.y - u.y * v.x;
        r.reach = max(r.reach, max(abs(v.x), abs(v.y)));
        p = q, u = v;
    }
    return r;
}

void main() {
    uint i = dp_item();
    if (i >= counters[8]) return;
    uint t = unsure[i], first = has_fans != 0u ? first_of(t) : t,
         n = has_fans != 0u ? corner_count(first) : 3u;
    if (first != t) return; // the first of its polygon does it
    Outline r = outline_of(first, n);
    dvec3 normal = unit(r.sum);
    bool on_screen = !r.off_screen, edge_on = on_screen && abs(r.area) <= EDGE_ON * r.reach;
    bool front = r.area < 0.0LF;
    if (!on_screen || !(abs(r.area) > double(picture.step_.z) * r.reach))
        front = dot(normal, view_vector(corner_at(first, 0u))) < (edge_on ? -SEEN_EDGE_ON : -1e-12LF);
    uint kind = (front ? SIDE_FRONT : 0u) | (edge_on ? SIDE_EDGE_ON : 0u);
    if (!(length(r.sum) > NO_AREA * r.size)) kind = SIDE_NO_AREA | SIDE_EDGE_ON;
    for (uint k = 0u; k + 2u < n; k++) sides[t + k] = Side(vec3(normal), kind);
}
