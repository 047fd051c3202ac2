// What all stages know of a picture; gl.h has the same in C (dp_gl_picture_block).
//
//     screen space   x right, y down, px; texel (x, y) of every picture-sized texture is that pixel
//     depth d        1 / distance in perspective, -distance in orthographic views; larger is nearer
//     world space    about the scene's origin
//
// Numbers that are compared with each other are made in double precision, as core/view.h does, and are
// `precise`: contraction would make two triangles disagree on their common edge.

layout(std140, binding = 0) uniform Picture {
    dvec4 clip[4];
    dvec4 sight;
    dvec4 eye;     // w: guard
    dvec4 forward; // w: focal
    dvec4 corner, across, down;
    dvec4 angles;
    vec4 size;
    vec4 step_; // scale, offset, nearly_edge_on, flat_cosine
    vec4 widths[8];
    vec4 colors[8];
    vec4 paper, surface;
    vec4 places[16];
    uvec4 counts; // vertices, triangles, samples, room for segments
    uvec4 style;  // lines, perspective, cull_back_faces, free
} picture;

const uint NONE = 0xFFFFFFFFu;
const uint ID_FOREIGN = 0xFFFFFFFFu; // of a sample: something of the application's is nearer

const uint SILHOUETTE = 0u, RIDGE = 1u, VALLEY = 2u, INTERSECTION = 3u, BORDER = 4u;

bool draws(uint line) { return (picture.style.x >> line & 1u) != 0u; }
bool is_perspective() { return picture.style.y != 0u; }

#ifdef COMPUTE // the size of its groups
layout(local_size_x = COMPUTE) in;
// Number of this invocation, of a program that dp_gl_dispatch runs.
uint dp_item() {
    return (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x +
           gl_LocalInvocationIndex;
}
#endif
#ifdef COMPUTE_PIXELS // one invocation a pixel: dp_gl_dispatch_pixels
layout(local_size_x = 8, local_size_y = 8) in;
#endif

// Change of depth over `px` pixel sizes along the line of sight, at depth d.
float depth_steps(float d, float px) { return px * (abs(d) * picture.step_.x + picture.step_.y); }

// A point in clip space, and its distance.
struct ClipPoint {
    dvec4 c;
    double distance;
};
ClipPoint clip_of(dvec3 world) {
    precise dvec4 p = dvec4(world, 1.0);
    precise ClipPoint q;
    for (int r = 0; r < 4; r++) {
        dvec4 m = picture.clip[r];
        q.c[r] = m.x * p.x + m.y * p.y + m.z * p.z + m.w;
    }
    dvec4 s = picture.sight;
    q.distance = s.x * p.x + s.y * p.y + s.z * p.z + s.w;
    return q;
}
ClipPoint to_clip(vec3 world) { return clip_of(dvec3(world)); }
// Requires w > 0.
dvec3 to_screen(ClipPoint q) {
    precise double inverse = 1.0 / q.c.w;
    precise dvec3 p = dvec3((q.c.x * inverse * 0.5 + 0.5) * double(picture.size.x),
                            (0.5 - q.c.y * inverse * 0.5) * double(picture.size.y),
                            is_perspective() ? inverse : -q.distance);
    return p;
}
// Does the point lie within the guarded frustum?
bool is_inside(ClipPoint q) {
    double g = picture.eye.w * q.c.w, w = q.c.w;
    double sum = q.c.x + q.c.y + q.c.w;
    return w > 0.0 && q.c.z >= -w && q.c.z <= w && abs(q.c.x) <= g && abs(q.c.y) <= g &&
           sum - sum == 0.0;
}
