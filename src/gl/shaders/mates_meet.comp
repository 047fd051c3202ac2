// Half-edges meet in a hash table by the positions of their ends. What is left in `mates`, which began as MATE_NONE:
//
//     of the first one of an edge, which owns the slot    MATE_NONE, or the second one, or MATE_MANY
//     of every other one                                  the first
//
// mates_settle.comp makes mates of this. A triangle without area has no neighbours: those beside it meet.
#define COMPUTE 64
#include "mates.glsl"
#include "sides.glsl"

layout(std430, binding = 4) buffer Slots { uint slots[]; }; // the first half-edge, or NONE
layout(std430, binding = 5) readonly buffer Sides { Side sides[]; };

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

// Number of slots - 1, as in mates.c: a power of two, four a triangle at least.
uint slot_mask() {
    uint slots = 1024u;
    while (slots < 0x80000000u && slots / 4u < picture.counts.y) slots *= 2u;
    return slots - 1u;
}

// `half_edge` has the edge whose first one is `first`.
void join(uint half_edge, uint first, bool alike) {
    mates[half_edge] = first | (alike ? MATE_ALIKE : 0u);
    uint had = atomicCompSwap(mates[first], MATE_NONE, half_edge | (alike ? MATE_ALIKE : 0u));
    if (had != MATE_NONE) atomicExchange(mates[first], MATE_MANY);
}

void meet(uint half_edge) {
    uint a = corners[half_edge], b = corners[next_in(half_edge)], mask = slot_mask(),
         at = slot_of(a, b) & mask;
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
    if (t >= picture.counts.y || (sides[t].kind & SIDE_NO_AREA) != 0u) return;
    for (uint k = 0u; k < 3u; k++) meet(3u * t + k);
}
