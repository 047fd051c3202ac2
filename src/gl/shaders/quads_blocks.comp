// The farthest depth of the surface in each block of 8 x 8 px: what lies clearly behind it all is hidden.
#define COMPUTE 64
#include "picture.glsl"
#include "depths.glsl"
layout(std430, binding = 4) writeonly buffer Blocks { float blocks[]; };
uniform uint blocks_x, blocks_y;

void main() {
    uint item = dp_item();
    if (item >= blocks_x * blocks_y) return;
    ivec2 from = 8 * ivec2(item % blocks_x, item / blocks_x),
          to = min(from + 8, ivec2(picture.size.xy));
    float least = 1.0;
    for (int y = from.y; y < to.y; y++)
        for (int x = from.x; x < to.x; x++)
            for (int i = 0; i < SAMPLES; i++) least = min(least, depth_at(ivec2(x, y), i));
    blocks[item] = (least - depth_range.y) / depth_range.x;
}
