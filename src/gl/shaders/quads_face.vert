// A corner of a face, moved in depth by d * x + y, and towards the eye by `nearer` times what polygons are held off.
#include "corner.glsl"
#include "quads_records.glsl"

out float gl_ClipDistance[1];
uniform vec2 depth_move;
uniform float nearer;

flat out uint triangle;

void main() {
    uint half_edge = uint(gl_VertexID);
    triangle = half_edge / 3u;
    float most = -3.4e38;
    for (uint k = 0u; k < 3u; k++) {
        vec4 s = screen_of(corners[3u * triangle + k]);
        if (!is_off_screen(s)) most = max(most, s.z);
    }
    float shift = nearer != 0.0 && most > -3.4e38 ? nearer * hold_off(most) : 0.0;
    vec2 range = vec2(depth_range.x * depth_move.x,
                      (depth_move.y + shift) * depth_range.x + depth_range.y);
    Corner corner = corner_in(corners[half_edge], range);
    gl_Position = corner.position;
    gl_ClipDistance[0] = corner.before_far;
}
