// As printed (Raskar 2001, 2.1 to 2.3): the ends of an edge are moved in space, projected and clipped
// (features/build.c, dp_paper_…).
//
// All that a half-edge adds goes through one loop, and all planes that cut it through another one: compilers would
// otherwise write the same code out dozens of times. What is cut lies in one of two halves of a pool of points.

const double PAPER_REACH = 1.5LF;            // polygons are cut off at so many times the pen's reach
const double PAPER_GRAZING = 1.0LF / 32.0LF; // least |V.N| and |V.R|
const uint MOST_POINTS = 16u;

// P + w D [z sin(alpha) (V.C) / (V.M)]
dvec3 paper_offset(dvec3 p, dvec3 e, dvec3 direction, dvec3 normal, double px) {
    dvec3 v = view_vector(p);
    double distance = dot(picture.sight.xyz, p) + picture.sight.w;
    double wz = px / picture.forward.w * (is_perspective() ? distance : 1.0);
    double cosine = dot(v, e), sine = sqrt(max(0.0, 1.0 - cosine * cosine));
    double grazing = max(abs(dot(v, normal)), PAPER_GRAZING);
    return p + direction * (wz * sine * dot(v, picture.forward.xyz) / grazing);
}

// A polygon in clip space: x, y, z, w and distance of its points.
dvec4 pool[2u * MOST_POINTS];
double pool_distance[2u * MOST_POINTS];
uint base = 0u, point_count = 0u;

void add_point(dvec3 p) {
    dvec4 q;
    for (int r = 0; r < 4; r++) q[r] = dot(picture.clip[r].xyz, p) + picture.clip[r].w;
    pool[base + point_count] = q;
    pool_distance[base + point_count] = dot(picture.sight.xyz, p) + picture.sight.w;
    point_count++;
}
dvec3 point_at(uint i) {
    return to_screen(ClipPoint(pool[base + i], pool_distance[base + i]));
}

// Keeps the part where f . (x, y, z, w) >= 0.
void cut_by(dvec4 f) {
    bool outside = false;
    for (uint i = 0u; i < point_count; i++) outside = outside || dot(f, pool[base + i]) < 0.0;
    if (!outside) return;
    uint to = MOST_POINTS - base, n = 0u;
    for (uint i = 0u; i < point_count; i++) {
        uint a = base + i, b = base + (i + 1u == point_count ? 0u : i + 1u);
        double da = dot(f, pool[a]), db = dot(f, pool[b]);
        if (da >= 0.0 && n < MOST_POINTS) {
            pool[to + n] = pool[a];
            pool_distance[to + n++] = pool_distance[a];
        }
        if ((da < 0.0) != (db < 0.0) && n < MOST_POINTS) {
            double t = da / (da - db);
            pool[to + n] = pool[a] + (pool[b] - pool[a]) * t;
            pool_distance[to + n++] = pool_distance[a] + (pool_distance[b] - pool_distance[a]) * t;
        }
    }
    base = to;
    point_count = n >= 3u ? n : 0u;
}

// Of f.x x + f.y y + f.z on the screen, the same times w in clip space.
dvec4 screen_plane(dvec3 f) {
    double x = 0.5LF * f.x * double(picture.size.x), y = 0.5LF * f.y * double(picture.size.y);
    return dvec4(x, -y, 0.0, x + y + f.z);
}
// The planes of the guarded frustum, and of a rectangle `reach_` px around the edge.
dvec4 plane_number(int i, ScreenEdge e, double reach_) {
    double g = picture.eye.w;
    switch (i) {
    case 0: return dvec4(0.0, 0.0, 1.0, 1.0);
    case 1: return dvec4(0.0, 0.0, -1.0, 1.0);
    case 2: return dvec4(1.0, 0.0, 0.0, g);
    case 3: return dvec4(-1.0, 0.0, 0.0, g);
    case 4: return dvec4(0.0, 1.0, 0.0, g);
    case 5: return dvec4(0.0, -1.0, 0.0, g);
    case 6: return screen_plane(dvec3(-e.n, dot(e.n, e.a.xy) + reach_));
    case 7: return screen_plane(dvec3(e.n, reach_ - dot(e.n, e.a.xy)));
    case 8: return screen_plane(dvec3(e.t, reach_ - dot(e.t, e.a.xy)));
    default: return screen_plane(dvec3(-e.t, reach_ + dot(e.t, e.a.xy) + e.length));
    }
}

// Projects the polygon, cut, and puts its fan, two triangles at a time.
void project(Task k, ScreenEdge e, double reach_) {
    for (int i = 0; i < 10 && point_count >= 3u; i++) cut_by(plane_number(i, e, reach_));
    if (point_count < 3u) return;
    dvec3 sum = dvec3(0.0), o = point_at(0u), last = point_at(1u);
    double nearest = max(o.z, last.z);
    for (uint i = 2u; i < point_count; i++) {
        dvec3 p = point_at(i), a = last - o, b = p - o;
        sum += dvec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
        nearest = max(nearest, p.z);
        last = p;
    }
    dvec2 slope = sum.xy * (-1.0 / sum.z);
    if (is_big(slope.x + slope.y + o.z)) return;
    for (uint i = 1u; i + 1u < point_count; i += 2u) {
        dvec3 p[4] = dvec3[4](o, point_at(i), point_at(i + 1u), o);
        if (i + 2u < point_count) p[3] = point_at(i + 2u);
        put(k, p, slope, k.kind == BEVEL ? e.b.xy : e.a.xy, e.b.xy, nearest); // a bevel has no edge
    }
}

// The part of an edge that is seen: the formula needs corners before the eye.
bool visible_part(vec3 from, vec3 to, out dvec3 a, out dvec3 b) {
    ClipPoint ca = to_clip(from), cb = to_clip(to);
    double t0 = 0.0, t1 = 1.0;
    if ((outcode(ca) | outcode(cb)) != 0u && !clip_segment(ca, cb, t0, t1)) return false;
    a = dvec3(from) + (dvec3(to) - dvec3(from)) * t0, b = dvec3(from) + (dvec3(to) - dvec3(from)) * t1;
    return true;
}

// One polygon, from the points of an edge (of one corner, if bevel) moved in two directions.
struct Sweep {
    bool any;
    dvec3 a, b, ea, eb, da, db, normal;
    double px;
};
void put_sweep(Task k, ScreenEdge e, Sweep s) {
    if (!s.any) return;
    base = point_count = 0u;
    add_point(s.a);
    if (k.kind != BEVEL) add_point(s.b);
    add_point(paper_offset(s.b, s.eb, s.db, s.normal, s.px));
    add_point(paper_offset(s.a, s.ea, s.da, s.normal, s.px));
    project(k, e, PAPER_REACH * s.px);
}

// Q and R (2.2). A quad that faces away is culled.
Sweep folded(Polygon p, vec3 from, vec3 to, Pen pen) {
    Sweep s;
    dvec3 u = edge_direction(from, to), o = cross_of(u, p.normal);
    s.normal = -pen.cosine * p.normal + pen.sine * o;
    s.ea = s.eb = u;
    s.da = s.db = -pen.sine * p.normal - pen.cosine * o;
    s.px = pen.reach;
    s.any = dot(view_vector(dvec3(from)), s.normal) < 0.0 && visible_part(from, to, s.a, s.b);
    return s;
}
Sweep enlarged(Polygon p, vec3 from, vec3 to, Pen pen) {
    Sweep s;
    s.normal = p.normal;
    s.ea = s.eb = edge_direction(from, to);
    s.da = s.db = cross_of(s.ea, p.normal);
    s.px = pen.reach;
    s.any = visible_part(from, to, s.a, s.b);
    return s;
}
// The triangle between the quads of two edges, at the corner where the first one ends: the paper's 2n-gon.
Sweep bevel_at(Polygon p, uint half_edge, vec3 from, vec3 corner, Pen pen) {
    Sweep s;
    uint next = next_outer(p, half_edge);
    s.normal = p.normal;
    s.a = s.b = dvec3(corner);
    s.eb = edge_direction(from, corner);
    s.ea = edge_direction(corner, world_of(corners[next_in(next)]));
    s.db = cross_of(s.eb, p.normal), s.da = cross_of(s.ea, p.normal);
    s.px = pen.reach;
    s.any = may_be_line(next) && outcode(to_clip(corner)) == 0u;
    return s;
}

// Both polygons that a half-edge may add.
void shade_paper(Polygon p, uint half_edge, bool first_one, bool second_one, Pen first_pen,
                 Pen second_pen, Task first, Task second) {
    ScreenEdge e = screen_edge(p, half_edge);
    if (!e.seen) return;
    vec3 from = world_of(corners[half_edge]), to = world_of(corners[next_in(half_edge)]);
    for (int i = 0; i < 2; i++) {
        Sweep s;
        if (!(i == 0 ? first_one : second_one)) continue;
        if (p.front) s = folded(p, from, to, i == 0 ? first_pen : second_pen);
        else if (i == 0) s = enlarged(p, from, to, first_pen);
        else s = bevel_at(p, half_edge, from, to, first_pen);
        put_sweep(i == 0 ? first : second, e, s);
    }
}
