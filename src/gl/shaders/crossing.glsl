// The segment in which two polygons cross, as features/crossing.c finds it: each cut with the other's plane, and what
// the two cuts have in common.
//
//     bool crossing_of(a, b, p, q, normal)   of the polygons that triangles a and b belong to: from p to q in world
//                                            space, and the unit mean of the normals turned to the eye
//
// Not handled: polygons in one plane, and those that merely touch; they do not cross.
#include "polygons.glsl"
#include "facing.glsl"

struct Cut {
    dvec3 from, to;
    uint edge[2]; // of the polygon, at these ends
    bool found, is_cut; // is_cut: as it is found, but for how far it reaches to both sides
};
Cut cut_of(uint first, uint n, dvec3 at, dvec3 normal, double flat_) {
    Cut c = Cut(dvec3(0.0), dvec3(0.0), uint[2](0u, 0u), false, false);
    int ends = 0;
    double least = 0.0, most = 0.0;
    dvec3 a = corner_at(first, 0u);
    double da = dot(a - at, normal);
    for (uint i = 0u; i < n; i++) {
        dvec3 b = corner_at(first, i + 1u == n ? 0u : i + 1u);
        double db = dot(b - at, normal);
        least = min(least, da), most = max(most, da);
        if ((da < 0.0) != (db < 0.0)) {
            dvec3 q = a + (b - a) * (da / (da - db));
            if (ends == 0) c.from = q, c.edge[0] = i;
            else c.to = q, c.edge[1] = i;
            ends++;
        }
        a = b, da = db;
    }
    c.is_cut = ends == 2;
    c.found = c.is_cut && least < -flat_ && most > flat_;
    return c;
}
double reach_of(uint first, uint n) {
    dvec3 o = corner_at(first, 0u);
    double most = 0.0;
    for (uint i = 1u; i < n; i++) most = max(most, length(corner_at(first, i) - o));
    return most;
}

const double SUNK = 0.01; // pixel sizes: what is sunk by less touches

// A corner nearer than this to a plane lies in it.
double flatness_of(uint a, uint na, uint b, uint nb) {
    double ra = reach_of(a, na), rb = reach_of(b, nb);
    dvec3 at = corner_at(ra < rb ? a : b, 0u);
    double away = dot(picture.sight.xyz, at) + picture.sight.w,
           pixel = (is_perspective() ? max(away, 0.0) : 1.0) / picture.forward.w;
    return max(1e-6 * min(ra, rb), SUNK * pixel);
}
dvec3 turned_to_eye(dvec3 normal, dvec3 at) {
    return dot(normal, view_vector(at)) > 0.0 ? -normal : normal;
}

struct Crossing {
    dvec3 p, q, normal;
    // What ends it at p and at q: an edge of polygon a, or of b (bit 31).
    uint edge[2];
    bool goes_on; // it may be too short to cross here, but leads on by these edges
};
const uint OF_B = 0x80000000u;

// `first`: of two polygons.
bool cross_polygons(uint a, uint b, out Crossing x) {
    uint na = corner_count(a), nb = corner_count(b);
    dvec3 normal_a = normal_of(a, na), normal_b = normal_of(b, nb),
          line = cross_of(normal_a, normal_b);
    x = Crossing(dvec3(0.0), dvec3(0.0), dvec3(0.0), uint[2](0u, 0u), false);
    if (!(length(line) >= 1e-6)) return false; // the same plane, within rounding
    double flat_ = flatness_of(a, na, b, nb);
    Cut ca = cut_of(a, na, corner_at(b, 0u), normal_b, flat_);
    if (!ca.is_cut) return false;
    Cut cb = cut_of(b, nb, corner_at(a, 0u), normal_a, flat_);
    if (!cb.is_cut) return false;
    dvec3 u = unit(line), o = ca.from;
    double a0 = 0.0, a1 = dot(ca.to - o, u), b0 = dot(cb.from - o, u), b1 = dot(cb.to - o, u);
    uvec2 ea = uvec2(ca.edge[0], ca.edge[1]), eb = uvec2(cb.edge[0], cb.edge[1]) | OF_B;
    if (a0 > a1) a0 = a1, a1 = 0.0, ea = ea.yx;
    if (b0 > b1) {
        double swap = b0;
        b0 = b1, b1 = swap, eb = eb.yx;
    }
    double t0 = max(a0, b0), t1 = min(a1, b1);
    x.edge[0] = a0 >= b0 ? ea.x : eb.x, x.edge[1] = a1 <= b1 ? ea.y : eb.y;
    x.goes_on = t1 - t0 > -flat_;
    x.p = o + t0 * u, x.q = o + t1 * u;
    x.normal = unit(turned_to_eye(normal_a, x.p) + turned_to_eye(normal_b, x.p));
    return ca.found && cb.found && t1 - t0 > flat_;
}

bool crossing_of(uint a, uint b, out dvec3 p, out dvec3 q, out dvec3 normal) {
    Crossing x;
    bool crosses = cross_polygons(first_of(a), first_of(b), x);
    p = x.p, q = x.q, normal = x.normal;
    return crosses;
}
