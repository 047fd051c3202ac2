// What fins.geom adds, without a geometry shader: point i of the strip beside outline j of the list, pulled from the scene.
#define FACING_OF(t) facing_of_triangle(t)
#include "corner.glsl"
#include "outlines.glsl"
#include "fins.glsl"

layout(std430, binding = 6) readonly buffer Listed { uint listed[]; }; // half-edge, with its line: fins_list.comp

out float gl_ClipDistance[1];
#ifdef TEXTURED
#define PER_SAMPLE sample
#else
#define PER_SAMPLE
#endif
PER_SAMPLE out vec3 place;
flat out uint what;

void main() {
    uint entry = listed[gl_InstanceID], half_edge = entry >> 1, t = half_edge / 3u;
    what = (entry & 1u) != 0u ? BORDER : SILHOUETTE;
    gl_ClipDistance[0] = 1.0;
    FinEdge e = fin_edge(half_edge, faces_front(t, facing_of_triangle(t)));
    if (!e.is_seen) {
        place = vec3(0.0);
        gl_Position = vec4(0.0, 0.0, 0.0, -1.0);
        return;
    }
    FinPoint p = fin_point(e, double(picture.widths[what].x), gl_VertexID);
    place = p.place;
    gl_Position = window_position(p.at, 1.0);
}
