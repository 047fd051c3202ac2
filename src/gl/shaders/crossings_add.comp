// Crossings become candidates. Doubled faces cross as often as they are there: what an earlier crossing covers is left out.
#define COMPUTE 64
#include "crossings.glsl"
#include "candidates.glsl"

layout(std430, binding = 4) buffer Counters { uint counters[]; };
layout(std430, binding = 6) readonly buffer Nodes { uvec2 nodes[]; };
layout(std430, binding = 7) writeonly buffer Candidates { Candidate candidates[]; };

// px on the screen, pixel sizes in depth: crossings no farther apart are one.
const float SAME = 0.02, SAME_DEPTH = 0.2;

const uint MOST = 16u;
vec2 covered[MOST]; // shares of the crossing
uint covered_count = 0u;

// The share of x beside which y runs.
bool covers(Pair x, Pair y, out vec2 share) {
    vec2 e = x.q.xy - x.p.xy;
    float l = length(e);
    share = vec2(0.0);
    if (!(l > 0.0)) return false;
    for (int i = 0; i < 2; i++) {
        vec3 at = i == 1 ? y.q.xyz : y.p.xyz;
        vec2 v = at.xy - x.p.xy;
        if (!(abs(e.x * v.y - e.y * v.x) <= SAME * l)) return false;
        share[i] = dot(e, v) / (l * l);
        float d = mix(x.p.z, x.q.z, share[i]);
        if (abs(at.z - d) > abs(depth_steps(d, SAME_DEPTH))) return false;
    }
    share = clamp(vec2(min(share.x, share.y), max(share.x, share.y)), 0.0, 1.0);
    return share.x < share.y;
}
// Sorted by where they begin.
void cover(vec2 share) {
    if (covered_count == MOST) return;
    uint at = covered_count++;
    for (; at > 0u && covered[at - 1u].x > share.x; at--) covered[at] = covered[at - 1u];
    covered[at] = share;
}
void find_covered(uint i, Pair x) {
    vec2 p = x.p.xy, q = x.q.xy;
    clip_to_picture(p, q);
    uint n = steps_of(x);
    for (uint k = 0u; k <= n && covered_count < MOST; k++)
        for (uint node = words[list_of(cell_at(mix(p, q, float(k) / float(n))))]; node != 0u;
             node = nodes[node - 1u].y) {
            uint other = nodes[node - 1u].x;
            Pair y = pairs[other];
            vec2 share;
            if (other == i || y.a > x.a || (y.a == x.a && y.b > x.b) || !covers(x, y, share)) continue;
            bool known = false;
            for (uint c = 0u; c < covered_count; c++) known = known || covered[c] == share;
            if (!known) cover(share);
        }
}

void add(Pair x, uint k0, uint k1) {
    if (k0 >= k1) return;
    uint at = atomicAdd(counters[4], 1u);
    if (at < head.candidates_room) candidates[at] = Candidate(INTERSECTION, x.a, NONE, x.b, k0, k1, 3u, 0u);
}

void main() {
    uint i = dp_item();
    if (i >= min(head.pairs, head.pairs_room) || pairs[i].n == 0u) return;
    Pair x = pairs[i];
    find_covered(i, x);
    float n = ceil(length(x.q.xy - x.p.xy) * 4.0), from = 0.0; // sample points
    for (uint c = 0u; c < covered_count; c++) {
        add(x, uint(from), uint(max(round(covered[c].x * n), 0.0)));
        from = max(from, round(covered[c].y * n));
    }
    if (from == 0.0 || from < n) add(x, uint(from), NONE);
}
