// Visible pieces of lines, as they lie in the buffer (dp_gl_segment in drypoint/gl.h).
#ifndef SEGMENTS_ACCESS
#define SEGMENTS_ACCESS readonly
#endif
struct Segment {
    vec3 a; // x, y, d
    uint line;
    vec3 b;
    uint triangle, other, edge;
    uint k0, k1, n;
    uint hider_a, hider_b;
    uint seen;
};
layout(std430, binding = SEGMENTS_BINDING) SEGMENTS_ACCESS buffer Segments { Segment segments[]; };
