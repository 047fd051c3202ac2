// Puts polygons into the lists of the marked cells that they touch.
#define COMPUTE 64
#include "eye.glsl"

layout(std430, binding = 4) writeonly buffer Nodes { Node nodes[]; };

struct Box {
    vec2 least, most;
};
void widen(inout Box b, vec2 p) { b.least = min(b.least, p), b.most = max(b.most, p); }

// Of what lies in the frustum.
Box box_of(uint first, uint n) {
    Box box = Box(vec2(3e38), vec2(-3e38));
    for (uint i = 0u; i < n; i++) {
        uint v = vertex_at(first, i), w = vertex_at(first, i + 1u == n ? 0u : i + 1u);
        vec4 s = screen_of(v);
        if (!is_off_screen(s)) widen(box, s.xy);
        if (!is_off_screen(s) && !is_off_screen(screen_of(w))) continue;
        ClipPoint a = to_clip(world_of(v)), b = to_clip(world_of(w));
        double da = inside(0, a), db = inside(0, b);
        if (da >= 0.0 && a.c.w > 0.0) widen(box, vec2(to_screen(a).xy));
        if ((da < 0.0) != (db < 0.0)) {
            ClipPoint c = mixed(a, b, da / (da - db));
            if (c.c.w > 0.0) widen(box, vec2(to_screen(c).xy));
        }
    }
    return box;
}

// Does one of its edges have all of the cell, widened by `reach`, on its outer side?
bool lies_apart(uint first, uint n, bool front, vec2 middle, float reach) {
    vec2 p = screen_of(vertex_at(first, n - 1u)).xy - middle;
    for (uint i = 0u; i < n; i++) {
        vec2 q = screen_of(vertex_at(first, i)).xy - middle, e = front ? q - p : p - q;
        float outer = e.x * p.y - e.y * p.x; // of the middle; y runs down
        if (-outer > (abs(e.x) + abs(e.y)) * reach + 1e-3 * (abs(e.x) + abs(e.y))) return true;
        p = q;
    }
    return false;
}

void put(uint first, uint n, uint flags, dvec3 normal, uvec2 cell) {
    uint number = cell_number(cell);
    dvec2 middle = middle_of(cell);
    if ((flags & CLIPPED) == 0u &&
        lies_apart(first, n, (flags & FRONT) != 0u, vec2(middle), float(CELL / 2) + head.crack))
        return;
    uint node = atomicAdd(head.nodes, 1u);
    if (node >= head.nodes_room) return;
    vec3 plane = plane_about(normal, corner_at(first, 0u), middle);
    uint next = atomicExchange(words[head.lists_at + number], node + 1u);
    nodes[node] = Node(first, next, plane.x, plane.y, plane.z, flags, n, 0u);
}

void main() {
    uint first = dp_item();
    if (first >= picture.counts.y ||
        (first > 0u && polygon_of(first - 1u) == polygon_of(first)))
        return;
    uint n = corner_count(first);
    Box box = box_of(first, n);
    vec2 reach = vec2(head.crack + 0.01);
    if (!(box.least.x <= box.most.x) || any(lessThan(box.most, -reach - 1.0)) ||
        any(greaterThan(box.least, picture.size.xy + reach + 1.0)))
        return;
    uvec2 from = cell_of(max(box.least - reach, vec2(-1.0))),
          to = cell_of(min(box.most + reach, picture.size.xy + 1.0));
    bool known = false;
    uint flags = 0u;
    dvec3 normal = dvec3(0.0);
    for (uint y = from.y; y <= to.y; y++)
        for (uint x = from.x; x <= to.x; x++) {
            uint cell = cell_number(uvec2(x, y)), word = words[head.cells_at + cell / 32u];
            if (word == 0u) x += 31u - cell % 32u; // none of these
            if ((word >> (cell % 32u) & 1u) == 0u) continue;
            if (!known) {
                Facing facing = polygon_facing(first, n);
                if (facing.edge_on || is_sliver(first, n)) return;
                flags = (facing.front ? FRONT : 0u) | (is_clipped(first, n) ? CLIPPED : 0u);
                normal = normal_of(first, n);
                known = true;
            }
            put(first, n, flags, normal, uvec2(x, y));
        }
}
