// Vertex shader of (Hermosilla and Vázquez 2010, Figure 2.1): a vertex of the index buffer with adjacency, to the screen.
#include "corner.glsl"

out VertexOut {
    vec4 screen, world;
    float before_far;
} v;

void main() {
    uint vertex = uint(gl_VertexID);
    v.screen = screen_of(vertex);
    v.world = vertices[vertex].world;
#ifdef ONE_PASS
    Corner c = corner_at(vertex);
    gl_Position = c.position;
    v.before_far = c.before_far;
#else
    gl_Position = vec4(0.0);
    v.before_far = 0.0;
#endif
}
