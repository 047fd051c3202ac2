// What the eye sees at the sample points of an edge, to its left and to its right: find/emerge.c, look.inc.
//
//     for each sample point of a chunk
//         the polygons of its cell whose planes pass through it and that cover what lies NEAR or FAR px beside the edge
//         in the order of the source: the nearest on either side, and the furthest
#define COMPUTE 64
#define EYE_ACCESS readonly
#include "eye.glsl"
#include "ids.glsl"

layout(std430, binding = 4) readonly buffer LookedAt { Looked looked[]; };
layout(std430, binding = 5) readonly buffer Chunks { uint chunks[]; };
layout(std430, binding = 6) readonly buffer Nodes { Node nodes[]; };
// By place: the polygons seen to the left and to the right, and the one furthest behind an outline; NONE: none. w: bit 0,
// there is a line of this edge; bits 1 to 3: these face the eye.
layout(std430, binding = 7) writeonly buffer Findings { uvec4 findings[]; };

const float OFF = 0.25, NEARER = 1e-3, BEYOND = 1e5;
const uint LEFT = 0u, RIGHT = 1u;

// An edge of a polygon, NONE: none along here.
struct EdgeOf {
    uint polygon, half_edge;
};
struct Beheld {
    EdgeOf nearest[2], first;
    uint furthest[2];
    float nearest_d[2], furthest_d[2];
    bool is_hidden, is_drawn, front[2], furthest_front[2];
};
// The edge that is looked at.
struct Own {
    uint polygon, corners, half_edge, partner, flags;
};

void keep_nearest(inout Beheld b, uint side, EdgeOf here, bool front, float d, float rounding) {
    uint had = b.nearest[side].polygon;
    bool is_first = had != NONE && here.polygon < had;
    if (had != NONE && !(d > b.nearest_d[side] + rounding) &&
        !(is_first && d >= b.nearest_d[side] - rounding))
        return;
    b.nearest[side] = here, b.nearest_d[side] = d, b.front[side] = front;
}
// Of two in one plane, the one that faces another way than the nearest.
void keep_furthest(inout Beheld b, uint side, uint polygon, bool front, float d, float rounding) {
    bool there = b.furthest[side] != NONE,
         other = there && d <= b.furthest_d[side] + rounding &&
                 b.front[side] == b.furthest_front[side] && b.front[side] != front;
    if (there && !(d < b.furthest_d[side] - rounding) && !other) return;
    b.furthest[side] = polygon, b.furthest_d[side] = d, b.furthest_front[side] = front;
}

// The polygon's edge along here, by the places that it covers NEAR and FAR. Where the sides of a crack overlap, what a polygon
// covers is what it covers FAR.
uint edge_here(Node p, Lookout at, inout uint near, uint far) {
    bool overlaps = near == 3u && (far == 1u || far == 2u), beyond = near == 0u && far != 3u;
    uint half_edge = NONE;
    if (overlaps || beyond)
        half_edge = edge_along(p.polygon, p.corners, p.flags, at, 1.2 * head.crack);
    else if (near != 3u && near != 0u)
        half_edge = edge_along(p.polygon, p.corners, p.flags, at, 2.0 * NEAR);
    if (overlaps && half_edge != NONE) near = far;
    return half_edge;
}

void behold(inout Beheld b, Node p, uint sides, float gap, Lookout at, Own own) {
    float slope = p.dx * at.right.x + p.dy * at.right.y,
          rounding = abs(depth_steps(at.d, NEARER)),
          beyond = head.precision_ > 0.0 ? 0.0 : abs(depth_steps(at.d, BEYOND));
    uint near = sides & 3u, far = sides >> 2;
    bool front = (p.flags & FRONT) != 0u;
    if (gap > touching_of(vec2(p.dx, p.dy), at.d)) {
        b.is_hidden = b.is_hidden || (near == 3u && !are_neighbours(p.polygon, p.corners,
                                                                    own.polygon, own.corners));
        return;
    }
    uint half_edge = edge_here(p, at, near, far);
    if (half_edge == NONE) {
        bool shares = (p.flags & CLIPPED) == 0u &&
                      shared_ends(p.polygon, p.corners, own.half_edge) > 0u;
        if (!holds_edge(vec2(p.dx, p.dy), at, shares)) return;
    }
    for (uint side = LEFT; side <= RIGHT; side++) {
        bool is_near = (near >> side & 1u) != 0u;
        float d = gap + OFF * (side == RIGHT ? slope : -slope) - (is_near ? 0.0 : beyond);
        if (!is_near && !(near == 0u && (far >> side & 1u) != 0u && half_edge != NONE)) continue;
        keep_nearest(b, side, EdgeOf(p.polygon, half_edge), front, d, rounding);
        if (is_near || !(beyond > 0.0)) keep_furthest(b, side, p.polygon, front, d, rounding);
    }
    if (half_edge == NONE) return;
    if (p.polygon < b.first.polygon && emerges(half_edge)) b.first = EdgeOf(p.polygon, half_edge);
    b.is_drawn = b.is_drawn || is_drawn(half_edge);
}

// An edge's own polygon lies on its own side, even where it is too thin to cover a place there.
Beheld behold_own(Own own, Lookout at, vec2 slope) {
    EdgeOf none = EdgeOf(NONE, NONE), self = EdgeOf(own.polygon, own.half_edge);
    Beheld b = Beheld(EdgeOf[2](none, none), self, uint[2](NONE, NONE), float[2](0.0, 0.0),
                      float[2](0.0, 0.0), false, is_drawn(own.half_edge), bool[2](false, false),
                      bool[2](false, false));
    bool front = (own.flags & OWN_FRONT) != 0u;
    if ((own.flags & OWN_EDGE_ON) != 0u) return b;
    uint side = front ? LEFT : RIGHT;
    float d = OFF * dot(slope, side == RIGHT ? at.right : -at.right);
    b.nearest[side] = self, b.furthest[side] = own.polygon;
    b.nearest_d[side] = b.furthest_d[side] = d;
    b.front[side] = b.furthest_front[side] = front;
    return b;
}

// ------- what passes through a sample point -------

const uint MOST = 16u; // polygons at one point
struct Met {
    uint node, sides;
    float gap;
};
Met met[MOST];
uint met_count = 0u;

// Sorted by polygon.
void meet(Met m) {
    uint at = min(met_count, MOST - 1u);
    if (met_count == MOST && nodes[met[at].node].polygon < nodes[m.node].polygon) return;
    for (; at > 0u && nodes[met[at - 1u].node].polygon > nodes[m.node].polygon; at--)
        met[at] = met[at - 1u];
    met[at] = m;
    met_count = min(met_count + 1u, MOST);
}

// Those whose planes pass through the point or just over it, which a sum of two products tells; then what they cover. So
// many at a time: how many there are does not matter, nor their order.
const uint CLOSE = 48u;
uint close_[CLOSE];
uint find_close(inout uint node, vec2 from, float d, uint own) {
    uint count = 0u;
    while (node != 0u && count < CLOSE) {
        Node p = nodes[node - 1u];
        vec2 slope = vec2(p.dx, p.dy);
        float gap = p.d + dot(slope, from) - d, tolerance = touching_of(slope, d);
        if (p.polygon != own && gap >= -tolerance && gap <= max(over_of(slope, d), tolerance))
            close_[count++] = node - 1u;
        node = p.next;
    }
    return count;
}
void find_met(Lookout at, uint own) {
    uvec2 cell = cell_of(vec2(at.at));
    vec2 from = vec2(at.at - middle_of(cell)), near = NEAR * at.right, far = head.crack * at.right;
    met_count = 0u;
    for (uint node = words[head.lists_at + cell_number(cell)]; node != 0u;) {
        uint count = find_close(node, from, at.d, own);
        for (uint i = 0u; i < count; i++) {
            Node p = nodes[close_[i]];
            uint sides = 0u;
            for (uint k = 0u; k < 4u; k++) {
                vec2 side = (k & 1u) == 0u ? -(k < 2u ? near : far) : k < 2u ? near : far;
                if (covers(p.polygon, p.corners, p.flags, at.at + dvec2(side))) sides |= 1u << k;
            }
            if (sides != 0u) meet(Met(close_[i], sides, p.d + dot(vec2(p.dx, p.dy), from) - at.d));
        }
    }
}

// ------- what it means -------

// Does it face the eye? Of one that a sample shows.
bool turns_left(uint triangle) {
    vec2 a = screen_of(corners[3u * triangle]).xy, u = screen_of(corners[3u * triangle + 1u]).xy - a,
         v = screen_of(corners[3u * triangle + 2u]).xy - a;
    return u.x * v.y - u.y * v.x < 0.0;
}
// Back faces less front faces among the samples beside the edge, on one side.
int backs_beside(Lookout at, bool right) {
    int sum = 0;
    vec2 towards = right ? at.right : -at.right;
    for (uint i = 0u; i < 3u; i++) {
        ivec2 pixel = ivec2(floor(vec2(at.at) + (0.5 + float(i)) * towards));
        if (!is_in_picture(pixel)) continue;
        for (int k = 0; k < SAMPLES; k++) {
            uint id = id_at(pixel, k);
            if (is_triangle(id)) sum += turns_left(id - 1u) ? -1 : 1;
        }
    }
    return sum;
}
bool sees_backs(Lookout at) {
    uvec2 pixel = uvec2(clamp(ivec2(floor(at.at)), ivec2(0), ivec2(picture.size.xy) - 1));
    return has_bit(head.tiles_at, tile_of(pixel));
}

// May a back face be a fold of a fine mesh?
bool may_be_folded(uint polygon) {
    uint n = corner_count(polygon);
    vec2 least = vec2(3e38), most = vec2(-3e38);
    for (uint i = 0u; i < n; i++) {
        vec2 p = screen_of(vertex_at(polygon, i)).xy;
        if (p.x != p.x) return false;
        least = min(least, p), most = max(most, p);
    }
    return all(lessThanEqual(floor(most) - floor(least), vec2(4.0)));
}
// Nothing lies on the other side: an outline, with the nearest polygon and the one furthest behind it.
uvec4 outline(Beheld b, uint side, Own own, Lookout at) {
    uint near = b.nearest[side].polygon, behind = b.furthest[side];
    bool is_thin = behind == near && own.partner != NONE;
    if (is_thin) behind = near == own.polygon ? own.partner : own.polygon;
    uint far = behind == NONE ? near : behind, seen = near;
    bool near_front = b.front[side],
         far_front = far == near          ? near_front
                     : far == own.polygon ? (own.flags & OWN_FRONT) != 0u
                     : is_thin            ? (own.flags & PARTNER_FRONT) != 0u
                                          : b.furthest_front[side],
         seen_front = near_front, behind_front = far_front;
    if ((is_thin || (!near_front && may_be_folded(near))) && !near_front && far_front &&
        backs_beside(at, side == RIGHT) <= 0)
        behind = near, seen = far, behind_front = near_front, seen_front = far_front;
    if (!near_front && !far_front && !sees_backs(at)) return uvec4(NONE, NONE, NONE, 0u);
    uint fronts = uint(seen_front) << (1u + side) | uint(behind_front) << 3 | 1u;
    return side == LEFT ? uvec4(seen, NONE, behind, fronts) : uvec4(NONE, seen, behind, fronts);
}

// Which of the polygons that have an edge here makes the line: of those that are seen, else of all, the one that comes first.
uint owner_of(Beheld b) {
    EdgeOf l = b.nearest[LEFT], r = b.nearest[RIGHT];
    bool left = l.half_edge != NONE && emerges(l.half_edge),
         right = r.half_edge != NONE && emerges(r.half_edge);
    if (left && right) return r.polygon < l.polygon ? r.half_edge : l.half_edge;
    return left ? l.half_edge : right ? r.half_edge : b.first.half_edge;
}

uvec4 judge(Beheld b, Own own, Lookout at) {
    const uvec4 nothing = uvec4(NONE, NONE, NONE, 0u);
    uint left = b.nearest[LEFT].polygon, right = b.nearest[RIGHT].polygon;
    if (left == NONE && right == NONE) {
        if (b.is_drawn || b.is_hidden) return nothing;
        return uvec4(own.polygon, NONE, NONE, (own.flags & OWN_FRONT) != 0u ? 3u : 1u); // a sheet seen edge-on: both its borders are one line
    }
    if (left == right || b.is_drawn || b.is_hidden || owner_of(b) != own.half_edge) return nothing;
    if (left == NONE || right == NONE) return outline(b, left == NONE ? RIGHT : LEFT, own, at);
    return uvec4(left, right, NONE, 1u | uint(b.front[LEFT]) << 1 | uint(b.front[RIGHT]) << 2);
}

void main() {
    uint i = dp_item();
    if (i >= min(head.chunks, head.chunks_room) || chunks[i] >= head.looked_room) return;
    Looked e = looked[chunks[i]];
    Spine s = spine_of(e.half_edge);
    Own own;
    own.half_edge = e.half_edge, own.partner = e.partner;
    own.polygon = first_of(e.half_edge / 3u), own.corners = corner_count(own.polygon);
    own.flags = e.flags;
    vec2 slope = plane_about(normal_of(own.polygon, own.corners), corner_at(own.polygon, 0u), s.a.xy).yz;
    uint first = (i - e.chunk) * CHUNK, last = min(first + CHUNK, places_of(e));
    for (uint p = first; p < last; p++) {
        Lookout at = place_of_edge(e, s, p);
        find_met(at, own.polygon);
        Beheld b = behold_own(own, at, slope);
        for (uint k = 0u; k < met_count; k++)
            behold(b, nodes[met[k].node], met[k].sides, met[k].gap, at, own);
        findings[e.place + p] = judge(b, own, at);
    }
}
