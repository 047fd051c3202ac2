// The triangles beside an outline (Hermosilla and Vázquez 2010, 2.3.2, Figure 2.3), as features/extrude.c makes them.
//
//       n1 ---- e1 ------- e2 ---- n2        v = 1
//         \    /   \     /   \    /
//          \  /     \   /     \  /
//           a ----------------- b            v = 0, on the edge
//
// The strip is n1, e1, a, e2, b, n2: four triangles.
#include "clip.glsl"

struct FinPoint {
    vec3 at;    // screen space
    vec3 place; // x, y from which u is computed; v
};
struct FinEdge {
    dvec3 a, b;        // on the screen, clipped to the guarded frustum
    bool is_seen;
    double side;       // 1 or -1: to which side of a -> b the strip lies
    dvec2 normal_a, normal_b; // of the vertices, projected, unit; 0: not known
};

// The vertex normal at a corner: the mean of the polygons around, found by stepping from neighbour to neighbour. A
// corner's share is its cross product over the squares of its edges' lengths (Max 1999). Triangles of one polygon
// are one corner.
bool is_inner(uint half_edge) {
    uint m = mates[half_edge];
    return is_mate(m) && (m & MATE_ALIKE) == 0u &&
           polygon_of(half_edge / 3u) == polygon_of(m / 3u) && half_edge / 3u != m / 3u;
}
// The same corner's place in the next triangle around the vertex, across the edge that starts there; NONE: there is none.
uint over_next(uint corner) {
    uint m = mates[corner];
    return is_mate(m) && (m & MATE_ALIKE) == 0u ? next_in(m) : NONE;
}
// The same the other way round, across the edge that ends there.
uint over_last(uint corner) {
    uint m = mates[last_in(corner)];
    return is_mate(m) && (m & MATE_ALIKE) == 0u ? m : NONE;
}
dvec3 position_at(uint corner) { return dvec3(world_of(corners[corner])); }

const uint MOST_AROUND = 256u;

dvec3 vertex_normal(uint from) {
    uint first = from, steps = 0u;
    for (uint c = over_last(from); c != NONE && c != from && steps < MOST_AROUND; steps++) {
        first = c; // back to a border, or once around
        c = over_last(c);
    }
    for (steps = 0u; is_inner(last_in(first)) && steps < MOST_AROUND; steps++)
        first = over_next(first); // to where a polygon begins
    dvec3 at = position_at(from), sum = dvec3(0.0lf), v = position_at(last_in(first)) - at;
    uint c = first;
    for (steps = 0u; c != NONE && steps < MOST_AROUND; steps++) {
        if (!is_inner(c)) {
            dvec3 u = position_at(next_in(c)) - at;
            double weight = dot(u, u) * dot(v, v);
            if (weight > 0.0lf) sum += cross(u, v) / weight;
            v = u;
        }
        c = over_next(c);
        if (c == first) break;
    }
    double l = length(sum);
    return l > 0.0lf ? sum / l : dvec3(0.0lf);
}

// The direction on the screen in which a point moves along a direction in space; unit, or 0.
dvec2 project_direction(ClipPoint c, dvec3 n) {
    double dx = dot(picture.clip[0].xyz, n), dy = dot(picture.clip[1].xyz, n),
           dw = dot(picture.clip[3].xyz, n);
    dvec2 d = dvec2((dx * c.c.w - c.c.x * dw) * double(picture.size.x),
                    (c.c.y * dw - dy * c.c.w) * double(picture.size.y));
    double l = length(d);
    return l > 0.0lf && l - l == 0.0lf ? d / l : dvec2(0.0lf);
}


FinEdge fin_edge(uint half_edge, bool front) {
    uint next = next_in(half_edge);
    ClipPoint a = to_clip(world_of(corners[half_edge])), b = to_clip(world_of(corners[next]));
    double t0 = 0.0lf, t1 = 1.0lf;
    FinEdge e;
    e.is_seen = true;
    if (!is_inside(a) || !is_inside(b))
        for (int i = 0; i < 6; i++) {
            double da = inside(i, a), db = inside(i, b);
            if (da < 0.0lf && db < 0.0lf) e.is_seen = false;
            if (da < 0.0lf) t0 = max(t0, da / (da - db));
            if (db < 0.0lf) t1 = min(t1, da / (da - db));
        }
    ClipPoint p = clip_mix(a, b, t0), q = clip_mix(a, b, t1);
    e.is_seen = e.is_seen && t0 < t1 && p.c.w > 0.0lf && q.c.w > 0.0lf;
    if (!e.is_seen) return e;
    e.a = t0 > 0.0lf ? to_screen(p) : to_screen(a);
    e.b = t1 < 1.0lf ? to_screen(q) : to_screen(b);
    e.is_seen = length(e.b.xy - e.a.xy) > 0.0lf; // false for NaN
    e.side = front ? 1.0lf : -1.0lf;
    e.normal_a = e.normal_b = dvec2(0.0lf);
    if (t0 == 0.0lf) e.normal_a = project_direction(a, vertex_normal(half_edge));
    if (t1 == 1.0lf) e.normal_b = project_direction(b, vertex_normal(next));
    return e;
}

// The corner of the strip beyond one end; a normal against the extrusion is turned round (Hermosilla and Vázquez 2009).
dvec2 beyond(dvec2 end, dvec2 normal, dvec2 out_, double width) {
    dvec2 n = normal == dvec2(0.0lf) ? out_ : normal;
    if (dot(n, out_) < 0.0lf) n = -n;
    return end + n * width;
}

// Point i of the strip, with equation (2.1) for e1 and e2.
FinPoint fin_point(FinEdge e, double width, int i) {
    double d = length(e.b.xy - e.a.xy);
    dvec2 along = (e.b.xy - e.a.xy) / d, out_ = dvec2(-along.y, along.x) * e.side;
    dvec2 e1 = e.a.xy + out_ * width, e2 = e.b.xy + out_ * width;
    dvec2 n1 = beyond(e.a.xy, e.normal_a, out_, width), n2 = beyond(e.b.xy, e.normal_b, out_, width);
    double da = length(e1 - n1), dc = length(n2 - e2), contour = da + length(e2 - e1) + dc;
    bool starts = i < 3; // of a: n1, e1, a
    dvec2 at = i == 0 ? n1 : i == 1 ? e1 : i == 2 ? e.a.xy : i == 3 ? e2 : i == 4 ? e.b.xy : n2;
    dvec2 place = starts ? e.a.xy : e.b.xy;
    if (i == 1) place += along * (d * da / contour);
    if (i == 3) place -= along * (d * dc / contour);
    return FinPoint(vec3(vec2(at), float(starts ? e.a.z : e.b.z)),
                    vec3(vec2(place), i == 2 || i == 4 ? 0.0 : 1.0));
}
