// Lists outlines in the order of triangles and their edges, which is that of a geometry shader: where two triangles of the
// same depth lie over each other, the first one shows.
//
//     COUNT     outlines of each triangle, and how many each group of 64 has
//     (sums)    fins_sums.comp
//     put       at the sum of the groups before, and of the triangles before in the group
#define COMPUTE 64
#define FACING_OF(t) facing[t]
layout(std430, binding = 5) buffer Facings { uint facing[]; }; // of all triangles; then their outlines: bits of edges
#include "outlines.glsl"

layout(std430, binding = 6) writeonly buffer Listed { uint listed[]; };
layout(std430, binding = 7) buffer Sums { uint command[4], sums[]; };

uniform uint lines;

shared uint counts[64];

#ifdef COUNT
// Bits 0 to 2: the edge is an outline; 3 to 5: a border.
uint outlines_of(uint t) {
    uint bits = 0u;
    for (uint k = 0u; k < 3u; k++) {
        uint mate = mates[3u * t + k];
        uint line = outline_of(3u * t + k, facing[t], is_mate(mate) ? facing[mate_of(mate) / 3u] : 0u);
        if (line == NO_LINE || (lines >> line & 1u) == 0u) continue;
        bits |= (line == BORDER ? 9u : 1u) << k;
    }
    return bits;
}
#endif

void main() {
    uint t = dp_item(), count = picture.counts.y, me = gl_LocalInvocationIndex, bits = 0u, sum = 0u;
#ifdef COUNT
    if (t < count) bits = facing[count + t] = outlines_of(t);
#else
    if (t < count) bits = facing[count + t];
#endif
    counts[me] = uint(bitCount(bits & 7u));
    barrier();
    for (uint i = 0u; i < me; i++) sum += counts[i];
    uint group = t / 64u;
#ifdef COUNT
    if (me == 63u && 64u * group < count) sums[group] = sum + counts[me];
#else
    if (t >= count) return;
    sum += sums[group];
    for (uint k = 0u; k < 3u; k++)
        if ((bits >> k & 1u) != 0u) listed[sum++] = (3u * t + k) << 1 | (bits >> (k + 3u) & 1u);
#endif
}
