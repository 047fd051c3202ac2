// Where a corner of a triangle goes. Of a triangle within the guarded frustum the places on the screen are those that
// all other stages work with; any other one goes through the device's clipping.
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

out float gl_ClipDistance[1];

// What the device clips with beyond this would overflow: such points are made smaller, w and all.
const double FAR = 1048576.0;

// `range`: factor and offset: window depth in [0, 1] = d * x + y
vec4 place_on_screen(vec3 s, vec2 range) {
    return vec4(s.x * picture.size.z * 2.0 - 1.0, s.y * picture.size.w * 2.0 - 1.0,
                CLIP_Z(s.z * range.x + range.y), 1.0);
}

vec4 place_corner(uint half_edge, vec2 range) {
    uint vertex = corners[half_edge];
    vec4 s = screen_of(vertex);
    gl_ClipDistance[0] = vertices[vertex].world.w;
    if (!is_off_screen(s))
        return place_on_screen(s.xyz, range) * (is_perspective() ? 1.0 / s.z : 1.0);
    ClipPoint c = to_clip(world_of(vertex));
    if (isnan(float(c.c.x + c.c.y + c.c.w))) return vec4(0.0, 0.0, 0.0, -1.0); // not finite
    // z / w as above, of a point of any w: d * w is 1, or -distance
    double zw = (is_perspective() ? 1.0 : -c.distance) * double(range.x) + double(range.y) * c.c.w;
    dvec4 p = dvec4(c.c.x, -c.c.y, CLIP_ZW(zw, c.c.w), c.c.w), q = abs(p);
    double most = max(max(q.x, q.y), max(q.z, q.w)), k = most > FAR ? FAR / most : 1.0;
    gl_ClipDistance[0] = float((c.c.w - c.c.z) * k);
    return vec4(p * k);
}
