// Planes of all triangles on the screen, and which way they face, for fragments that ask about the surface.
#define COMPUTE 64
#define FACES_ACCESS writeonly
#include "quads_faces.glsl"
#include "facing.glsl"

void main() {
    uint t = dp_item();
    if (t >= picture.counts.y) return;
    Plane p = plane_of(t);
    faces[t] = Face(vec4(p.at, uintBitsToFloat(is_front(t) ? 1u : 0u)), vec4(p.slope, 0.0, 0.0));
}
