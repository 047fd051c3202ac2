// How each triangle lies, once for itself and its three neighbours.
#define COMPUTE 64
#define FACING_OF(t) 0u
#include "outlines.glsl"

layout(std430, binding = 5) writeonly buffer Facings { uint facing[]; };

void main() {
    uint t = dp_item();
    if (t < picture.counts.y) facing[t] = facing_of_triangle(t);
}
