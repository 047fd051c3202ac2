// A corner of a triangle.
#include "corner.glsl"

out float gl_ClipDistance[1];

flat out uint triangle;
invariant gl_Position; // the same in each pass over the model

#ifdef PROJECTED // the picture's textures, projected from the camera: for textureProj
out vec4 projected;
#endif

void main() {
    uint half_edge = uint(gl_VertexID);
    triangle = half_edge / 3u;
    Corner c = corner_at(corners[half_edge]);
    gl_Position = c.position;
    gl_ClipDistance[0] = c.before_far;
#ifdef PROJECTED
    projected = vec4((gl_Position.xy + gl_Position.w) * 0.5, 0.0, gl_Position.w);
#endif
}
