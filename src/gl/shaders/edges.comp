// Edges become candidates, as find/edges.c and fan.c resolve them, or are left to the eye. An edge of two triangles that
// run it in opposite directions is classified once, by the one that comes first in the source:
//
//     front and back    silhouette; the one that recedes less from the edge is seen beside it
//     front and front   ridge or valley, by the dihedral angle
//     back and back     the same as it is seen from behind: visibility.comp asks whether back faces are seen there
//
// The eye decides (`disputed`) where an edge has one triangle, more than two, or is run twice the same way. Of the pairs
// that two have, nearly all are too flat: their normals in float32 tell.
#define COMPUTE 64
#include "folds.glsl"
#include "sides.glsl"
#include "ids.glsl"
#include "candidates.glsl"

layout(std430, binding = 3) readonly buffer Mates { uint mates[]; };
layout(std430, binding = 4) readonly buffer Sides { Side sides[]; };
layout(std430, binding = 5) buffer Counters { uint counters[]; };
layout(std430, binding = 6) writeonly buffer Candidates { Candidate candidates[]; };
layout(std430, binding = 7) writeonly buffer Disputed { uint disputed[]; };

uniform uint has_fans, candidates_room, disputed_room;

void dispute(uint half_edge) {
    uint at = atomicAdd(counters[5], 1u);
    if (at < disputed_room) disputed[at] = half_edge;
}
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

void pair(uint half_edge, uint mate) {
    uint t = half_edge / 3u, u = mate / 3u;
    if (u < t || (u == t && mate < half_edge)) return; // the first in the source has it
    Side a = sides[t], b = sides[u];
    bool front = (a.kind & SIDE_FRONT) != 0u;
    if (front != ((b.kind & SIDE_FRONT) != 0u)) {
        if (draws(SILHOUETTE) && !is_beside_picture(half_edge)) add_silhouette(half_edge, u, front);
        return;
    }
    if (dot(a.normal, b.normal) > picture.step_.w || !(draws(RIDGE) || draws(VALLEY))) return;
    if ((is_diagonal(half_edge) && is_diagonal(mate)) || is_beside_picture(half_edge)) return;
    if (!front && picture.style.z != 0u) return; // back faces are not drawn
    add_fold(half_edge, mate, front);
}

void main() {
    uint t = dp_item();
    if (t >= picture.counts.y) return;
    for (uint k = 0u; k < 3u; k++) {
        uint half_edge = 3u * t + k, mate = mates[half_edge];
        if (!may_be_line(half_edge) || (sides[t].kind & SIDE_NO_AREA) != 0u) continue;
        bool alone = !is_mate(mate) || (sides[mate_of(mate) / 3u].kind & SIDE_NO_AREA) != 0u;
        if (alone) {
            if ((mate == MATE_MANY || !is_diagonal(half_edge)) && !is_beside_picture(half_edge))
                dispute(half_edge);
        } else if ((mate & MATE_ALIKE) == 0u) {
            pair(half_edge, mate);
        } else if (t < mate_of(mate) / 3u && !is_beside_picture(half_edge)) {
            dispute(half_edge);
        }
    }
}
