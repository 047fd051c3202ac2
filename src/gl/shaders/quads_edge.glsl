// A polygon and its edges on the screen, for primitive shaders (features/features.h and features/build.c have the same): an
// edge from P_i to P_j has E = unit(P_j - P_i), and O = E x N leads out of the polygon, in its plane.
#include "clip.glsl"
#include "polygons.glsl"
#include "facing.glsl"

const double BIG = 1e300LF; // stands for infinity
bool is_big(double v) { return !(abs(v) < 1e299LF); }

const double SHORTEST = 1.0LF / 4096.0LF; // px: shorter edges have no reliable direction
const double STEEPEST = 4.0LF; // pixel sizes per px: an added polygon comes nearer by no more

// A polygon is a fan of triangles, first to last, about the first one's corner 0.
struct Polygon {
    uint first, last;
    dvec3 normal; // unit, as wound
    bool front;
};

// As facing_of, of all triangles together.
bool polygon_faces(Polygon p) {
    if (p.first == p.last) return is_front(p.first);
    vec4 o = screen_of(corners[3u * p.first]);
    bool off = is_off_screen(o);
    double area = 0.0, reach = 0.0;
    for (uint t = p.first; t <= p.last; t++) {
        vec4 b = screen_of(corners[3u * t + 1u]), c = screen_of(corners[3u * t + 2u]);
        off = off || is_off_screen(b) || is_off_screen(c);
        dvec2 u = dvec2(b.xy) - dvec2(o.xy), v = dvec2(c.xy) - dvec2(o.xy);
        area += u.x * v.y - u.y * v.x;
        reach = max(reach, max(max(abs(u.x), abs(u.y)), max(abs(v.x), abs(v.y))));
    }
    if (!off && abs(area) > double(picture.step_.z) * reach) return area < 0.0;
    bool edge_on = !off && abs(area) <= EDGE_ON * reach;
    double sine = dot(p.normal, view_vector(dvec3(world_of(corners[3u * p.first]))));
    return sine < (edge_on ? -SEEN_EDGE_ON : -1e-12LF);
}
Polygon polygon_with(uint triangle) {
    Polygon p;
    p.first = first_of(triangle);
    uint n = corner_count(p.first);
    p.last = p.first + n - 3u;
    p.normal = normal_of(p.first, n);
    p.front = polygon_faces(p);
    return p;
}
// Is it an edge of its polygon, and not one inside of the fan?
bool is_outer(Polygon p, uint half_edge) {
    uint t = half_edge / 3u, k = half_edge % 3u;
    return k == 1u || (k == 0u ? t == p.first : t == p.last);
}
uint next_outer(Polygon p, uint half_edge) {
    uint t = half_edge / 3u, k = half_edge % 3u;
    if (k == 2u) return 3u * p.first;
    return k == 0u ? half_edge + 1u : t == p.last ? half_edge + 1u : half_edge + 3u;
}

uint outcode(ClipPoint p) {
    uint code = p.c.w > 0.0 ? 0u : 1u;
    for (int i = 0; i < 6; i++)
        if (inside(i, p) < 0.0) code |= 1u << i;
    return code;
}
// False: nothing is left.
bool clip_segment(ClipPoint a, ClipPoint b, out double t0, out double t1) {
    t0 = 0.0, t1 = 1.0;
    for (int i = 0; i < 6; i++) {
        double da = inside(i, a), db = inside(i, b);
        if (da < 0.0 && db < 0.0) return false;
        if (da < 0.0) t0 = max(t0, da / (da - db));
        if (db < 0.0) t1 = min(t1, da / (da - db));
    }
    return t0 < t1 && clip_mix(a, b, t0).c.w > 0.0 && clip_mix(a, b, t1).c.w > 0.0;
}

// An edge on the screen, clipped to the guarded frustum.
struct ScreenEdge {
    bool seen;
    bool ends_outside; // the corner where it ends lies outside of the frustum
    dvec3 a, b;        // x, y, d
    double length;     // px
    dvec2 t, n;        // unit: along it, and out of the polygon
    double along;      // change of d per px along it
    double own;        // change of d per px outward, in the polygon's plane; BIG if edge-on
    double steep;      // the most change of d per px outward
    double edge_on;    // px per world unit: a plane is edge-on up to this
    dvec2 outward, normal; // motions along O and N: px outward; gain in d beyond a step along the edge
};

double depth_step(double d, double px) {
    return is_perspective() ? px * d / picture.forward.w : px / picture.forward.w;
}

// How a step along q moves a point of the edge. `inverse2`: 1 / w^2 at that point.
dvec2 motion_of(ScreenEdge e, ClipPoint c, double inverse2, dvec3 q) {
    double x = dot(picture.clip[0].xyz, q), y = dot(picture.clip[1].xyz, q),
           w = dot(picture.clip[3].xyz, q);
    dvec2 s = dvec2(0.5LF * double(picture.size.x) * (x * c.c.w - c.c.x * w) * inverse2,
                    -0.5LF * double(picture.size.y) * (y * c.c.w - c.c.y * w) * inverse2);
    double d = is_perspective() ? -w * inverse2 : -dot(picture.sight.xyz, q);
    return dvec2(dot(s, e.n), d - e.along * dot(s, e.t));
}

// How a plane leans whose points move so.
struct Lean {
    bool outward; // on the screen it leads out of the polygon: its front is seen
    double slope; // change of d per px outward; BIG if edge-on
};
Lean lean_of(ScreenEdge e, dvec2 m) {
    bool outward = m.x > e.edge_on;
    return Lean(outward, outward ? m.y / m.x : m.y > 0.0 ? BIG : -BIG);
}

dvec3 edge_direction(vec3 from, vec3 to) { return unit(dvec3(to) - dvec3(from)); }

ScreenEdge screen_edge(Polygon p, uint half_edge) {
    ScreenEdge e;
    vec3 from = world_of(corners[half_edge]), to = world_of(corners[next_in(half_edge)]);
    ClipPoint a = to_clip(from), b = to_clip(to);
    uint code_b = outcode(b);
    double t0 = 0.0, t1 = 1.0;
    e.seen = false;
    if ((outcode(a) | code_b) != 0u && !clip_segment(a, b, t0, t1)) return e;
    // ends that are not clipped keep every bit, as the polygon's own outline runs there
    ClipPoint ca = a, cb = b;
    if (t0 > 0.0) ca = clip_mix(a, b, t0);
    if (t1 < 1.0) cb = clip_mix(a, b, t1);
    e.a = to_screen(ca), e.b = to_screen(cb);
    e.ends_outside = code_b != 0u;
    dvec2 u = e.b.xy - e.a.xy;
    e.length = length(u);
    if (!(e.length > SHORTEST) || is_big(e.length + e.a.z + e.b.z)) return e;
    e.seen = true;
    e.t = u * (1.0 / e.length);
    e.n = p.front ? dvec2(-e.t.y, e.t.x) : dvec2(e.t.y, -e.t.x);
    e.along = (e.b.z - e.a.z) * (1.0 / e.length);
    e.steep = depth_step(max(e.a.z, e.b.z), STEEPEST);
    ClipPoint middle = clip_mix(ca, cb, 0.5LF);
    double inverse = 1.0 / middle.c.w;
    e.edge_on = 1e-9LF * picture.forward.w * inverse;
    e.outward = motion_of(e, middle, inverse * inverse, cross(edge_direction(from, to), p.normal));
    e.normal = motion_of(e, middle, inverse * inverse, p.normal);
    e.own = lean_of(e, e.outward).slope;
    return e;
}

// How a line is drawn: with which reach (px) and angle (cosine, sine, and whether it is above 180 degrees).
struct Pen {
    double reach, cosine, sine;
    bool reflex;
};
// How the quad at the pen's angle leans: along Q = -N sin - O cos (Raskar 2001, 2.2).
Lean quad_lean(ScreenEdge e, Pen pen) {
    return lean_of(e, -pen.sine * e.normal - pen.cosine * e.outward);
}
