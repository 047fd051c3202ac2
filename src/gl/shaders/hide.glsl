// Is a point of a line hidden? It is where a triangle that covers it lies nearer than its limit, as in find/hide.inc. Which
// triangles may is what the samples around it tell, and from each of them a walk over the surface, from mate to mate:
//
//     for each sample of the four pixels around the point
//         nothing, or the line's own polygon           does not hide it
//         a triangle: walk from it towards the point
//             a triangle that covers the point         hides it or not, by its depth there
//             the surface turns away, own polygon      does not hide it
//             an edge without a mate                   not sure: the sample's plane votes
//     no triangle covers it, and all votes say hidden: hidden
//
// So the answer does not depend on how small triangles are against the samples. Not handled: what is so thin that no
// sample around the point shows it or a part of the same surface.
#include "scene.glsl"
#include "ids.glsl"

layout(std430, binding = 3) readonly buffer Mates { uint mates[]; };

#if SAMPLES > 1
uniform sampler2DMS depths;
#else
uniform sampler2D depths;
#endif
uniform vec2 depth_range; // as in faces.vert

const int STEPS = 24; // of a walk
const uint NOTHING = 0xFFFFFFFEu; // beside the picture
const uint HIDES = 0u, CLEAR = 1u, UNSURE = 2u;

// How near a surface must be to hide a sample point at depth d.
const double SLACK = 0.05LF; // pixel sizes
float limit_at(double d) {
    return float(d + (is_perspective() ? SLACK * d / picture.forward.w : SLACK / picture.forward.w));
}

// What a line is asked against.
struct Query {
    vec2 at;     // px
    float limit; // d
    uint a, b;   // triangles of the line; b: NONE
    uint polygon_a, polygon_b; // their polygons, which do not hide it
};
Query query_of(vec2 at, float limit, uint a, uint b) {
    uint polygon = polygon_of(a);
    return Query(at, limit, a, b, polygon, b == NONE ? polygon : polygon_of(b));
}
bool is_own(uint triangle, Query q) {
    uint polygon = polygon_of(triangle);
    return polygon == q.polygon_a || polygon == q.polygon_b;
}
// What lies beside the line's own triangles, n < 6; NONE: nothing.
uint neighbour_of(Query q, uint n) {
    uint own = n < 3u ? q.a : q.b;
    uint mate = own == NONE ? MATE_NONE : mates[3u * own + n % 3u];
    return is_mate(mate) ? mate_of(mate) / 3u : NONE;
}

// A triangle about a point of the screen: on which side of edge k (from corner k) the point lies, times the sign of the
// area. Corners outside the guarded frustum have no place on the screen: then in homogeneous coordinates.
struct About {
    vec3 inside;
    float area; // sign: as on the screen; 0: it is too thin to tell
    float nearest; // depth of its corners on the screen
    float d;       // of its plane there, but no nearer than that
};
const float THIN = 1e-4; // px
float cross2(vec2 a, vec2 b) { return a.x * b.y - a.y * b.x; }

About about_on_screen(vec3 p0, vec3 p1, vec3 p2, vec2 at) {
    vec2 a = p0.xy - at, b = p1.xy - at, c = p2.xy - at;
    vec3 e = vec3(cross2(a, b), cross2(b, c), cross2(c, a));
    float area = e.x + e.y + e.z, s = area < 0.0 ? -1.0 : 1.0;
    vec2 u = b - a, v = c - a;
    float reach = max(max(abs(u.x), abs(u.y)), max(abs(v.x), abs(v.y)));
    float d = (e.y * p0.z + e.z * p1.z + e.x * p2.z) / area;
    float nearest = max(max(p0.z, p1.z), p2.z);
    return About(e * s, abs(area) > reach * THIN ? area : 0.0, nearest, min(d, nearest));
}

dvec3 homogeneous(ClipPoint c, vec2 at) {
    return dvec3((0.5 * c.c.x + (0.5 - double(at.x * picture.size.z)) * c.c.w) * picture.size.x,
                 ((0.5 - double(at.y * picture.size.w)) * c.c.w - 0.5 * c.c.y) * picture.size.y,
                 c.c.w);
}
double cross2d(dvec3 a, dvec3 b) { return a.x * b.y - a.y * b.x; }
About about_in_space(uint triangle, vec2 at) {
    ClipPoint p[3];
    dvec3 h[3];
    for (uint k = 0u; k < 3u; k++) {
        p[k] = to_clip(world_of(corners[3u * triangle + k]));
        h[k] = homogeneous(p[k], at);
    }
    dvec3 e = dvec3(cross2d(h[0], h[1]), cross2d(h[1], h[2]), cross2d(h[2], h[0]));
    double volume = h[0].z * e.y + h[1].z * e.z + h[2].z * e.x, sum = e.x + e.y + e.z,
           s = volume < 0.0 ? -1.0 : 1.0;
    double before = p[0].c.z * e.y + p[1].c.z * e.z + p[2].c.z * e.x;
    double away = p[0].distance * e.y + p[1].distance * e.z + p[2].distance * e.x;
    About r = About(vec3(e * s), float(volume), 0.0, 0.0);
    if (sum * s <= 0.0 || (before + volume) * s < 0.0) r.inside = vec3(0.0, 0.0, -1.0); // not before the eye
    r.d = float(is_perspective() ? sum / volume : -away / sum);
    return r;
}
About about(uint triangle, vec2 at) {
    vec4 a = screen_of(corners[3u * triangle]), b = screen_of(corners[3u * triangle + 1u]),
         c = screen_of(corners[3u * triangle + 2u]);
    if (is_off_screen(a) || is_off_screen(b) || is_off_screen(c)) return about_in_space(triangle, at);
    return about_on_screen(a.xyz, b.xyz, c.xyz, at);
}

// The edge that the point lies beyond, by the larger area; 3: it lies beyond none.
uint beyond(About r) {
    vec3 e = r.inside;
    if (all(greaterThanEqual(e, vec3(0.0)))) return 3u;
    return e.x <= e.y && e.x <= e.z ? 0u : e.y <= e.z ? 1u : 2u;
}

// Walks from a triangle to the one that covers the point; `at` becomes the last one on the way. `votes`: not sure, but the
// first one's plane lies before the point.
uint walk(inout uint at, Query q, out bool votes) {
    float facing = 0.0;
    bool alike = false;
    votes = false;
    for (int i = 0; i < STEPS; i++) {
        if (is_own(at, q)) return CLEAR;
        About r = about(at, q.at);
        if (i == 0) votes = r.d > q.limit;
        if (i == 0 && !votes && r.nearest <= q.limit) return CLEAR;
        if (r.area != 0.0) {
            if (facing != 0.0 && (r.area < 0.0) != ((facing < 0.0) != alike)) return CLEAR;
            facing = r.area, alike = false;
        }
        uint edge = beyond(r);
        if (edge == 3u) return r.area != 0.0 && r.d > q.limit ? HIDES : CLEAR;
        uint mate = mates[3u * at + edge];
        if (!is_mate(mate)) return UNSURE;
        alike = alike != ((mate & MATE_ALIKE) != 0u);
        at = mate_of(mate) / 3u;
    }
    return UNSURE;
}

// What the samples around a point show: numbers of triangles, each once, but for the line's own.
const int SHOWN = 12;
struct Shown {
    uint triangles[SHOWN];
    int count, foreign; // foreign: samples of the point's own pixel where something of the application's hides it
    bool any_clear;     // nothing lies before it at some sample
};
Shown shown_around(Query q) {
    ivec2 corner = ivec2(floor(q.at - 0.5)), own = ivec2(floor(q.at));
    Shown r;
    uint last = NOTHING;
    r.count = r.foreign = 0, r.any_clear = false;
    for (int n = 0; n < 4 * SAMPLES; n++) {
        // the point's own pixel first
        int k = n / SAMPLES, i = n % SAMPLES;
        ivec2 p = corner + ivec2((k & 1) ^ (own.x - corner.x), (k >> 1) ^ (own.y - corner.y));
        uint id = is_in_picture(p) ? id_at(p, i) : NOTHING;
        if (id == NOTHING || id == last) continue;
        if (id == ID_FOREIGN) {
            bool hides = q.limit * depth_range.x + depth_range.y < texelFetch(depths, p, i).x;
            r.foreign += int(hides && k == 0);
            r.any_clear = r.any_clear || !hides;
            continue;
        }
        last = id;
        bool known = id == 0u || is_own(id - 1u, q);
        r.any_clear = r.any_clear || known;
        for (int m = 0; m < r.count; m++) known = known || r.triangles[m] == id - 1u;
        if (!known && r.count < SHOWN) r.triangles[r.count++] = id - 1u;
    }
    return r;
}

// Is the point hidden? `hider`: by which triangle; NONE: it is not known.
bool is_hidden(Query q, out uint hider) {
    Shown r = shown_around(q);
    bool any_clear = r.any_clear;
    hider = NONE;
    // then what lies beside the line's own triangles
    for (int n = 0; n < r.count + 6; n++) {
        bool is_shown = n < r.count;
        if (!is_shown && !any_clear) return true;
        uint at = is_shown ? r.triangles[n] : neighbour_of(q, uint(n - r.count)), from = at;
        bool votes = false;
        uint found = at == NONE ? CLEAR : walk(at, q, votes);
        if (found == HIDES) {
            hider = at;
            return true;
        }
        if (found == UNSURE && votes && is_shown) hider = from;
        else any_clear = true;
    }
    return r.foreign * 2 >= SAMPLES + int(SAMPLES == 1);
}
