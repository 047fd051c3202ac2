// Pairs of polygons whose planes cross in sight are asked whether they cross, each once, and from there on their neighbours,
// as the crossing leads over the surfaces.
#define COMPUTE 64
#include "crossings.glsl"

layout(std430, binding = 4) readonly buffer Mates { uint mates[]; };
layout(std430, binding = 7) readonly buffer Hits { uvec2 hits[]; };

const int STEPS = 64;        // of a walk, each way
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

// Asks a pair that nobody has asked for; true: they cross, and it leads on to `x`.
bool ask(uint p, uint q, out Crossing x) {
    if (p == q || shared_corners(p, corner_count(p), q, corner_count(q)) > 1u) return false;
    uint a = min(p, q), b = max(p, q), number = claim(a, b);
    if (number == NO_PAIR || !cross_polygons(a, b, x)) return false;
    pairs[number].p = screen_at(x.p), pairs[number].q = screen_at(x.q);
    pairs[number].n = 1u;
    return true;
}

// The polygon across an edge of one of two; NONE: there is none, or several.
uint across(uint first, uint edge) {
    uint mate = mates[half_edge_at(first, corner_count(first), edge)];
    return is_mate(mate) ? first_of(mate_of(mate) / 3u) : NONE;
}
void follow(uint a, uint b, Crossing x, int end) {
    vec2 at = screen_at(end == 0 ? x.p : x.q).xy;
    for (int i = 0; i < STEPS; i++) {
        if (!(all(greaterThan(at, vec2(-2.0))) && all(lessThan(at, picture.size.xy + 2.0)))) return;
        bool of_b = (x.edge[end] & OF_B) != 0u;
        uint stays = of_b ? a : b, next = across(of_b ? b : a, x.edge[end] & ~OF_B);
        if (next == NONE || next == stays || !ask(stays, next, x)) return;
        a = min(stays, next), b = max(stays, next);
        vec2 p = screen_at(x.p).xy, q = screen_at(x.q).xy; // from the end that lies there to the other
        end = distance(p, at) < distance(q, at) ? 1 : 0;
        at = end == 0 ? p : q;
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
