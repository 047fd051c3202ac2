// Edges that may be lines are listed, once each; nearly all are too flat, and normals in float32 tell. Those of which the
// eye decides are so at once: edges that have one triangle, more than two, or are run twice the same way.
#define COMPUTE 64
#define NO_VERTICES
#include "scene.glsl"
#include "sides.glsl"

layout(std430, binding = 3) readonly buffer Mates { uint mates[]; };
layout(std430, binding = 4) readonly buffer Sides { Side sides[]; };
layout(std430, binding = 5) buffer Counters { uint counters[]; };
layout(std430, binding = 6) writeonly buffer Pairs { uint pairs[]; };
layout(std430, binding = 7) writeonly buffer Disputed { uint disputed[]; };

uniform uint pairs_room, disputed_room;

// May the edge between two that face one way, or two ways, be a line that is drawn?
bool may_be_drawn(Side a, Side b) {
    if (((a.kind ^ b.kind) & SIDE_FRONT) != 0u) return draws(SILHOUETTE);
    bool drawn = (a.kind & SIDE_FRONT) != 0u || picture.style.z == 0u; // back faces may not be
    return (draws(RIDGE) || draws(VALLEY)) && drawn &&
           !(dot(a.normal, b.normal) > picture.step_.w);
}

void dispute(uint half_edge) {
    uint at = atomicAdd(counters[5], 1u);
    if (at < disputed_room) disputed[at] = half_edge;
}

void main() {
    uint t = dp_item();
    if (t >= picture.counts.y) return;
    Side a = sides[t];
    uint bits = triangles[t].y;
    bool gone = (a.kind & SIDE_NO_AREA) != 0u; // since its mates were found: they have none now
    for (uint k = 0u; k < 3u; k++) {
        uint half_edge = 3u * t + k, mate = mates[half_edge], u = mate_of(mate) / 3u;
        bool paired = is_mate(mate), first = paired && half_edge < mate_of(mate);
        bool alike = (mate & MATE_ALIKE) != 0u, here = !gone && (bits >> k & 1u) != 0u,
             diagonal = (bits >> k + 3u & 1u) != 0u;
        if (gone && paired && may_be_line(mate_of(mate)) && !is_diagonal(mate_of(mate)))
            dispute(mate_of(mate));
        if (here && (paired ? first && alike : mate == MATE_MANY || !diagonal)) dispute(half_edge);
        if (!here || !first || alike) continue;
        Side b = sides[u];
        if ((b.kind & SIDE_NO_AREA) == 0u && may_be_drawn(a, b)) {
            uint at = atomicAdd(counters[9], 1u);
            if (at < pairs_room) pairs[at] = half_edge;
        }
    }
}
