// A corner of a triangle, straight from the scene. Of a triangle within the guarded frustum the places on the screen
// are those that all other stages work with; any other one goes through the device's clipping.
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
uniform vec2 depth_range; // factor and offset: window depth in [0, 1] = d * x + y

flat out uint triangle;
invariant gl_Position; // the same in each pass over the model

#ifdef PROJECTED // the picture's textures, projected from the camera: for textureProj
out vec4 projected;
void project() {
    projected = vec4((gl_Position.xy + gl_Position.w) * 0.5, 0.0, gl_Position.w);
}
#else
void project() {}
#endif

// What the device clips with beyond this would overflow: such points are made smaller, w and all.
const double FAR = 1048576.0;

void main() {
    uint half_edge = uint(gl_VertexID);
    triangle = half_edge / 3u;
    uint vertex = corners[half_edge];
    vec4 s = screen_of(vertex);
    gl_ClipDistance[0] = vertices[vertex].world.w;
    if (!is_off_screen(s)) {
        float w = is_perspective() ? 1.0 / s.z : 1.0;
        float z = s.z * depth_range.x + depth_range.y;
        gl_Position = vec4(s.x * picture.size.z * 2.0 - 1.0, s.y * picture.size.w * 2.0 - 1.0,
                           CLIP_Z(z), 1.0) * w;
        project();
        return;
    }
    ClipPoint c = to_clip(world_of(vertex));
    if (isnan(float(c.c.x + c.c.y + c.c.w))) {
        gl_Position = vec4(0.0, 0.0, 0.0, -1.0); // not finite
        project();
        return;
    }
    // z / w as above, of a point of any w: d * w is 1, or -distance
    double zw = (is_perspective() ? 1.0 : -c.distance) * double(depth_range.x) +
                double(depth_range.y) * c.c.w;
    dvec4 p = dvec4(c.c.x, -c.c.y, CLIP_ZW(zw, c.c.w), c.c.w), q = abs(p);
    double most = max(max(q.x, q.y), max(q.z, q.w)), k = most > FAR ? FAR / most : 1.0;
    gl_Position = vec4(p * k);
    gl_ClipDistance[0] = float((c.c.w - c.c.z) * k);
    project();
}
