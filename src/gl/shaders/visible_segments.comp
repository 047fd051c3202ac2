// Segments, of runs of visible points.
#define COMPUTE 64
#define NO_VERTICES
#include "scene.glsl"
#include "lines.glsl"
#include "segments.glsl"

layout(std430, binding = 3) writeonly buffer Segments { Segment segments[]; };

void put_segment(uint line, uint k0, uint k1) {
    uint at = atomicAdd(counters[1], 1u), n = lines[line].n;
    if (at >= picture.counts.w) return;
    Candidate c = candidates[line];
    dvec3 from = vector_of(lines[line].a), along = vector_of(lines[line].b) - from;
    precise dvec3 a = from + along * (double(k0) / double(n)),
                  b = from + along * (double(k1) / double(n));
    bool ends_a = k0 == 0u || !is_probe_in_picture(probe_of(line, k0 - 1u)),
         ends_b = k1 == n || !is_probe_in_picture(probe_of(line, k1));
    segments[at] = Segment(vec3(a), c.line, vec3(b), c.a, c.b, c.edge, k0, k1, n,
                           uint[2](ends_a ? ENDS : NONE, ends_b ? ENDS : NONE),
                           (c.seen & 3u) | group_of(c.a) << 16);
}

void main() {
    uint line = dp_item();
    if (line >= min(counters[4], candidates_room)) return;
    uint first = lines[line].first, n = lines[line].n, start = NONE;
    if (first == NONE) return;
    for (uint k = 0u; k <= n; k++) {
        uint bits = k < n ? words[first + k / 32u].y : 0u;
        if (k % 32u == 0u && k + 32u <= n && bits == (start == NONE ? 0u : NONE)) {
            k += 31u; // nothing changes in this word
            continue;
        }
        bool visible = (bits >> k % 32u & 1u) != 0u;
        if (visible == (start != NONE)) continue;
        if (!visible) put_segment(line, start, k);
        start = visible ? k : NONE;
    }
}
