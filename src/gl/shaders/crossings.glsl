// What the passes of crossings.c share.
#include "crossing.glsl"

// The same in crossings.c (crossing_head).
struct CrossingHead {
    uint pairs, nodes, pairs_room, nodes_room; // the first two: wanted
    uint slots, cells_x, cells_y, candidates_room;
    uvec4 groups;
};
// Slots of the table of pairs, 1 + number; then lists of cells, 1 + node.
layout(std430, binding = 3) coherent buffer Crossings {
    CrossingHead head;
    uint words[];
};
// Two polygons, a < b, and where they cross on the screen: x, y, d, and the number of sample points; 0: they do not.
struct Pair {
    uint a, b, next, n;
    vec4 p, q;
};
layout(std430, binding = 5) coherent buffer Pairs { Pair pairs[]; };

const float CELL = 16.0; // px

uvec2 cell_at(vec2 px) {
    return uvec2(clamp(ivec2(floor(px / CELL)), ivec2(0), ivec2(head.cells_x, head.cells_y) - 1));
}
uint list_of(uvec2 cell) { return head.slots + cell.y * head.cells_x + cell.x; }
// Places along a crossing, at most half a cell apart: 0 to n.
uint steps_of(Pair x) {
    return min(uint(length(x.q.xy - x.p.xy) / (0.5 * CELL)) + 1u, 4096u);
}
// The part of it that lies in the picture.
bool clip_to_picture(inout vec2 p, inout vec2 q) {
    vec2 e = q - p, t = vec2(0.0, 1.0);
    for (int i = 0; i < 2; i++) {
        float from = p[i], most = picture.size[i];
        if (e[i] == 0.0) {
            if (from < 0.0 || from > most) return false;
            continue;
        }
        float a = -from / e[i], b = (most - from) / e[i];
        t = vec2(max(t.x, min(a, b)), min(t.y, max(a, b)));
    }
    q = p + e * t.y, p = p + e * t.x;
    return t.x < t.y;
}
