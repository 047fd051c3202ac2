// Which surface a pixel of several samples shows, as gbuffer/fill.c decides it: the greatest part of the samples that lie on
// one surface (near in depth, or on one plane); the nearer of two halves.
#include "scene.glsl"
#include "ids.glsl"

const float SAME_SURFACE = 3.0; // px sizes: samples of one surface differ by no more in depth
const float NOTHING = -3.402823466e38;

struct Pick {
    uint triangle;
    vec2 at; // where it is sampled, px
    float d; // depth there
    uint share;  // of the samples, of 255
    float other; // depth of the rest; NOTHING: paper
};

uint ids_of_pixel[SAMPLES];
float depths_of_pixel[SAMPLES];
Plane planes_of_pixel[SAMPLES];

vec2 sample_at(ivec2 p, int i) { return vec2(p) + place_of(i); }
bool is_plane(Plane p) { return !isnan(p.slope.x + p.slope.y) && !isinf(p.slope.x + p.slope.y); }

// A plane that is seen edge-on has no depth elsewhere: its nearest corner's is taken.
Plane plane_seen(uint triangle) {
    Plane p = plane_of(triangle);
    if (is_plane(p)) return p;
    float d = NOTHING;
    for (uint k = 0u; k < 3u; k++) {
        vec4 s = screen_of(corners[3u * triangle + k]);
        if (!is_off_screen(s)) d = max(d, s.z);
    }
    return Plane(vec3(0.0, 0.0, d), vec2(0.0));
}

void fetch_samples(ivec2 p) {
    for (int i = 0; i < SAMPLES; i++) {
        uint id = id_at(p, i);
        ids_of_pixel[i] = is_triangle(id) ? id : 0u;
        if (ids_of_pixel[i] == 0u) continue;
        int known = i;
        for (int k = i - 1; k >= 0; k--)
            if (ids_of_pixel[k] == ids_of_pixel[i]) known = k;
        if (known < i)
            planes_of_pixel[i] = planes_of_pixel[known];
        else
            planes_of_pixel[i] = plane_seen(ids_of_pixel[i] - 1u);
        depths_of_pixel[i] = plane_at(planes_of_pixel[i], sample_at(p, i));
    }
}

uint samples_with(ivec2 p, int s) {
    uint set = 0u;
    float near = depth_steps(depths_of_pixel[s], SAME_SURFACE);
    for (int i = 0; i < SAMPLES; i++) {
        if (ids_of_pixel[i] == 0u) continue;
        float d = depths_of_pixel[i];
        if (abs(d - depths_of_pixel[s]) <= near ||
            abs(d - plane_at(planes_of_pixel[s], sample_at(p, i))) <= near)
            set |= 1u << i;
    }
    return set;
}

Pick pick_part(ivec2 p) {
    int s = 0, n = SAMPLES;
    while (s < n - 1 && ids_of_pixel[s] == 0u) s++;
    uint set = samples_with(p, s);
    int count = bitCount(set);
    for (int t = s + 1; t < n && 2 * count <= n; t++) {
        if (ids_of_pixel[t] == 0u || (set >> t & 1u) != 0u) continue;
        uint rest = samples_with(p, t);
        int more = bitCount(rest);
        if (more > count || (more == count && depths_of_pixel[t] > depths_of_pixel[s])) {
            set = rest;
            s = t;
        }
        break;
    }
    uint left = ~set & ((1u << n) - 1u);
    int first = findLSB(left);
    float other = left != 0u && ids_of_pixel[first] != 0u ? depths_of_pixel[first] : NOTHING;
    return Pick(ids_of_pixel[s] - 1u, sample_at(p, s), depths_of_pixel[s],
                255u * uint(bitCount(set)) / uint(n), other);
}

float cross2(vec2 a, vec2 b, vec2 q) { return (a.x - q.x) * (b.y - q.y) - (a.y - q.y) * (b.x - q.x); }

// Areas of the point's triangles with two corners; none is below zero inside.
vec3 areas_at(uint triangle, vec2 q) {
    vec2 a = screen_of(corners[3u * triangle]).xy, b = screen_of(corners[3u * triangle + 1u]).xy,
         c = screen_of(corners[3u * triangle + 2u]).xy;
    vec3 e = vec3(cross2(b, c, q), cross2(c, a, q), cross2(a, b, q));
    return e.x + e.y + e.z < 0.0 ? -e : e;
}

// Of a pixel of one polygon, the triangle of its fan that holds the centre, of those that samples show.
Pick pick_whole(ivec2 p) {
    vec2 centre = vec2(p) + 0.5;
    int best = 0;
    float most = -1e38;
    for (int i = 0; i < SAMPLES; i++) {
        if (i > 0 && ids_of_pixel[i] == ids_of_pixel[i - 1]) continue;
        vec3 e = areas_at(ids_of_pixel[i] - 1u, centre);
        float least = min(e.x, min(e.y, e.z));
        if (least > most) {
            most = least;
            best = i;
        }
    }
    return Pick(ids_of_pixel[best] - 1u, centre, plane_at(planes_of_pixel[best], centre), 255u,
                NOTHING);
}

// What pixel p shows; false: the paper.
bool pick(ivec2 p, out Pick chosen) {
    bool whole = true, covered = true, near = SAMPLES == 4;
    fetch_samples(p);
    for (int i = 0; i < SAMPLES; i++) {
        covered = covered && ids_of_pixel[i] != 0u;
        whole = whole && (ids_of_pixel[i] == ids_of_pixel[0] ||
                          (ids_of_pixel[i] != 0u && ids_of_pixel[0] != 0u &&
                           polygon_of(ids_of_pixel[i] - 1u) == polygon_of(ids_of_pixel[0] - 1u)));
    }
    if (whole && !covered) return false;
    for (int i = 1; i < SAMPLES && covered; i++)
        near = near && abs(depths_of_pixel[i] - depths_of_pixel[0]) <=
                           depth_steps(depths_of_pixel[0], SAME_SURFACE);
    if (whole)
        chosen = pick_whole(p);
    else if (covered && near)
        chosen = Pick(ids_of_pixel[0] - 1u, sample_at(p, 0), depths_of_pixel[0], 255u, NOTHING);
    else
        chosen = pick_part(p);
    return true;
}
