// Added polygons on their way from quads_shade.comp to quads.vert: three or four points, those of a triangle with the
// first one twice.
struct Added {
    vec4 points[4]; // x, y, d; w, as bits: line and what it is; triangle; slope of d along x and along y
    vec4 root;      // what it grows from: the ends of an edge, or a corner twice
};
const uint ADDED_LINE = 7u;  // the class, dp_line
const uint ADDED_FACE = 8u;  // the triangle itself: corners are those of the scene
const uint ADDED_VALLEY = 16u;
#ifndef ADDED_ACCESS
#define ADDED_ACCESS readonly
#endif
layout(std430, binding = 3) ADDED_ACCESS buffer AddedPolygons { Added added[]; };

// Added polygons are held off what they may touch, and so are faces that are asked whether they intersect.
float hold_off(float d) { return 4e-7 * abs(d) + depth_steps(d, 0.0005); }
