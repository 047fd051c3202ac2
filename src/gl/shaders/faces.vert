// A corner of a triangle, straight from the scene.
#include "corner.glsl"

uniform vec2 depth_range; // see place_corner

flat out uint triangle;

void main() {
    uint half_edge = uint(gl_VertexID);
    triangle = half_edge / 3u;
    gl_Position = place_corner(half_edge, depth_range);
}
