// Vertex shader of (Hermosilla and Vázquez 2010, Figure 2.1): a vertex of the index buffer with adjacency, to the screen.
#include "corner.glsl"

out VertexOut {
    vec4 screen, world;
} v;

void main() {
    uint vertex = uint(gl_VertexID);
    v.screen = screen_of(vertex);
    v.world = vertices[vertex].world;
#ifdef ONE_PASS
    gl_Position = window_position_of(vertex);
#else
    gl_Position = vec4(0.0);
#endif
}
