// Spines of candidates, as core/spine.c makes them: the edge clipped to the guarded frustum, sample points every quarter
// of a pixel, lifted off the surface along the normal. In double precision: a spine has the same points everywhere.
#include "clip.glsl"
#include "scene.glsl"
#include "crossing.glsl"
#include "folds.glsl"
#include "candidates.glsl"

const double LIFT = 0.1LF, SPACING = 0.25LF; // pixel sizes, px

struct Spine {
    dvec3 a, b;             // ends on the screen: x, y, d
    dvec3 probe_a, probe_b; // the same, lifted
    uint n;                 // sample points; point k is (k + 1/2) / n of the way along
    bool asks_back;         // it is seen only where back faces are
};

uniform uint has_fans;

dvec3 lifted(dvec3 p, double d, dvec3 normal) {
    double size = is_perspective() ? 1.0 / (d * picture.forward.w) : 1.0 / picture.forward.w;
    return to_screen(clip_of(p + normal * (LIFT * size)));
}

// Cuts [t0, t1] to the part before one of the frustum's planes, from which the ends lie da and db away.
void cut_by(double da, double db, inout double t0, inout double t1) {
    if (da < 0.0 && db < 0.0) t1 = -1.0;
    else if (da < 0.0) t0 = max(t0, da / (da - db));
    else if (db < 0.0) t1 = min(t1, da / (da - db));
}
bool clip_spine(ClipPoint a, ClipPoint b, out double t0, out double t1) {
    double ga = picture.eye.w * a.c.w, gb = picture.eye.w * b.c.w;
    t0 = 0.0, t1 = 1.0;
    if (is_inside(a) && is_inside(b)) return true;
    cut_by(a.c.z + a.c.w, b.c.z + b.c.w, t0, t1);
    cut_by(a.c.w - a.c.z, b.c.w - b.c.z, t0, t1);
    cut_by(ga + a.c.x, gb + b.c.x, t0, t1);
    cut_by(ga - a.c.x, gb - b.c.x, t0, t1);
    cut_by(ga + a.c.y, gb + b.c.y, t0, t1);
    cut_by(ga - a.c.y, gb - b.c.y, t0, t1);
    return t0 < t1 && clip_mix(a, b, t0).c.w > 0.0 && clip_mix(a, b, t1).c.w > 0.0;
}

// A triangle's normal, of its polygon, turned to the eye.
dvec3 turned_normal(uint triangle) {
    dvec3 n = normal_at(triangle, has_fans != 0u);
    return is_front(triangle) ? n : -n;
}
// What the line lies on: the mean of the normals on either side of a fold; where an outline's surface ends, that of what
// is seen and of what it turns into behind.
dvec3 lift_of(Candidate c, dvec3 at) {
    dvec3 a = turned_normal(c.a);
    if (c.b == NONE) return a;
    dvec3 b = turned_normal(c.b);
    bool outline = c.line == SILHOUETTE || c.line == BORDER;
    dvec3 sum = !outline ? a + b : (c.seen & 3u) == 2u ? b - a : a - b;
    return length(sum) > 1e-3 ? unit(sum) : -view_vector(at);
}

bool place_spine(dvec3 a, dvec3 b, dvec3 normal, inout Spine s) {
    ClipPoint ca = clip_of(a), cb = clip_of(b);
    double t0, t1;
    if (!clip_spine(ca, cb, t0, t1)) return false;
    s.a = to_screen(clip_mix(ca, cb, t0));
    s.b = to_screen(clip_mix(ca, cb, t1));
    dvec2 along = s.b.xy - s.a.xy;
    precise double size = sqrt(along.x * along.x + along.y * along.y);
    s.n = size > SPACING ? uint(ceil(size / SPACING)) : 1u;
    s.probe_a = lifted(a + (b - a) * t0, s.a.z, normal);
    s.probe_b = lifted(a + (b - a) * t1, s.b.z, normal);
    return size - size == 0.0;
}
// False: nothing of it is in the frustum, or it is none.
bool spine_of(Candidate c, out Spine s) {
    dvec3 a, b, normal;
    if (c.line > BORDER) return false; // taken out
    if (c.edge == NONE) {
        if (!crossing_of(c.a, c.b, a, b, normal)) return false;
    } else {
        a = dvec3(world_of(corners[3u * c.a + c.edge]));
        b = dvec3(world_of(corners[next_in(3u * c.a + c.edge)]));
        normal = lift_of(c, a);
    }
    s.asks_back = (c.line == RIDGE || c.line == VALLEY) && c.b != NONE && !is_front(c.a) &&
                  !is_front(c.b);
    return place_spine(a, b, normal, s);
}
