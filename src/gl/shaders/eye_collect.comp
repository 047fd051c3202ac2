// The half-edges that are looked at, each once: those that are disputed, and their mates. Of polygons that have an edge
// there the first draws the line.
#define COMPUTE 64
#include "eye.glsl"

layout(std430, binding = 4) readonly buffer Counters { uint counters[]; };
layout(std430, binding = 5) writeonly buffer LookedAt { Looked looked[]; };
layout(std430, binding = 6) readonly buffer Disputed { uint disputed[]; };
layout(std430, binding = 7) readonly buffer Mates { uint mates[]; };

bool is_seen_end_on(uint half_edge) {
    dvec3 a = dvec3(world_of(corners[half_edge])), b = dvec3(world_of(corners[next_in(half_edge)]));
    return !(length(cross_of(view_vector(a + (b - a) * 0.5LF), unit(b - a))) > 1e-9LF);
}

uint flags_of(uint half_edge, uint partner) {
    uint flags = is_diagonal(half_edge) ? NO_FOLD : 0u;
    for (uint i = 0u; i < 2u; i++) {
        uint polygon = i == 0u ? first_of(half_edge / 3u) : partner;
        if (polygon == NONE) break;
        Facing f = polygon_facing(polygon, corner_count(polygon));
        flags |= (f.front ? OWN_FRONT : 0u) << (2u * i) | (f.edge_on ? OWN_EDGE_ON : 0u) << (2u * i);
    }
    return flags;
}
void look_at(uint half_edge, uint mate) {
    uint bit = 1u << (half_edge % 32u), at = head.emerging_at + half_edge / 32u;
    if ((atomicOr(words[at], bit) & bit) != 0u) return;
    Spine s = spine_of(half_edge);
    if (!s.is_there || is_seen_end_on(half_edge)) return;
    uvec2 range = range_of(s, 0.5LF);
    if (range.x >= range.y) return;
    uint partner = is_mate(mate) ? first_of(mate_of(mate) / 3u) : NONE;
    Looked e = Looked(half_edge, partner, range.x, range.y, s.n, 0u, 0u, flags_of(half_edge, partner));
    uint places = places_of(e);
    e.place = atomicAdd(head.places, places);
    if (e.place + places > head.places_room) e.k1 = e.k0, places = 0u; // there is no room
    e.chunk = atomicAdd(head.chunks, (places + CHUNK - 1u) / CHUNK);
    uint number = atomicAdd(head.looked, 1u);
    if (number < head.looked_room) looked[number] = e;
}

void main() {
    uint i = dp_item();
    if (i >= min(counters[5], head.disputed_room)) return;
    uvec2 pair = uvec2(disputed[i], NONE);
    if (head.all_edges == 0u) pair.y = mates[pair.x];
    for (uint k = 0u; k < 2u; k++) {
        look_at(pair.x, pair.y);
        if (!is_mate(pair.y)) return;
        pair = uvec2(mate_of(pair.y), pair.x);
    }
}
