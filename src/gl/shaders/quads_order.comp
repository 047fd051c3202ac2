// The order in which a portion's added polygons are drawn: those of the first half-edge, then of the second one, … One
// group does it all: each invocation adds up a run of half-edges, all runs are added up, and each writes its own.
layout(local_size_x = 256) in;
layout(std430, binding = 4) writeonly buffer Order { uint order[]; };
layout(std430, binding = 6) readonly buffer Counts { uint counts[]; };
layout(std430, binding = 7) writeonly buffer Commands { uvec4 commands[]; };
uniform uint edge_count, places, first_command;
shared uint sums[256];

void main() {
    uint i = gl_LocalInvocationIndex, run = (edge_count + 255u) / 256u, from = i * run,
         to = min(from + run, edge_count), sum = 0u;
    for (uint e = from; e < to; e++) sum += counts[e];
    sums[i] = sum;
    barrier();
    uint at = 0u, all = 0u;
    for (uint k = 0u; k < 256u; k++) {
        if (k == i) at = all;
        all += sums[k];
    }
    for (uint e = from; e < to; e++)
        for (uint k = 0u; k < counts[e]; k++) order[at++] = e * places + k;
    if (i == 0u) commands[first_command] = uvec4(6u * all, 1u, 0u, 0u);
}
