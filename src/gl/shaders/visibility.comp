// Which sample points of candidates are visible, and the segments that runs of them make.
//
//     PASS 0    a candidate: its points, if a word holds them, and its segments; else its words are listed
//     PASS 1    a listed word: its points
//     PASS 2    a candidate whose words are listed: its segments
//
// So a line as long as the picture is no more work for one invocation than a short one. A word is 32 points.
#define COMPUTE 64
#include "spine.glsl"
#include "hide.glsl"

struct Segment { // dp_gl_segment
    vec3 a;
    uint line;
    vec3 b;
    uint triangle, other, edge, k0, k1, n, hider[2], seen;
};
struct Word {
    uint candidate, number, of, bits; // the word's number in its candidate's spine, of so many
};
layout(std430, binding = 4) buffer Counters { uint counters[]; };
layout(std430, binding = 5) readonly buffer Candidates { Candidate candidates[]; };
layout(std430, binding = 6) writeonly buffer Segments { Segment segments[]; };
layout(std430, binding = 7) buffer Words { Word words[]; };

uniform uint candidates_room, words_room;

const uint ENDS = 0xFFFFFFFEu; // instead of a hider: the edge ends, or leaves the picture

// A candidate as it is asked for.
struct Line {
    Candidate c;
    Spine s;
    uint a, b;     // polygons
    bool asks_back; // it is seen only where back faces are
};
bool line_of(uint number, out Line l) {
    l.c = candidates[number];
    if (!spine_of(l.c, l.s)) return false;
    l.a = polygon_of(l.c.a), l.b = l.c.b == NONE ? NONE : polygon_of(l.c.b);
    l.asks_back = (l.c.line == RIDGE || l.c.line == VALLEY) && l.c.b != NONE && !is_front(l.c.a) &&
                  !is_front(l.c.b);
    l.c.k1 = min(l.c.k1, l.s.n);
    return true;
}

bool is_back_seen(vec2 at) {
    ivec2 p = ivec2(floor(at - 0.5));
    for (int k = 0; k < 4; k++) {
        ivec2 q = p + ivec2(k & 1, k >> 1);
        for (int i = 0; i < SAMPLES && is_in_picture(q); i++) {
            uint id = id_at(q, i);
            if (is_triangle(id) && about(id - 1u, at).area > 0.0) return true;
        }
    }
    return false;
}

// Is point k of the line visible? If not: what hides it, or ENDS where it lies beside the picture.
bool is_visible(Line l, uint k, out uint hider) {
    dvec3 p = probe_of(l.s, k);
    hider = ENDS;
    if (!(p.x >= 0.0 && p.y >= 0.0 && p.x < double(picture.size.x) && p.y < double(picture.size.y)))
        return false;
    double slack = is_perspective() ? SLACK * p.z / picture.forward.w : SLACK / picture.forward.w;
    if (is_hidden(Query(vec2(p.xy), float(p.z + slack), l.a, l.b), hider)) return false;
    return !l.asks_back || is_back_seen(vec2(p.xy));
}
uint word_of(Line l, uint number) {
    uint bits = 0u, first = 32u * number, last = min(first + 32u, l.c.k1), hider;
    for (uint k = max(first, l.c.k0); k < last; k++)
        if (is_visible(l, k, hider)) bits |= 1u << (k - first);
    return bits;
}

uint hider_beyond(Line l, uint k, bool ends) {
    uint hider = ENDS;
    if (!ends && is_visible(l, k, hider)) hider = NONE; // the candidate ends there, the edge does not
    return hider;
}
void put_segment(Line l, uint k0, uint k1) {
    uint at = atomicAdd(counters[1], 1u);
    if (at >= picture.counts.w) return;
    precise dvec3 a = l.s.a + (l.s.b - l.s.a) * (double(k0) / double(l.s.n)),
                  b = l.s.a + (l.s.b - l.s.a) * (double(k1) / double(l.s.n));
    Segment s;
    s.a = vec3(a), s.b = vec3(b);
    s.line = l.c.line, s.triangle = l.c.a, s.other = l.c.b, s.edge = l.c.edge;
    s.k0 = k0, s.k1 = k1, s.n = l.s.n;
    s.hider[0] = hider_beyond(l, k0 - 1u, k0 == 0u);
    s.hider[1] = hider_beyond(l, k1, k1 == l.s.n);
    s.seen = (l.c.seen & 3u) | group_of(l.c.a) << 16;
    segments[at] = s;
}

// Runs of visible points. `at`: the first of its words in the list; NONE: `bits` are all there are.
void put_segments(Line l, uint at, uint bits) {
    uint start = NONE, count = (l.s.n + 31u) / 32u;
    for (uint w = 0u; w < count; w++) {
        uint here = at == NONE ? bits : words[at + w].bits;
        if (here == 0u && start == NONE) continue;
        if (here == NONE && start != NONE) continue;
        for (uint i = 0u; i < 32u; i++) {
            bool visible = (here >> i & 1u) != 0u;
            if (visible && start == NONE) start = 32u * w + i;
            if (!visible && start != NONE) {
                put_segment(l, start, 32u * w + i);
                start = NONE;
            }
        }
    }
    if (start != NONE) put_segment(l, start, l.s.n);
}

#if PASS == 0
void list_words(uint number, uint count) {
    uint at = atomicAdd(counters[7], count);
    for (uint i = 0u; i < count && at + count <= words_room; i++)
        words[at + i] = Word(number, i, count, 0u);
}
void main() {
    uint i = dp_item();
    Line l;
    if (i >= min(counters[4], candidates_room) || !line_of(i, l)) return;
    if (l.s.n > 32u) list_words(i, (l.s.n + 31u) / 32u);
    else put_segments(l, NONE, word_of(l, 0u));
}
#else
void main() {
    uint i = dp_item();
    Line l;
    if (i >= min(counters[7], words_room)) return;
    Word w = words[i];
#if PASS == 1
    if (line_of(w.candidate, l)) words[i].bits = word_of(l, w.number);
#else
    if (w.number == 0u && line_of(w.candidate, l)) put_segments(l, i, 0u);
#endif
}
#endif
