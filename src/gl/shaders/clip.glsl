// Clipping in homogeneous clip space, as core/view.c has it. Planes: near, far, left, right, bottom, top.
#include "picture.glsl"

// How far inside a plane of the guarded frustum a point lies; negative: outside.
double inside(int plane, ClipPoint p) {
    double g = picture.eye.w * p.c.w;
    switch (plane) {
    case 0: return p.c.z + p.c.w;
    case 1: return p.c.w - p.c.z;
    case 2: return g + p.c.x;
    case 3: return g - p.c.x;
    case 4: return g + p.c.y;
    default: return g - p.c.y;
    }
}
ClipPoint clip_mix(ClipPoint a, ClipPoint b, double t) {
    precise ClipPoint q;
    q.c = a.c + (b.c - a.c) * t;
    q.distance = a.distance + (b.distance - a.distance) * t;
    return q;
}
