// Spines of candidates, and words for their sample points, so that a line as long as the picture is no more work for one
// invocation than a short one.
#define COMPUTE 64
#define LINES_ACCESS
#include "spine.glsl"
#include "lines.glsl"

void main() {
    uint i = dp_item();
    if (i >= min(counters[4], candidates_room)) return;
    Candidate c = candidates[i];
    Spine s;
    lines[i].first = NONE;
    if (!spine_of(c, s)) return;
    uint count = (s.n + 31u) / 32u, first = atomicAdd(counters[7], count);
    if (first + count > words_room) return;
    for (uint w = 0u; w < count; w++) words[first + w] = uvec2(i, 0u);
    lines[i] = Line(array_of(s.a), array_of(s.b), array_of(s.probe_a), array_of(s.probe_b), s.n,
                    first, uint(s.asks_back), 0u);
}
