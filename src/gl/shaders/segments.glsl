// Segments, as dp_gl_segment has them (drypoint/gl.h).
struct Segment {
    vec3 a;
    uint line;
    vec3 b;
    uint triangle, other, edge, k0, k1, n, hider[2], seen;
};
const uint ENDS = 0xFFFFFFFEu; // instead of a hider: the edge ends there, or leaves the picture
