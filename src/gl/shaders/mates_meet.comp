// Half-edges meet in a hash table by the positions of their ends. What is left in `mates`, which began as MATE_NONE:
//
//     of the first one of an edge, which owns the slot    MATE_NONE, or the second one, or MATE_MANY
//     of every other one                                  the first
//
// mates_settle.comp makes mates of this. A triangle without area has no neighbours: those beside it meet.
#define COMPUTE 64
#include "mates.glsl"

layout(std430, binding = 4) buffer Slots { uint slots[]; }; // the first half-edge, or NONE

uniform uint mask; // number of slots - 1; that is a power of two

const uint PROBES = 4096u; // beyond these an edge has no mate

uint key_of(uint vertex) { return floatBitsToUint(vertices[vertex].screen.w); }
bool is_same(uint a, uint b) {
    return a == b || (key_of(a) == key_of(b) && world_of(a) == world_of(b));
}
// The same for both directions.
uint slot_of(uint a, uint b) {
    uint h = key_of(a) + key_of(b);
    h = (h ^ h >> 15) * 0x2c1b3c6du;
    h = (h ^ h >> 13) * 0x297a2d39u;
    return h ^ h >> 16;
}

// As dp_polygon_has_no_area; in float32 where that is enough.
bool has_area(uint triangle) {
    vec3 o = world_of(corners[3u * triangle]), u = world_of(corners[3u * triangle + 1u]) - o,
         v = world_of(corners[3u * triangle + 2u]) - o, n = cross(u, v);
    float size = max(dot(u, u), dot(v, v)), area = dot(n, n);
    if (area > 1e-6 * size * size && size > 1e-9 && area < 1e30) return true;
    dvec3 du = dvec3(world_of(corners[3u * triangle + 1u])) - dvec3(o),
          dv = dvec3(world_of(corners[3u * triangle + 2u])) - dvec3(o);
    return length(area_normal(triangle)) > 1e-12 * max(dot(du, du), dot(dv, dv));
}

// `half_edge` has the edge whose first one is `first`.
void join(uint half_edge, uint first, bool alike) {
    mates[half_edge] = first | (alike ? MATE_ALIKE : 0u);
    uint had = atomicCompSwap(mates[first], MATE_NONE, half_edge | (alike ? MATE_ALIKE : 0u));
    if (had != MATE_NONE) atomicExchange(mates[first], MATE_MANY);
}

void meet(uint half_edge) {
    uint a = corners[half_edge], b = corners[next_in(half_edge)], at = slot_of(a, b) & mask;
    for (uint i = 0u; i < PROBES; i++, at = (at + 1u) & mask) {
        uint first = atomicCompSwap(slots[at], NONE, half_edge);
        if (first == NONE) return;
        uint p = corners[first], q = corners[next_in(first)];
        bool opposed = is_same(a, q) && is_same(b, p);
        if (opposed || (is_same(a, p) && is_same(b, q))) {
            join(half_edge, first, !opposed);
            return;
        }
    }
}

void main() {
    uint t = dp_item();
    if (t >= picture.counts.y || !has_area(t)) return;
    for (uint k = 0u; k < 3u; k++) meet(3u * t + k);
}
