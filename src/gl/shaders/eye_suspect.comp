// Lists what may dispute a line (find/dispute.c): samples beside every fourth sample point that show a polygon which is not
// expected there, and whose plane passes through the edge, as far as float32 tells. Few are left for eye_dispute.comp.
#define COMPUTE 64
#include "eye.glsl"
#include "ids.glsl"
#include "sides.glsl"
#include "candidates.glsl"

layout(std430, binding = 4) readonly buffer Counters { uint counters[]; };
layout(std430, binding = 5) readonly buffer Candidates { Candidate candidates[]; };
layout(std430, binding = 6) writeonly buffer Suspects { uvec4 suspects[]; }; // candidate, k, side, triangle
layout(std430, binding = 7) readonly buffer Sides { Side sides[]; };

const uint STEP = 4u;
// px: where samples are looked at, and where else if all of that pixel lie on the other side; nearer than LEAST they may be
// won by either side.
const float BESIDE[2] = float[2](0.5, 1.25), LEAST = 0.02, STEEPEST = 64.0;

// What is expected on either side of the edge: numbers of polygons, NONE: nothing that is known; and their planes.
struct Expected {
    uint polygon[2];
    Plane plane[2];
};

// Does triangle b run the half-edge in the same direction?
bool runs_alike(uint b, uint half_edge) {
    uint from = key_at(corners[half_edge]), to = key_at(corners[next_in(half_edge)]);
    bool alike = false;
    for (uint k = 3u * b; k < 3u * b + 3u; k++)
        alike = alike || (key_at(corners[k]) == from && key_at(corners[next_in(k)]) == to);
    return alike;
}
void expect(uint triangle, bool opposite, inout Expected e) {
    uint side = uint(((sides[triangle].kind & SIDE_FRONT) != 0u) == opposite);
    e.polygon[side] = polygon_of(triangle), e.plane[side] = plane_of(triangle);
}

void ask(uint candidate, uint k, Lookout at, uint side, Expected e) {
    vec2 towards = side == 1u ? at.right : -at.right;
    vec2 here = vec2(at.at);
    uint last = NONE;
    bool looked = false;
    for (int i = 0; i < 2 && !looked; i++) {
        ivec2 pixel = ivec2(floor(here + BESIDE[i] * towards));
        for (int s = 0; s < SAMPLES; s++) {
            vec2 place = vec2(pixel) + place_of(s);
            if (!is_in_picture(pixel) || dot(place - here, towards) < LEAST) continue;
            looked = true;
            uint id = id_at(pixel, s);
            if (!is_triangle(id) || id == last) continue;
            uint number = polygon_of(id - 1u);
            if (number == e.polygon[0] || number == e.polygon[1]) continue;
            Plane plane = plane_of(id - 1u);
            float gap = plane_at(plane, here) - at.d, d = plane_at(plane, place),
                  touching = 1.5 * touching_of(plane.slope, at.d) + 1e-6 * abs(at.d);
            bool near = gap >= -touching && gap <= max(touching, 1.1 * over_of(plane.slope, at.d)),
                 goes_on = e.polygon[side] != NONE &&
                           abs(plane_at(e.plane[side], place) - d) <= touching_of(e.plane[side].slope, at.d);
            if (!near || goes_on || abs(d - at.d) > abs(depth_steps(at.d, STEEPEST))) continue;
            last = id;
            uint to = atomicAdd(head.suspects, 1u);
            if (to < head.suspects_room)
                suspects[to] = uvec4(candidate, k, side | uint(e.polygon[side] == NONE) << 1, id - 1u);
        }
    }
}

void main() {
    uint i = dp_item();
    if (i >= min(counters[4], head.candidates_room)) return;
    Candidate c = candidates[i];
    if (c.line == NONE || c.edge == NONE) return;
    uint half_edge = 3u * c.a + c.edge;
    Spine s = spine_of(half_edge);
    if (!s.is_there || s.a.xy == s.b.xy) return;
    uvec2 range = range_of(s, 0.0);
    Plane none = Plane(vec3(0.0), vec2(0.0));
    Expected e = Expected(uint[2](NONE, NONE), Plane[2](none, none));
    if ((c.seen & 1u) != 0u) expect(c.a, false, e);
    if ((c.seen & 2u) != 0u && c.b != NONE) expect(c.b, !runs_alike(c.b, half_edge), e);
    for (uint k = range.y - range.x > 2u ? range.x + 1u : range.x; k < range.y; k += STEP) {
        Lookout at = lookout_at(s, double(k) + 0.5);
        for (uint side = 0u; side < 2u; side++) ask(i, k, at, side, e);
    }
}
