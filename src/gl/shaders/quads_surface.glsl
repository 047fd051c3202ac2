// What added polygons, and faces that may intersect others, are asked about the surface at a sample.
#include "quads_faces.glsl"
#include "ids.glsl"

uniform vec2 trap; // from depth d to how far behind it still counts: d * x + y

vec2 sample_at() { return floor(gl_FragCoord.xy) + place_of(gl_SampleID); }
uint surface_id() { return id_at(ivec2(gl_FragCoord.xy), gl_SampleID); }

Plane face_plane(uint triangle) {
    return Plane(faces[triangle].at.xyz, faces[triangle].slope.xy);
}
bool faces_eye(uint triangle) { return floatBitsToUint(faces[triangle].at.w) != 0u; }

bool cross_within(float gap, vec2 g, float px) { return gap * gap <= dot(g, g) * px * px; }

// Does the surface's plane pass within `px` of what the polygon grows from? `gap`: how far that is behind it, `g`:
// the difference of slopes.
bool passes_root(vec2 at, float gap, vec2 g, vec4 root, float px) {
    vec2 e = root.zw - root.xy;
    float l = dot(e, e), t = l > 0.0 ? clamp(dot(at - root.xy, e) / l, 0.0, 1.0) : 0.0;
    return cross_within(gap - dot(g, at - root.xy - t * e), g, px);
}
