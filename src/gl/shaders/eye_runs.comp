// Runs of sample points with one answer become lines: find/emerge.c, core/fold.c.
#define COMPUTE 64
#define EYE_ACCESS readonly
#include "eye.glsl"
#include "candidates.glsl"

layout(std430, binding = 4) readonly buffer LookedAt { Looked looked[]; };
layout(std430, binding = 5) buffer Counters { uint counters[]; };
layout(std430, binding = 6) readonly buffer Findings { uvec4 findings[]; };
layout(std430, binding = 7) writeonly buffer Candidates { Candidate candidates[]; };

const uint NO_LINE = 5u;
const double ONE_PLANE = 0.9999995LF;
const double COS_ROUNDING = 0.99999999984769129LF, SIN_ROUNDING = 1.7453292511082803e-5LF; // 1e-3 degrees

// The edge as the eye sees it (core/fold.h: dp_sight).
struct Sight {
    dvec3 along, right, away;
};
Sight sight_of(uint half_edge) {
    dvec3 a = dvec3(world_of(corners[half_edge])), b = dvec3(world_of(corners[next_in(half_edge)]));
    Sight s;
    s.along = unit(b - a);
    s.right = unit(cross_of(view_vector(a + (b - a) * 0.5LF), s.along));
    s.away = cross_of(s.along, s.right);
    return s;
}
struct Beside {
    dvec3 normal; // turned to the eye
    double recedes;
};
Beside beside_of(Sight s, uint polygon, bool front) {
    Beside b;
    b.normal = normal_of(polygon, corner_count(polygon));
    if (!front) b.normal = -b.normal;
    b.recedes = dot(b.normal, s.right) / max(-dot(b.normal, s.away), 1e-12LF);
    return b;
}

// By the dihedral angle: 180 degrees less the angle between the normals where the fold is convex, or more by it.
uint fold_line(Beside left, Beside right) {
    double sine = length(cross_of(left.normal, right.normal)), cosine = dot(left.normal, right.normal),
           l = sqrt(sine * sine + cosine * cosine);
    bool concave = left.recedes > right.recedes;
    double c = l > 0.0LF ? cosine / l : 1.0LF;
    double ridge_cos = picture.angles.x * COS_ROUNDING - picture.angles.y * SIN_ROUNDING,
           ridge_sin = picture.angles.y * COS_ROUNDING + picture.angles.x * SIN_ROUNDING,
           valley_cos = picture.angles.z * COS_ROUNDING - picture.angles.w * SIN_ROUNDING,
           valley_sin = picture.angles.w * COS_ROUNDING + picture.angles.z * SIN_ROUNDING;
    bool ridge = ridge_sin >= 0.0LF ? !concave && c <= -ridge_cos : !concave || c >= -ridge_cos;
    bool valley = valley_sin >= 0.0LF ? concave || c > -valley_cos : concave && c < -valley_cos;
    return ridge ? RIDGE : valley ? VALLEY : NO_LINE;
}

// Of what is seen on both sides, or on one side and behind it.
uint line_of(uvec4 f, Looked e, Sight s) {
    bool fold = f.x != NONE && f.y != NONE;
    uvec2 polygon = uvec2(f.x != NONE ? f.x : f.y, fold ? f.y : f.z),
          front = uvec2(f.x != NONE ? f.w >> 1 : f.w >> 2, fold ? f.w >> 2 : f.w >> 3) & 1u;
    bool border = !fold && (f.z == NONE || f.z == polygon.x);
    Beside sides[2];
    for (int i = 0; i < 2 && f.w != 0u && !border; i++)
        sides[i] = beside_of(s, polygon[i], front[i] != 0u);
    if (f.w == 0u || (fold && (e.flags & NO_FOLD) != 0u)) return NO_LINE;
    if (fold) return fold_line(sides[0], sides[1]);
    if (!border)
        border = front.x == front.y && dot(sides[0].normal, sides[1].normal) > ONE_PLANE;
    bool goes_on = e.partner != NONE && (e.flags & (OWN_EDGE_ON | PARTNER_EDGE_ON)) != 0u;
    return border && !goes_on ? BORDER : SILHOUETTE;
}

// A finding and what it means.
struct Found {
    uvec4 of;
    uint line;
};

void add_run(Looked e, Found f, uint k0, uint k1) {
    if (f.line == NO_LINE || k0 >= k1 || !draws(f.line)) return;
    if (f.line == BORDER && k1 - k0 == 1u && e.n > SHORT) return; // a dot
    uint owner = first_of(e.half_edge / 3u);
    uint other = f.of.x == owner || f.of.x == NONE ? f.of.y : f.of.x;
    uint across = other != NONE && other != owner ? other : f.of.z != owner ? f.of.z : NONE;
    uint seen = uint(f.of.x == owner || f.of.y == owner) |
                uint(across != NONE && (f.of.x == across || f.of.y == across)) << 1;
    uint at = atomicAdd(counters[4], 1u);
    if (at < head.candidates_room)
        candidates[at] = Candidate(f.line, e.half_edge / 3u, e.half_edge % 3u, across, k0, k1, seen, 0u);
}

bool is_same(Found a, Found b) {
    if (a.line != b.line || a.line == NO_LINE) return a.line == b.line;
    return a.of == b.of;
}

Found found_at(Looked e, Sight s, uint k, Found before) {
    uvec4 f = findings[e.place + (k - e.k0) / step_of(e.n)];
    return f == before.of ? before : Found(f, line_of(f, e, s));
}
// A single point that differs from two neighbours that agree, or from its neighbour at the edge's end, follows them.
Found settled(Looked e, uint k, Found before, Found here, Found after) {
    if (e.n < 3u) return here;
    if (k == 0u) return after;
    if (k + 1u == e.n) return before;
    return is_same(before, after) ? before : here;
}

void main() {
    uint i = dp_item();
    if (i >= min(head.looked, head.looked_room)) return;
    Looked e = looked[i];
    if (e.k0 >= e.k1) return;
    Sight s = sight_of(e.half_edge);
    Found none = Found(uvec4(NONE, NONE, NONE, 0u), NO_LINE), last = none, before = none, here = none;
    uint start = e.k0;
    for (uint next = e.k0; next <= e.k1 + 1u; next++) { // the one after `here`, which is next - 1
        uint k = next - 1u;
        Found after = next < e.k1 ? found_at(e, s, next, here) : here, f = none;
        if (next == e.k0) before = after;
        else if (k < e.k1) f = settled(e, k, before, here, after);
        if (next > e.k0 && (k == e.k1 || !is_same(f, last))) {
            add_run(e, last, start, k);
            last = f, start = k;
        }
        if (next > e.k0) before = here;
        here = after;
    }
}
