// Where a vertex of the scene goes in the window, straight from the scene. Of a vertex within the guarded frustum that is
// the place on the screen that all other stages work with; any other one goes through the device's clipping.
//
// The window's depth is affine in d, from 0 (far) to 1 (near).
#include "scene.glsl"

#ifdef ZERO_TO_ONE // as glClipControl sets it; else -1 to 1
#define CLIP_Z(z) (z)
#define CLIP_ZW(zw, w) (zw)
#else
#define CLIP_Z(z) ((z) * 2.0 - 1.0)
#define CLIP_ZW(zw, w) ((zw) * 2.0 - (w))
#endif

uniform vec2 depth_range; // factor and offset: window depth in [0, 1] = d * x + y

// A point on the screen, times w. The same in every pass over the model. `range` stands for depth_range.
vec4 window_position_in(vec3 s, float w, vec2 range) {
    precise float z = s.z * range.x + range.y;
    precise vec4 p = vec4(s.x * picture.size.z * 2.0 - 1.0, s.y * picture.size.w * 2.0 - 1.0,
                          CLIP_Z(z), 1.0) *
                     w;
    return p;
}
vec4 window_position(vec3 s, float w) { return window_position_in(s, w, depth_range); }

// What the device clips with beyond this would overflow: such points are made smaller, w and all.
const double FARTHEST = 1048576.0;

struct Corner {
    vec4 position;    // in the window's clip space
    float before_far; // distance from the far plane there, for gl_ClipDistance
};
Corner corner_in(uint vertex, vec2 range) {
    vec4 s = screen_of(vertex);
    if (!is_off_screen(s))
        return Corner(window_position_in(s.xyz, is_perspective() ? 1.0 / s.z : 1.0, range),
                      vertices[vertex].world.w);
    ClipPoint c = to_clip(world_of(vertex));
    if (isnan(float(c.c.x + c.c.y + c.c.w)))
        return Corner(vec4(0.0, 0.0, 0.0, -1.0), vertices[vertex].world.w); // not finite
    // z / w as above, of a point of any w: d * w is 1, or -distance
    precise double zw = (is_perspective() ? 1.0 : -c.distance) * double(range.x) +
                        double(range.y) * c.c.w;
    precise dvec4 p = dvec4(c.c.x, -c.c.y, CLIP_ZW(zw, c.c.w), c.c.w), q = abs(p);
    double most = max(max(q.x, q.y), max(q.z, q.w)), k = most > FARTHEST ? FARTHEST / most : 1.0;
    return Corner(vec4(p * k), float((c.c.w - c.c.z) * k));
}
Corner corner_at(uint vertex) { return corner_in(vertex, depth_range); }
