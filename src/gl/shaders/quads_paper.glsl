// As printed (Raskar 2001, 2.1 to 2.3): the ends of an edge are moved in space, projected and clipped
// (features/build.c, dp_paper_…).

const double PAPER_REACH = 1.5LF;              // polygons are cut off at so many times the pen's reach
const double PAPER_GRAZING = 1.0LF / 32.0LF;   // least |V.N| and |V.R|
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

ClipPoint to_clip_d(dvec3 p) {
    ClipPoint q;
    for (int r = 0; r < 4; r++) q.c[r] = dot(picture.clip[r].xyz, p) + picture.clip[r].w;
    q.distance = dot(picture.sight.xyz, p) + picture.sight.w;
    return q;
}

// The polygon that is being cut, in clip space and then on the screen.
ClipPoint clip_points[MOST_POINTS];
dvec3 points[MOST_POINTS];
uint point_count;

void clip_by(int plane) {
    ClipPoint from[MOST_POINTS] = clip_points;
    uint n = point_count;
    point_count = 0u;
    for (uint i = 0u; i < n; i++) {
        ClipPoint a = from[i], b = from[i + 1u == n ? 0u : i + 1u];
        double da = inside(plane, a), db = inside(plane, b);
        if (da >= 0.0) clip_points[point_count++] = a;
        if ((da < 0.0) != (db < 0.0)) clip_points[point_count++] = mix_clip(a, b, da / (da - db));
    }
}

// Keeps the part where f.x x + f.y y + f.z >= 0.
void cut_by(dvec3 f) {
    bool any_outside = false;
    for (uint i = 0u; i < point_count; i++)
        any_outside = any_outside || f.x * points[i].x + f.y * points[i].y + f.z < 0.0;
    if (!any_outside) return;
    dvec3 from[MOST_POINTS] = points;
    uint n = point_count;
    point_count = 0u;
    for (uint i = 0u; i < n; i++) {
        dvec3 p = from[i], q = from[i + 1u == n ? 0u : i + 1u];
        double ip = f.x * p.x + f.y * p.y + f.z, iq = f.x * q.x + f.y * q.y + f.z;
        if (ip >= 0.0) points[point_count++] = p;
        if ((ip < 0.0) != (iq < 0.0)) points[point_count++] = p + (q - p) * (ip / (ip - iq));
    }
}

// Puts the polygon's plane and fan, two triangles at a time.
void put_points(Task k, ScreenEdge e) {
    dvec3 sum = dvec3(0.0);
    double nearest = points[0].z;
    for (uint i = 1u; i < point_count; i++) {
        nearest = max(nearest, points[i].z);
        if (i + 1u < point_count)
            sum += cross(points[i] - points[0], points[i + 1u] - points[0]);
    }
    dvec2 slope = sum.xy * (-1.0 / sum.z);
    if (is_big(slope.x + slope.y)) return;
    for (uint i = 1u; i + 1u < point_count; i += 2u) {
        dvec3 p[4] = dvec3[4](points[0], points[i], points[i + 1u],
                              i + 2u < point_count ? points[i + 2u] : points[0]);
        put(k, p, slope, e.a.xy, e.b.xy, nearest);
    }
}

// Projects the `count` first of corners, clipped to the frustum and to `reach_` px around the edge.
void project(Task k, ScreenEdge e, dvec3 corners_[4], uint count, double reach_) {
    uint codes = 0u;
    point_count = count;
    for (uint i = 0u; i < count; i++) {
        clip_points[i] = to_clip_d(corners_[i]);
        codes |= outcode(clip_points[i]);
    }
    for (int plane = 0; plane < 6 && point_count >= 3u; plane++)
        if ((codes >> plane & 1u) != 0u) clip_by(plane);
    for (uint i = 0u; i < point_count; i++) {
        if (!(clip_points[i].c.w > 0.0)) return;
        points[i] = to_screen(clip_points[i]);
        if (is_big(points[i].x + points[i].y + points[i].z)) return;
    }
    double n = dot(e.n, e.a.xy), t = dot(e.t, e.a.xy);
    if (point_count >= 3u) cut_by(dvec3(-e.n, n + reach_));
    if (point_count >= 3u) cut_by(dvec3(e.n, reach_ - n));
    if (point_count >= 3u) cut_by(dvec3(e.t, reach_ - t));
    if (point_count >= 3u) cut_by(dvec3(-e.t, reach_ + t + e.length));
    if (point_count >= 3u) put_points(k, e);
}

// The quad that an edge sweeps along `direction`. The formula needs corners before the eye, so the edge is clipped before it
// is moved, and the quad again afterwards.
void put_swept(Task k, ScreenEdge e, uint half_edge, dvec3 direction, dvec3 normal, double px) {
    vec3 from = world_of(corners[half_edge]), to = world_of(corners[next_in(half_edge)]);
    ClipPoint ca = to_clip(from), cb = to_clip(to);
    double t0 = 0.0, t1 = 1.0;
    if ((outcode(ca) | outcode(cb)) != 0u && !clip_segment(ca, cb, t0, t1)) return;
    dvec3 d = dvec3(to) - dvec3(from), u = edge_direction(from, to), a = dvec3(from) + d * t0,
          b = dvec3(from) + d * t1;
    dvec3 quad[4] = dvec3[4](a, b, paper_offset(b, u, direction, normal, px),
                             paper_offset(a, u, direction, normal, px));
    project(k, e, quad, 4u, PAPER_REACH * px);
}

void shade_silhouette(Polygon p, uint half_edge, Pen pen, Task k) {
    ScreenEdge e = screen_edge(p, half_edge);
    if (!e.seen) return;
    uint next = next_outer(p, half_edge);
    vec3 corner = world_of(corners[next]);
    dvec3 u = edge_direction(world_of(corners[half_edge]), corner);
    put_swept(k, e, half_edge, cross(u, p.normal), p.normal, pen.reach);
    if (!may_be_line(next) || outcode(to_clip(corner)) != 0u) return;
    // the triangle between the quads of two edges: the paper's 2n-gon
    dvec3 at = dvec3(corner), v = edge_direction(corner, world_of(corners[next_in(next)]));
    dvec3 bevel[4] = dvec3[4](at, paper_offset(at, u, cross(u, p.normal), p.normal, pen.reach),
                              paper_offset(at, v, cross(v, p.normal), p.normal, pen.reach), at);
    project(k, e, bevel, 3u, PAPER_REACH * pen.reach);
}

// Q and R (2.2).
void shade_folded(Polygon p, uint half_edge, Pen pen, Task k) {
    vec3 from = world_of(corners[half_edge]);
    dvec3 u = edge_direction(from, world_of(corners[next_in(half_edge)])), o = cross(u, p.normal);
    dvec3 q = -pen.sine * p.normal - pen.cosine * o, r = -pen.cosine * p.normal + pen.sine * o;
    if (dot(view_vector(dvec3(from)), r) >= 0.0) return; // culled: the quad faces away
    ScreenEdge e = screen_edge(p, half_edge);
    if (e.seen) put_swept(k, e, half_edge, q, r, pen.reach);
}
void shade_ridge(Polygon p, uint half_edge, Pen pen, Task k) { shade_folded(p, half_edge, pen, k); }
void shade_valley(Polygon p, uint half_edge, Pen pen, Task k) { shade_folded(p, half_edge, pen, k); }
