// Puts each crossing into the lists of the cells that it runs through.
#define COMPUTE 64
#include "crossings.glsl"

layout(std430, binding = 6) writeonly buffer Nodes { uvec2 nodes[]; }; // pair, next

void main() {
    uint i = dp_item();
    if (i >= min(head.pairs, head.pairs_room) || pairs[i].n == 0u) return;
    Pair x = pairs[i];
    if (!clip_to_picture(x.p.xy, x.q.xy)) {
        pairs[i].n = 0u;
        return;
    }
    uint n = steps_of(x), last = NONE;
    for (uint k = 0u; k <= n; k++) {
        uint list = list_of(cell_at(mix(x.p.xy, x.q.xy, float(k) / float(n))));
        if (list == last) continue;
        last = list;
        uint node = atomicAdd(head.nodes, 1u);
        if (node >= head.nodes_room) return;
        nodes[node] = uvec2(i, atomicExchange(words[list], node + 1u));
    }
}
