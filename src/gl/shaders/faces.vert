// A corner of a triangle, straight from the scene.
#include "corner.glsl"

uniform vec2 depth_range; // see place_corner

flat out uint triangle;
invariant gl_Position; // the same in each pass over the model

#ifdef PROJECTED // the picture's textures, projected from the camera: for textureProj
out vec4 projected;
#endif

void main() {
    uint half_edge = uint(gl_VertexID);
    triangle = half_edge / 3u;
    gl_Position = place_corner(half_edge, depth_range);
#ifdef PROJECTED
    projected = vec4((gl_Position.xy + gl_Position.w) * 0.5, 0.0, gl_Position.w);
#endif
}
