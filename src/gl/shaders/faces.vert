// A corner of a triangle.
#include "corner.glsl"

out float gl_ClipDistance[1];

flat out uint triangle;

void main() {
    uint half_edge = uint(gl_VertexID);
    triangle = half_edge / 3u;
    uint vertex = corners[half_edge];
    gl_ClipDistance[0] = vertices[vertex].world.w;
    gl_Position = window_position_of(vertex);
}
