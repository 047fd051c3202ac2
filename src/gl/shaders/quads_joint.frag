// A joint of a ridge: around a corner lie polygons that share no edge with this one and may curve away without
// any fold, so a close surface must pass through the corner.
#include "quads_surface.glsl"

const float JOINT = 0.1; // within this share of its reach
uniform float reach;
layout(location = 0) out uint ink;
flat in uint line;
flat in vec3 at;
flat in vec2 slope;
flat in vec4 root;
flat in float nearest;

void main() {
    uint id = surface_id();
    vec2 p = sample_at();
    if (is_triangle(id)) {
        Plane s = face_plane(id - 1u);
        float surface = plane_at(s, p), d = min(at.z + dot(slope, p - at.xy), nearest);
        bool close = surface >= d * trap.x + trap.y;
        if (close && !passes_root(p, surface - d, s.slope - slope, root, JOINT * reach)) discard;
    }
    ink = (line & 7u) + 1u;
}
