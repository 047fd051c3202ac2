// What the passes of emerge.c share: the store, edges on the screen, and how polygons lie there.
#include "clip.glsl"
#include "polygons.glsl"
#include "facing.glsl"

// The same in emerge.c (eye_head).
struct Head {
    uint looked, chunks, places, nodes; // wanted; where that is more than there is room for, the passes run again
    uint looked_room, chunks_room, places_room, nodes_room;
    uint cells_x, cells_y, emerging_at, cells_at, lists_at, candidates_room, disputed_room, all_edges;
    float touching, crack, precision_;
    uint tiles_at;
    uint suspects, suspects_room, free_[2];
    uvec4 groups[8]; // arguments of indirect dispatches
};
#ifndef EYE_ACCESS
#define EYE_ACCESS
#endif
// Bits of half-edges that have made lines, from word 0 on, and of those that are looked at; of cells in which there are sample
// points; of tiles that show back faces; each cell's list, 1 + node.
layout(std430, binding = 3) EYE_ACCESS buffer Eye {
    Head head;
    uint words[];
};

// A half-edge that is looked at.
struct Looked {
    uint half_edge, partner; // polygon across, NONE: none is known
    uint k0, k1, n;          // sample points in the picture, of n
    uint place, chunk;       // its first
    uint flags;
};
// Of its flags: a diagonal, an outline at most; how its polygon and the partner lie to the eye.
const uint NO_FOLD = 1u, OWN_FRONT = 2u, OWN_EDGE_ON = 4u, PARTNER_FRONT = 8u, PARTNER_EDGE_ON = 16u;

// In a cell's list: a polygon, and its plane about the cell's middle.
struct Node {
    uint polygon, next;
    float d, dx, dy;
    uint flags, corners, free_;
};
const uint FRONT = 1u, CLIPPED = 2u;

const int CELL = 8;           // px
const uint CHUNK = 32u;       // places, for one invocation
const uint SHORT = 8u;        // of edges this short, in sample points, every other one will do
const float NEAR = 0.002;     // px from the edge at which it is looked
const float OVER = 0.3, OVER_STEEPEST = 3.0; // find/emergence.h

uint step_of(uint n) { return n <= SHORT ? 2u : 1u; }
uint places_of(Looked e) { return (e.k1 - e.k0 + step_of(e.n) - 1u) / step_of(e.n); }

bool has_bit(uint at, uint bit) { return (words[at + bit / 32u] >> (bit % 32u) & 1u) != 0u; }
bool is_drawn(uint half_edge) { return has_bit(0u, half_edge); }
bool emerges(uint half_edge) { return has_bit(head.emerging_at, half_edge); }

uvec2 cell_of(vec2 px) {
    return uvec2(clamp(ivec2(floor(px)) / CELL, ivec2(0), ivec2(head.cells_x, head.cells_y) - 1));
}
uint cell_number(uvec2 cell) { return cell.y * head.cells_x + cell.x; }
// Of the CPU's tiles, 64 px wide, in which a pixel lies.
uint tile_of(uvec2 pixel) { return pixel.y / 64u * ((head.cells_x + 7u) / 8u) + pixel.x / 64u; }
dvec2 middle_of(uvec2 cell) { return dvec2(cell * uint(CELL)) + double(CELL / 2); }

// ------- edges on the screen: core/spine.c -------

struct Spine {
    dvec3 a, b; // x, y, d
    uint n;     // sample points: k is (k + 1/2) / n of the way along
    bool is_there;
};
ClipPoint mixed(ClipPoint a, ClipPoint b, double t) {
    return ClipPoint(a.c + (b.c - a.c) * t, a.distance + (b.distance - a.distance) * t);
}
Spine spine_of(uint half_edge) {
    ClipPoint a = to_clip(world_of(corners[half_edge])),
              b = to_clip(world_of(corners[next_in(half_edge)]));
    Spine s = Spine(dvec3(0.0), dvec3(0.0), 0u, false);
    double t0 = 0.0, t1 = 1.0;
    if (!is_inside(a) || !is_inside(b)) {
        for (int plane = 0; plane < 6; plane++) {
            double da = inside(plane, a), db = inside(plane, b);
            if (!(da >= 0.0) && !(db >= 0.0)) return s;
            if (da < 0.0) t0 = max(t0, da / (da - db));
            if (db < 0.0) t1 = min(t1, da / (da - db));
        }
        if (!(t0 < t1) || !(mixed(a, b, t0).c.w > 0.0) || !(mixed(a, b, t1).c.w > 0.0)) return s;
    }
    s.a = to_screen(t0 > 0.0 ? mixed(a, b, t0) : a), s.b = to_screen(t1 < 1.0 ? mixed(a, b, t1) : b);
    precise dvec2 e = s.b.xy - s.a.xy;
    precise double l = sqrt(e.x * e.x + e.y * e.y);
    s.n = l > 0.25 ? uint(ceil(l / 0.25)) : 1u;
    s.is_there = l - l == 0.0;
    return s;
}
void cut_range(double from, double to, double lo, double hi, inout double t0, inout double t1) {
    double by = to - from;
    if (by == 0.0) {
        if (from < lo || from > hi) t1 = -1.0;
        return;
    }
    double a = (lo - from) / by, b = (hi - from) / by;
    t0 = max(t0, min(a, b)), t1 = min(t1, max(a, b));
}
// Sample points [x, y) in the picture, or within `beside` px of it.
uvec2 range_of(Spine s, double beside) {
    double t0 = 0.0, t1 = 1.0, n = double(s.n);
    cut_range(s.a.x, s.b.x, -beside, double(picture.size.x) + beside, t0, t1);
    cut_range(s.a.y, s.b.y, -beside, double(picture.size.y) + beside, t0, t1);
    if (t0 > t1) return uvec2(0u);
    double from = ceil(t0 * n - 0.5), to = floor(t1 * n - 0.5) + 1.0;
    return uvec2(from > 0.0 ? uint(from) : 0u, to < n ? uint(max(to, 0.0)) : s.n);
}

// A sample point of an edge (find/emergence.h: dp_lookout).
struct Lookout {
    dvec2 at; // px
    float d;
    vec2 right;  // px: unit vector to the right of the edge on the screen
    float along; // change of depth per px along the edge
};
Lookout lookout_at(Spine s, double k) {
    dvec3 p = s.a + (s.b - s.a) * (k / double(s.n));
    dvec2 e = s.b.xy - s.a.xy;
    double l = length(e);
    return Lookout(p.xy, float(p.z), l > 0.0 ? vec2(dvec2(-e.y, e.x) / l) : vec2(1.0, 0.0),
                   l > 0.0 ? float((s.b.z - s.a.z) / l) : 0.0);
}
Lookout place_of_edge(Looked e, Spine s, uint place) {
    uint by = step_of(e.n), k = e.k0 + place * by;
    return lookout_at(s, double(k) + (k + by <= e.k1 ? double(by) : 1.0) * 0.5);
}

// ------- polygons -------

Facing polygon_facing(uint first, uint n) {
    if (n == 3u) return facing_of(first);
    vec4 o = screen_of(vertex_at(first, 0u));
    precise double area = 0.0;
    double reach = 0.0;
    precise dvec2 a = dvec2(0.0);
    bool off = is_off_screen(o);
    for (uint i = 1u; i < n; i++) {
        vec4 v = screen_of(vertex_at(first, i));
        off = off || is_off_screen(v);
        precise dvec2 b = dvec2(v.xy) - dvec2(o.xy);
        area += a.x * b.y - a.y * b.x;
        reach = max(reach, max(abs(b.x), abs(b.y)));
        a = b;
    }
    if (!off && abs(area) > double(picture.step_.z) * reach) return Facing(area < 0.0, false);
    bool thin = !off && abs(area) <= EDGE_ON * reach;
    double sine = dot(normal_of(first, n), view_vector(corner_at(first, 0u)));
    return Facing(sine < (thin ? -SEEN_EDGE_ON : -1e-12), thin);
}
bool is_clipped(uint first, uint n) {
    bool off = false;
    for (uint i = 0u; i < n; i++) off = off || is_off_screen(screen_of(vertex_at(first, i)));
    return off;
}

// d at a place on the screen, and its change per px.
vec3 plane_about(dvec3 normal, dvec3 on, dvec2 place) {
    double x = dot(normal, picture.across.xyz), y = dot(normal, picture.down.xyz), k, d;
    if (is_perspective()) {
        k = dot(normal, on - picture.eye.xyz), k = k != 0.0 ? 1.0 / k : 0.0;
        d = dot(normal, picture.corner.xyz - picture.eye.xyz) * k;
    } else {
        k = dot(normal, picture.forward.xyz) / length(picture.sight.xyz), k = k != 0.0 ? 1.0 / k : 0.0;
        d = 1.0 + dot(normal, picture.corner.xyz - on) * k;
    }
    return vec3(d + (x * place.x + y * place.y) * k, x * k, y * k);
}

// The depth by which a plane may miss a point at depth d and still pass through it.
float touching_of(vec2 slope, float d) {
    return head.touching * (abs(depth_steps(d, 1.0)) + abs(slope.x) + abs(slope.y));
}
float over_of(vec2 slope, float d) {
    float by = abs(depth_steps(d, 1.0)), s = abs(slope.x) + abs(slope.y);
    return s <= OVER_STEEPEST * by ? OVER * (by + s) : 0.0;
}
// Does the plane hold the edge, not only the point?
bool holds_edge(vec2 slope, Lookout at, bool shares_corner) {
    float turn = slope.x * at.right.y - slope.y * at.right.x - at.along,
          scale = abs(depth_steps(at.d, 1.0)) + abs(slope.x) + abs(slope.y);
    return abs(turn) <= (head.precision_ > 0.0 ? 0.1 : shares_corner ? 2e-3 : 0.05) * scale;
}

uint key_at(uint vertex) { return floatBitsToUint(vertices[vertex].screen.w); }
// How many of the half-edge's ends are corners of the polygon, or 2 only where it has the edge.
uint shared_ends(uint first, uint n, uint half_edge) {
    uint a = key_at(corners[half_edge]), b = key_at(corners[next_in(half_edge)]), most = 0u,
         last = key_at(vertex_at(first, n - 1u));
    for (uint i = 0u; i < n; i++) {
        uint key = key_at(vertex_at(first, i)),
             shared_ = uint(key == a || key == b) + uint(last == a || last == b);
        most = max(most, shared_), last = key;
    }
    return most;
}
bool are_neighbours(uint p, uint np, uint q, uint nq) {
    for (uint i = 0u; i < np; i++) {
        uint key = key_at(vertex_at(p, i));
        for (uint k = 0u; k < nq; k++)
            if (key == key_at(vertex_at(q, k))) return true;
    }
    return false;
}

// Is `at` on the inner side of p -> q? Computed in one order of the ends, so that of two polygons that share an edge exactly
// one covers it.
bool is_inner(vec2 p, vec2 q, dvec2 at, bool front) {
    bool swap = p.y > q.y || (p.y == q.y && p.x > q.x);
    precise dvec2 s = dvec2(swap ? q : p), e = dvec2(swap ? p : q) - s, v = at - s;
    precise double side = e.x * v.y - e.y * v.x;
    return swap != front ? side < 0.0 : side >= 0.0;
}
// The same of a polygon that is clipped, in space.
bool covers_in_space(uint first, uint n, dvec2 at) {
    dvec3 normal = normal_of(first, n), on = corner_at(first, 0u),
          p = picture.corner.xyz + picture.across.xyz * at.x + picture.down.xyz * at.y,
          from = is_perspective() ? picture.eye.xyz : p,
          sight = is_perspective() ? p - picture.eye.xyz : picture.forward.xyz;
    double by = dot(normal, sight), t = dot(normal, on - from) / (by != 0.0 ? by : 1.0);
    if (by == 0.0 || (is_perspective() && t <= 0.0)) return false;
    dvec3 q = from + sight * t, a = on;
    for (uint i = 0u; i < n; i++) {
        dvec3 b = corner_at(first, i + 1u == n ? 0u : i + 1u);
        if (dot(cross_of(b - a, q - a), normal) < 0.0) return false;
        a = b;
    }
    return true;
}
bool covers(uint first, uint n, uint flags, dvec2 at) {
    if ((flags & CLIPPED) != 0u) return covers_in_space(first, n, at);
    vec2 p = screen_of(vertex_at(first, n - 1u)).xy;
    for (uint i = 0u; i < n; i++) {
        vec2 q = screen_of(vertex_at(first, i)).xy;
        if (!is_inner(p, q, at, (flags & FRONT) != 0u)) return false;
        p = q;
    }
    return true;
}

// The polygon's half-edge that bounds it and runs along here, within `reach` px; NONE: none does (find/dispute.c).
uint edge_along(uint first, uint n, uint flags, Lookout at, double reach) {
    if ((flags & CLIPPED) != 0u) return NONE;
    dvec2 a = dvec2(screen_of(vertex_at(first, 0u)).xy);
    for (uint i = 0u; i < n; i++) {
        dvec2 b = dvec2(screen_of(vertex_at(first, i + 1u == n ? 0u : i + 1u)).xy), e = b - a,
              v = at.at - a;
        double l = length(e), away = e.x * v.y - e.y * v.x, on = dot(e, v);
        uint half_edge = half_edge_at(first, n, i);
        if (abs(dot(e, dvec2(at.right))) <= 0.1 * l && abs(away) <= reach * l && on >= -reach * l &&
            on <= (l + reach) * l && may_be_line(half_edge) && !is_diagonal(half_edge))
            return half_edge;
        a = b;
    }
    return NONE;
}
// Is it nowhere thicker than what its corners are rounded by? Where that is known (core/precision.c).
bool is_sliver(uint first, uint n) {
    if (!(head.precision_ > 0.0)) return false;
    dvec3 o = corner_at(first, 0u), a = dvec3(0.0), sum = dvec3(0.0);
    double longest = 0.0;
    for (uint i = 1u; i < n; i++) {
        dvec3 b = corner_at(first, i) - o;
        sum += cross_of(a, b);
        longest = max(longest, max(length(b), length(b - a)));
        a = b;
    }
    return length(sum) <= double(head.precision_) * longest;
}
