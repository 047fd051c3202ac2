// Marks the tiles of 64 x 64 px in which a back face is seen, or right beside which: as on the CPU, edges whose polygons all
// face away make lines only there.
#define COMPUTE_PIXELS
#include "eye.glsl"
#include "ids.glsl"
#include "sides.glsl"

layout(std430, binding = 4) readonly buffer Sides { Side sides[]; };

bool shows_back(ivec2 p) {
    for (int i = 0; i < SAMPLES; i++) {
        uint id = id_at(p, i);
        if (is_triangle(id) && (sides[id - 1u].kind & (SIDE_FRONT | SIDE_EDGE_ON)) == 0u) return true;
    }
    return false;
}
void mark(ivec2 p) {
    if (!is_in_picture(p)) return;
    uint tile = tile_of(uvec2(p)), at = head.tiles_at + tile / 32u, bit = 1u << (tile % 32u);
    if ((words[at] & bit) == 0u) atomicOr(words[at], bit);
}
void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (!is_in_picture(p) || !shows_back(p)) return;
    mark(p);
    ivec2 at = p % 64;
    if (at.x == 0) mark(p - ivec2(1, 0));
    if (at.y == 0) mark(p - ivec2(0, 1));
    if (at.x == 63) mark(p + ivec2(1, 0));
    if (at.y == 63) mark(p + ivec2(0, 1));
}
