// Exact widths: rectangles beside the projected edge, of which only the depth comes from the plane in space, and fans of
// thin triangles as round joints (features/build.c, dp_screen_…). As in quads_paper.glsl, all goes through one loop.

const double SAGITTA = 0.3LF; // px: the triangles of a joint may miss its circle by so much
const uint SPANS = 7u;        // and there are at most so many of them

void put_quad(Task k, ScreenEdge e, double reach_, double slope) {
    dvec3 out_ = dvec3(e.n * reach_, slope * reach_);
    dvec3 p[4] = dvec3[4](e.a, e.b, e.b + out_, e.a + out_);
    put(k, p, e.along * e.t + slope * e.n, e.a.xy, e.b.xy,
        max(e.a.z, e.b.z) + max(out_.z, 0.0));
}

// The turn from one unit vector to another, as cosine and sine.
dvec2 turned(dvec2 a, dvec2 b) { return dvec2(a.x * b.x - a.y * b.y, a.y * b.x + a.x * b.y); }

uint spans_of(dvec2 angle, double reach_) {
    double half_ = 1.0 - min(SAGITTA / reach_, 1.0), c = 2.0 * half_ * half_ - 1.0;
    dvec2 span = dvec2(c, sqrt(max(1.0 - c * c, 0.0))), sum = span;
    uint count = 1u;
    while (count < SPANS && sum.y > 0.0 && sum.x > angle.x) {
        count++;
        sum = turned(sum, span);
    }
    return count;
}
dvec2 share_of(dvec2 angle, uint spans) {
    if (spans == 1u) return angle;
    if (spans == 2u) {
        double c = sqrt(0.5LF * (1.0 + angle.x));
        return dvec2(c, angle.y / (2.0 * c));
    }
    float share = atan(float(angle.y), float(angle.x)) / float(spans);
    return dvec2(cos(share), sin(share));
}

// The point of the joint's circle in direction v.
dvec3 circle_point(ScreenEdge e, double reach_, dvec2 v, double rise) {
    double d = e.b.z + reach_ * (e.along * dot(v, e.t) + e.own * dot(v, e.n) + rise);
    return dvec3(e.b.xy + reach_ * v, min(d, e.b.z + reach_ * e.steep));
}

void put_thin(Task k, dvec3 o, dvec3 from, dvec3 to) {
    dvec3 a = from - o, b = to - o;
    double inverse = -1.0 / (a.x * b.y - a.y * b.x);
    dvec2 slope = dvec2((a.y * b.z - a.z * b.y) * inverse, (a.z * b.x - a.x * b.z) * inverse);
    if (is_big(slope.x + slope.y)) return; // it covers nothing
    dvec3 p[4] = dvec3[4](o, from, to, o);
    put(k, p, slope, o.xy, o.xy, max(max(o.z, from.z), to.z));
}

// The joint between the rectangles of an edge and of the next one. `folded`: a cone, as far above the polygon's plane as
// the quads at the pen's angle; else in that plane.
void put_joint(Task k, Polygon p, ScreenEdge e, ScreenEdge f, Pen pen, double reach_, bool folded) {
    if (!f.seen || e.ends_outside || is_big(e.own)) return;
    double from_rise = 0.0, to_rise = 0.0;
    if (folded) {
        Lean from = quad_lean(e, pen), to = quad_lean(f, pen);
        from_rise = from.slope - e.own, to_rise = to.slope - f.own;
        if (!from.outward || !to.outward || is_big(from_rise) || is_big(to_rise)) return;
    }
    double sense = p.front ? -1.0 : 1.0;
    dvec2 angle = dvec2(dot(e.n, f.n), sense * (e.n.x * f.n.y - e.n.y * f.n.x));
    if (!(angle.y > 0.0) || angle.x < -0.999LF) return;
    uint spans = spans_of(angle, reach_);
    dvec2 share = share_of(angle, spans), at = share;
    double rise = (to_rise - from_rise) / double(spans);
    dvec3 from = circle_point(e, reach_, e.n, from_rise);
    for (uint i = 1u; i < spans; i++) {
        double s = sense * at.y;
        dvec3 to = circle_point(e, reach_, dvec2(e.n.x * at.x - e.n.y * s, e.n.x * s + e.n.y * at.x),
                                from_rise + rise * double(i));
        put_thin(k, e.b, from, to);
        from = to;
        at = turned(at, share);
    }
    put_thin(k, e.b, from, circle_point(e, reach_, f.n, to_rise));
}

// How the rectangle beside an edge is drawn: its width (0: not at all), and its slope.
dvec2 rectangle_of(ScreenEdge e, uint line, Pen pen) {
    if (line == SILHOUETTE) // none if it leads straight away from the eye
        return e.own <= -BIG ? dvec2(0.0) : dvec2(pen.reach, min(e.own, e.steep));
    Lean lean = quad_lean(e, pen);
    if (line != VALLEY) {
        if (!lean.outward && !pen.reflex) return dvec2(0.0);
        return dvec2(pen.reach, lean.outward ? min(lean.slope, e.steep) : e.steep);
    }
    if (!lean.outward && pen.reflex) return dvec2(0.0);
    double slope = lean.outward ? lean.slope : -e.steep;
    return dvec2(slope > e.steep ? pen.reach * e.steep / slope : pen.reach, slope);
}

// Both lines that a half-edge may add.
void shade_exact(Polygon p, uint half_edge, bool first_one, bool second_one, Pen first_pen,
                 Pen second_pen, Task first, Task second) {
    ScreenEdge e = screen_edge(p, half_edge);
    if (!e.seen) return;
    ScreenEdge f = screen_edge(p, next_outer(p, half_edge));
    for (int i = 0; i < 2; i++) {
        if (!(i == 0 ? first_one : second_one)) continue;
        Task k = i == 0 ? first : second;
        Pen pen = i == 0 ? first_pen : second_pen;
        dvec2 rectangle = rectangle_of(e, k.line, pen);
        if (!(rectangle.x > 0.0)) continue;
        put_quad(k, e, rectangle.x, rectangle.y);
        if (k.line == ridge_line) k.list = joint_list;
        put_joint(k, p, e, f, pen, rectangle.x, k.line != SILHOUETTE);
    }
}
