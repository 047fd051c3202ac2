// Where neighbouring samples show two polygons whose planes cross between them, these are asked whether they cross, and
// from there on their neighbours, as the crossing leads over the surfaces.
#define COMPUTE_PIXELS
#include "crossings.glsl"
#include "ids.glsl"

layout(std430, binding = 4) readonly buffer Mates { uint mates[]; };

const int STEPS = 64;        // of a walk, each way
const uint NO_PAIR = 0xFFFFFFFFu;

uint key_at(uint vertex) { return floatBitsToUint(vertices[vertex].screen.w); }

// The number of the pair if nobody has asked for it yet; NO_PAIR: it is known, or there is no room.
uint claim(uint a, uint b) {
    uint at = (a * 0x9e3779b1u ^ b * 0x85ebca77u), number = NO_PAIR;
    at ^= at >> 15;
    for (uint i = 0u; i < head.slots; i++) {
        uint slot = (at + i) & (head.slots - 1u), had = words[slot];
        if (had == 0u) {
            if (number == NO_PAIR) {
                number = atomicAdd(head.pairs, 1u);
                if (number >= head.pairs_room) return NO_PAIR;
                pairs[number].a = a, pairs[number].b = b, pairs[number].n = 0u;
                memoryBarrierBuffer();
            }
            had = atomicCompSwap(words[slot], 0u, number + 1u);
            if (had == 0u) return number;
        }
        if (pairs[had - 1u].a == a && pairs[had - 1u].b == b) return NO_PAIR;
    }
    return NO_PAIR;
}

uint shared_corners(uint a, uint na, uint b, uint nb) {
    uint count = 0u;
    for (uint i = 0u; i < na; i++) {
        uint key = key_at(vertex_at(a, i));
        for (uint k = 0u; k < nb; k++) count += uint(key == key_at(vertex_at(b, k)));
    }
    return count;
}

vec4 screen_at(dvec3 p) {
    ClipPoint c;
    dvec4 h = dvec4(p, 1.0);
    for (int r = 0; r < 4; r++) c.c[r] = dot(picture.clip[r], h);
    c.distance = dot(picture.sight, h);
    if (!(c.c.w > 0.0) || c.c.z < -c.c.w) return vec4(intBitsToFloat(0x7fc00000));
    return vec4(vec3(to_screen(c)), 0.0);
}

// Asks a pair that nobody has asked for; true: they cross, and it leads on to `x`.
bool ask(uint p, uint q, out Crossing x) {
    if (p == q || shared_corners(p, corner_count(p), q, corner_count(q)) > 1u) return false;
    uint a = min(p, q), b = max(p, q), number = claim(a, b);
    if (number == NO_PAIR || !cross_polygons(a, b, x)) return false;
    pairs[number].p = screen_at(x.p), pairs[number].q = screen_at(x.q);
    pairs[number].n = 1u;
    return true;
}

// The polygon across an edge of one of two; NONE: there is none, or several.
uint across(uint first, uint edge) {
    uint mate = mates[half_edge_at(first, corner_count(first), edge)];
    return is_mate(mate) ? first_of(mate_of(mate) / 3u) : NONE;
}
void follow(uint a, uint b, Crossing x, int end) {
    vec2 at = screen_at(end == 0 ? x.p : x.q).xy;
    for (int i = 0; i < STEPS; i++) {
        if (!(all(greaterThan(at, vec2(-2.0))) && all(lessThan(at, picture.size.xy + 2.0)))) return;
        bool of_b = (x.edge[end] & OF_B) != 0u;
        uint stays = of_b ? a : b, next = across(of_b ? b : a, x.edge[end] & ~OF_B);
        if (next == NONE || next == stays || !ask(stays, next, x)) return;
        a = min(stays, next), b = max(stays, next);
        vec2 p = screen_at(x.p).xy, q = screen_at(x.q).xy; // from the end that lies there to the other
        end = distance(p, at) < distance(q, at) ? 1 : 0;
        at = end == 0 ? p : q;
    }
}

// Do all corners of the triangle lie on one side of a plane, but for those that another one has, too?
bool is_beside(uint triangle, Plane plane, uint other) {
    bool nearer = false, further = false;
    for (uint i = 0u; i < 3u; i++) {
        uint v = corners[3u * triangle + i], key = key_at(v);
        vec4 s = screen_of(v);
        if (is_off_screen(s)) return false;
        bool apart = key != key_at(corners[3u * other]) && key != key_at(corners[3u * other + 1u]) &&
                     key != key_at(corners[3u * other + 2u]);
        float gap = s.z - plane_at(plane, s.xy);
        nearer = nearer || (apart && gap >= 0.0), further = further || (apart && gap <= 0.0);
    }
    return !(nearer && further);
}
// Two samples show two triangles. Is each the nearer one where it is seen?
bool planes_cross(uint t, vec2 at_t, uint u, vec2 at_u, out Plane p, out Plane q) {
    p = plane_of(t), q = plane_of(u);
    float slopes = abs(p.slope.x) + abs(p.slope.y) + abs(q.slope.x) + abs(q.slope.y),
          gap_t = plane_at(p, at_t) - plane_at(q, at_t), gap_u = plane_at(q, at_u) - plane_at(p, at_u);
    float tolerance = 0.02 * (depth_steps(plane_at(p, at_t), 1.0) + slopes);
    return gap_t >= -tolerance && gap_u >= -tolerance;
}

void test(uint id, vec2 at, uint other, vec2 other_at) {
    if (id == other || !is_triangle(id) || !is_triangle(other)) return;
    uint t = id - 1u, u = other - 1u;
    if (polygon_of(t) == polygon_of(u)) return;
    Plane p, q;
    if (!planes_cross(t, at, u, other_at, p, q)) return;
    uint a = first_of(t), b = first_of(u);
    bool triangles_ = corner_count(a) == 3u && corner_count(b) == 3u;
    if (triangles_ && (is_beside(t, q, u) || is_beside(u, p, t))) return;
    Crossing x;
    if (!ask(a, b, x)) return;
    a = min(a, b), b = max(first_of(t), first_of(u));
    follow(a, b, x, 0);
    follow(a, b, x, 1);
}

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (!is_in_picture(p)) return;
    vec2 at = vec2(p) + place_of(0);
    uint id = id_at(p, 0);
    for (int i = 1; i < SAMPLES; i++) test(id, at, id_at(p, i), vec2(p) + place_of(i));
    for (int k = 0; k < 2; k++) {
        ivec2 q = p + ivec2(1 - k, k);
        if (is_in_picture(q)) test(id, at, id_at(q, 0), vec2(q) + place_of(0));
    }
}
