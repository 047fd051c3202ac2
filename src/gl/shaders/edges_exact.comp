// Edges that are listed become candidates, as find/edges.c and fan.c resolve them. Each has two triangles that run it in
// opposite directions; its own is the one that comes first in the source:
//
//     front and back    silhouette; the one that recedes less from the edge is seen beside it
//     front and front   ridge or valley, by the dihedral angle
//     back and back     the same as it is seen from behind: visible_points.comp asks whether back faces are seen there
#define COMPUTE 64
#include "folds.glsl"
#include "sides.glsl"
#include "ids.glsl"
#include "candidates.glsl"

layout(std430, binding = 3) readonly buffer Mates { uint mates[]; };
layout(std430, binding = 4) readonly buffer Sides { Side sides[]; };
layout(std430, binding = 5) buffer Counters { uint counters[]; };
layout(std430, binding = 6) writeonly buffer Candidates { Candidate candidates[]; };
layout(std430, binding = 7) readonly buffer Pairs { uint pairs[]; };

uniform uint has_fans, candidates_room, pairs_room;

void add(uint line, uint half_edge, uint other, uint seen) {
    if (!draws(line)) return;
    uint at = atomicAdd(counters[4], 1u);
    if (at < candidates_room)
        candidates[at] = Candidate(line, half_edge / 3u, half_edge % 3u, other, 0u, NONE, seen, 0u);
}

// Do both ends lie beyond one side of the picture?
bool is_beside_picture(uint half_edge) {
    vec4 a = screen_of(corners[half_edge]), b = screen_of(corners[next_in(half_edge)]);
    if (is_off_screen(a) || is_off_screen(b)) return false;
    vec2 least = min(a.xy, b.xy), most = max(a.xy, b.xy);
    return any(lessThan(most, vec2(-1.0))) || any(greaterThan(least, picture.size.xy + 1.0));
}

// ------- silhouettes -------

// Back faces less front faces among the samples of a pixel.
int backs_at(vec2 at) {
    ivec2 p = ivec2(floor(at));
    int sum = 0;
    for (int i = 0; i < SAMPLES && is_in_picture(p); i++) {
        uint id = id_at(p, i);
        if (is_triangle(id)) sum += (sides[id - 1u].kind & SIDE_FRONT) != 0u ? -1 : 1;
    }
    return sum;
}
const int PLACES = 8; // along an edge, where it is asked which side of a surface is seen …
const int AROUND = 3; // … half a pixel beside it, and so many pixels on
// Are more back faces than front faces seen to the left of the edge, or to the right? Single samples do not tell: of faces
// that are nearly edge-on the device mistakes depths.
bool shows_back_beside(uint half_edge, bool left) {
    vec4 a = screen_of(corners[half_edge]), b = screen_of(corners[next_in(half_edge)]);
    if (is_off_screen(a) || is_off_screen(b)) return true;
    vec2 along = b.xy - a.xy, beside = vec2(along.y, -along.x) / max(length(along), 1e-6);
    int sum = 0;
    for (int i = 0; i < PLACES * AROUND; i++) {
        vec2 at = a.xy + along * ((float(i / AROUND) + 0.5) / float(PLACES));
        sum += backs_at(at + (left ? beside : -beside) * (float(i % AROUND) + 0.5));
    }
    return sum > 0;
}

// The front face lies behind the back face where the edge is concave: that is what is seen only where back faces are.
void add_silhouette(uint half_edge, uint other, bool front) {
    uint a = half_edge / 3u;
    Sight s;
    uint seen = front ? 1u : 2u;
    if (sight_of(dvec3(world_of(corners[half_edge])), dvec3(world_of(corners[next_in(half_edge)])),
                 s)) {
        dvec3 na = normal_at(a, has_fans != 0u), nb = normal_at(other, has_fans != 0u);
        double ra = recedes(s, front ? na : -na), rb = recedes(s, front ? -nb : nb);
        double sign_ = front ? -1.0 : 1.0; // a front face lies to the left of its edge
        bool back_is_nearest = front ? sign_ * rb < sign_ * ra : sign_ * ra < sign_ * rb;
        if (back_is_nearest && shows_back_beside(half_edge, front)) seen = 3u - seen;
    }
    add(SILHOUETTE, half_edge, other, seen);
}

// ------- folds -------

void add_fold(uint half_edge, uint mate, bool front) {
    uint a = half_edge / 3u, b = mate / 3u;
    dvec3 na = normal_at(a, has_fans != 0u), nb = normal_at(b, has_fans != 0u);
    dvec3 into_b = dvec3(world_of(corners[last_in(mate)])) - dvec3(world_of(corners[mate]));
    bool concave = (dot(na, into_b) > 0.0) == front;
    uint line = line_of_fold(dot(na, nb), concave);
    if (line != NONE) add(line, half_edge, b, 3u);
}

void main() {
    uint i = dp_item();
    if (i >= min(counters[9], pairs_room)) return;
    uint half_edge = pairs[i], mate = mate_of(mates[half_edge]), t = half_edge / 3u, u = mate / 3u;
    if (is_beside_picture(half_edge)) return;
    bool front = (sides[t].kind & SIDE_FRONT) != 0u;
    if (front != ((sides[u].kind & SIDE_FRONT) != 0u)) add_silhouette(half_edge, u, front);
    else if (!(is_diagonal(half_edge) && is_diagonal(mate))) add_fold(half_edge, mate, front);
}
