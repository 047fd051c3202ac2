// Lists outlines in the order of triangles and their edges, which is that of a geometry shader: where two triangles of the
// same depth lie over each other, the first one shows.
//
//     COUNT     outlines of each triangle, and how many each group of 64 has
//     (sums)    fins_sums.comp
//     put       at the sum of the groups before, and of the triangles before in the group
#define COMPUTE 64
#define FACING_OF(t) facing[t]
layout(std430, binding = 5) readonly buffer Facings { uint facing[]; };
#include "outlines.glsl"

layout(std430, binding = 6) writeonly buffer Listed { uint listed[]; };
layout(std430, binding = 7) buffer Sums { uint command[4], sums[]; };

uniform uint lines;

shared uint counts[64];

uint line_of(uint half_edge, uint own) {
    uint mate = mates[half_edge];
    uint line = outline_of(half_edge, own, is_mate(mate) ? facing[mate_of(mate) / 3u] : 0u);
    return line != NO_LINE && (lines >> line & 1u) != 0u ? line : NO_LINE;
}

void main() {
    uint t = dp_item(), me = gl_LocalInvocationIndex, count = 0u;
    uint found[3];
    bool in_scene = t < picture.counts.y;
    for (uint k = 0u; k < 3u && in_scene; k++) {
        found[k] = line_of(3u * t + k, facing[t]);
        count += found[k] != NO_LINE ? 1u : 0u;
    }
    counts[me] = count;
    barrier();
    uint group = t / 64u, groups = (picture.counts.y + 63u) / 64u;
    uint sum = 0u;
    for (uint i = 0u; i < me; i++) sum += counts[i];
#ifdef COUNT
    if (me == 63u && group < groups) sums[group] = sum + count;
#else
    if (!in_scene) return;
    sum += sums[group];
    for (uint k = 0u; k < 3u; k++)
        if (found[k] != NO_LINE)
            listed[sum++] = (3u * t + k) << 1 | (found[k] == BORDER ? 1u : 0u);
#endif
}
