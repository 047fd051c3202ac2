// Pairs of polygons whose planes cross in sight are asked whether they cross, each once, and from there on their neighbours,
// as the crossing leads over the surfaces.
#define COMPUTE 64
#include "crossings.glsl"

layout(std430, binding = 4) readonly buffer Mates { uint mates[]; };
layout(std430, binding = 7) readonly buffer Hits { uvec2 hits[]; };

const int STEPS = 2048;      // of a walk, each way: it ends where another one has been
const uint NO_PAIR = 0xFFFFFFFFu;

uint key_at(uint vertex) { return floatBitsToUint(vertices[vertex].screen.w); }

// The number of the pair if nobody has asked for it yet; NO_PAIR: it is known, or there is no room.
uint claim(uint a, uint b) {
    uint at = (a * 0x9e3779b1u ^ b * 0x85ebca77u), number = NO_PAIR;
    at ^= at >> 15;
    for (uint i = 0u; i < head.slots; i++) {
        uint slot = (at + i) & (head.slots - 1u), had = words[slot];
        if (had == 0u) {
            if (number == NO_PAIR) {
                number = atomicAdd(head.pairs, 1u);
                if (number >= head.pairs_room) return NO_PAIR;
                pairs[number].a = a, pairs[number].b = b, pairs[number].n = 0u;
                memoryBarrierBuffer();
            }
            had = atomicCompSwap(words[slot], 0u, number + 1u);
            if (had == 0u) return number;
        }
        if (pairs[had - 1u].a == a && pairs[had - 1u].b == b) return NO_PAIR;
    }
    return NO_PAIR;
}

uint shared_corners(uint a, uint na, uint b, uint nb) {
    uint count = 0u;
    for (uint i = 0u; i < na; i++) {
        uint key = key_at(vertex_at(a, i));
        for (uint k = 0u; k < nb; k++) count += uint(key == key_at(vertex_at(b, k)));
    }
    return count;
}

vec4 screen_at(dvec3 p) {
    ClipPoint c;
    dvec4 h = dvec4(p, 1.0);
    for (int r = 0; r < 4; r++) c.c[r] = dot(picture.clip[r], h);
    c.distance = dot(picture.sight, h);
    if (!(c.c.w > 0.0) || c.c.z < -c.c.w) return vec4(intBitsToFloat(0x7fc00000));
    return vec4(vec3(to_screen(c)), 0.0);
}

// Asks a pair that nobody has asked for; true: they cross, or nearly, and x leads on.
bool ask(uint p, uint q, out Crossing x) {
    if (p == q || shared_corners(p, corner_count(p), q, corner_count(q)) > 1u) return false;
    uint a = min(p, q), b = max(p, q), number = claim(a, b);
    if (number == NO_PAIR) return false;
    pairs[number].n = uint(cross_polygons(a, b, x));
    pairs[number].p = screen_at(x.p), pairs[number].q = screen_at(x.q);
    return x.goes_on;
}

uint half_edge_of(uint a, uint b, uint edge) {
    uint first = (edge & OF_B) != 0u ? b : a;
    return half_edge_at(first, corner_count(first), edge & ~OF_B);
}
void follow(uint a, uint b, Crossing x, int end) {
    for (int i = 0; i < STEPS; i++) {
        vec2 at = screen_at(end == 0 ? x.p : x.q).xy;
        if (!(all(greaterThan(at, vec2(-2.0))) && all(lessThan(at, picture.size.xy + 2.0)))) return;
        uint mate = mates[half_edge_of(a, b, x.edge[end])];
        if (!is_mate(mate)) return; // nothing is across the edge, or several are
        uint stays = (x.edge[end] & OF_B) != 0u ? a : b, next = first_of(mate_of(mate) / 3u);
        if (next == stays || !ask(stays, next, x)) return;
        a = min(stays, next), b = max(stays, next);
        bool from_p = half_edge_of(a, b, x.edge[0]) == mate_of(mate),
             from_q = half_edge_of(a, b, x.edge[1]) == mate_of(mate);
        if (from_p == from_q)
            from_p = distance(screen_at(x.p).xy, at) < distance(screen_at(x.q).xy, at);
        end = from_p ? 1 : 0;
    }
}

void main() {
    uint i = dp_item();
    if (i >= min(head.hits, head.hits_room)) return;
    uint a = first_of(hits[i].x), b = first_of(hits[i].y), least = min(a, b), most = max(a, b);
    Crossing x;
    if (!ask(a, b, x)) return;
    for (int end = 0; end < 2; end++) follow(least, most, x, end);
}
