// Lists the pixels in or beside which neighbouring samples show different polygons.
#define COMPUTE_PIXELS
#include "crossings.glsl"
#include "ids.glsl"

layout(std430, binding = 6) writeonly buffer Pixels { uint pixels[]; };

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (!is_in_picture(p)) return;
    uint id = id_at(p, 0);
    bool differs = false;
    for (int i = 1; i < SAMPLES; i++) differs = differs || id_at(p, i) != id;
    for (int k = 0; k < 2; k++) {
        ivec2 q = p + ivec2(1 - k, k);
        differs = differs || (is_in_picture(q) && id_at(q, 0) != id);
    }
    if (differs && is_triangle(id)) pixels[atomicAdd(head.pixels, 1u)] = uint(p.y) << 16 | uint(p.x);
}
