// Geometry shader of (Hermosilla and Vázquez 2010, Listings 2.1 and 2.2): from a triangle and its three neighbours to the
// triangles beside those of its edges that are outlines. Six vertices come in, as in Figure 2.2.
//
// In one pass (2.3.4) the triangle itself comes out too, with v = 2. It goes to layer 0, and what is added to layer 1, so that ink
// has a depth of its own and the order of triangles does not matter.
#define FACING_OF(t) facing_of_triangle(t)
#include "corner.glsl"
#include "outlines.glsl"
#include "fins.glsl"

layout(triangles_adjacency) in;
layout(triangle_strip, max_vertices = 21) out;

in VertexOut {
    vec4 screen, world;
    float before_far;
} v[];

out float gl_ClipDistance[1];
#ifdef TEXTURED
#define PER_SAMPLE sample
#else
#define PER_SAMPLE
#endif
PER_SAMPLE out vec3 place;     // x, y from which u is computed; v: 0 to 1, or 2 on the surface
flat out uint what; // of the surface 1 + triangle, else the class of line

uniform uint lines;
uniform int edges; // 3: a bound that compilers do not know, so that they do not unroll what is large

Vertex vertex_at(int i) { return Vertex(v[i].screen, v[i].world); }

// How the triangle across edge i, i + 2 lies. Its corners are put in its own order, so that it finds the same of itself.
uint facing_across(int i, uint mate) {
    int after = (i + 2) % 6;
    bool turned = (mate & MATE_ALIKE) != 0u; // it runs the edge the same way
    int own[3] = int[3](turned ? i : after, turned ? after : i, i + 1);
    int first = int(3u - mate_of(mate) % 3u) % 3;
    return facing_of_vertices(vertex_at(own[first]), vertex_at(own[(first + 1) % 3]),
                              vertex_at(own[(first + 2) % 3]));
}

void put(vec4 position, vec3 place_, uint what_, float distance_, int layer) {
    gl_Position = position;
    gl_ClipDistance[0] = distance_;
#ifdef ONE_PASS
    gl_Layer = layer;
#endif
    place = place_;
    what = what_;
    EmitVertex();
}

void main() {
    uint t = uint(gl_PrimitiveIDIn);
    uint own = facing_of_vertices(vertex_at(0), vertex_at(2), vertex_at(4));
    bool front = faces_front(t, own);
#ifdef ONE_PASS
    if (front || picture.style.z == 0u) { // else back faces are not painted
        for (int i = 0; i < 6; i += 2)
            put(gl_in[i].gl_Position, vec3(0.0, 0.0, 2.0), t + 1u, v[i].before_far, 0);
        EndPrimitive();
    }
#endif
    for (int k = 0; k < edges; k++) {
        uint half_edge = 3u * t + uint(k), mate = mates[half_edge];
        uint other = is_mate(mate) ? facing_across(2 * k, mate) : 0u;
        uint line = outline_of(half_edge, own, other);
        if (line == NO_LINE || (lines >> line & 1u) == 0u) continue;
        FinEdge e = fin_edge(half_edge, front);
        if (!e.is_seen) continue;
        for (int i = 0; i < 2 * edges; i++) {
            FinPoint p = fin_point(e, double(picture.widths[line].x), i);
            put(window_position(p.at, 1.0), p.place, line, 1.0, 1);
        }
        EndPrimitive();
    }
}
