// The primitive shader (Raskar 2001, Figure 2): one half-edge of one polygon and the view → added polygons. Half-edges
// are taken in portions, so that a list for the most that a portion may add is never full.
//
//     back face     silhouette (2.1)
//     front face    ridge, or border (2.2), and valley (2.3)
//
// PAPER: as printed. `ordered`: each half-edge has places of its own in the list, so that polygons can be
// drawn in the order in which they come, with their faces before them.
#define COMPUTE 64
#define ADDED_ACCESS
#include "quads_edge.glsl"
#include "quads_records.glsl"

uniform uint first_edge, edge_count; // of the portion
uniform uint ridge_line;             // NONE: neither ridges nor borders are drawn
uniform uint joint_list;             // 1: joints of ridges are put apart
uniform vec4 reach;                  // px: of silhouettes, ridges, valleys; how far anything reaches
uniform uvec2 reflex;                // is theta, is phi above 180 degrees?
uniform vec3 hide; // d * x + y: how near that may be drawn which grows from depth d; z 0: unknown
uniform uint blocks_x;
uniform uint ordered;

layout(std430, binding = 4) readonly buffer Blocks { float blocks[]; }; // quads_blocks.comp
layout(std430, binding = 6) writeonly buffer Counts { uint counts[]; };
uniform uint places; // ordered: of a half-edge
uint put_count = 0u;

struct Command {
    uint count, instances, first, base;
};
layout(std430, binding = 7) buffer Commands { Command commands[]; };
uniform uint first_command;
uniform uvec4 list_ends; // places of lists: 0 to x, x to y, y to z

const uint BEVEL = 32u; // a triangle between two quads
const uint LINES = 0u, JOINTS = 1u, VALLEYS = 2u;

// A place in the list; NONE: there is none, which does not happen.
uint take_place(uint list) {
    if (ordered != 0u) return put_count < places ? dp_item() * places + put_count++ : NONE;
    uint place =
        commands[first_command + list].first / 6u +
        atomicAdd(commands[first_command + list].count, 6u) / 6u;
    return place < list_ends[list] ? place : NONE;
}

// What is being added.
struct Task {
    uint line, kind, list, triangle;
    float off; // held off by so much: 1 behind, -1 before
};

void put(Task k, dvec3 p[4], dvec2 slope, dvec2 root0, dvec2 root1, double nearest) {
    uint place = take_place(k.list);
    if (place == NONE) return;
    double shift = double(-k.off * hold_off(float(nearest)));
    uint words[4] = uint[4](k.line | k.kind, k.triangle, floatBitsToUint(float(slope.x)),
                            floatBitsToUint(float(slope.y)));
    for (int i = 0; i < 4; i++)
        added[place].points[i] =
            vec4(vec2(p[i].xy), float(p[i].z + shift), uintBitsToFloat(words[i]));
    added[place].root = vec4(vec2(root0), vec2(root1));
}

#ifdef PAPER
#include "quads_paper.glsl"
#else
#include "quads_exact.glsl"
#endif

// The triangle itself, before what it adds.
void put_face(uint triangle) {
    if (picture.style.z != 0u && !is_front(triangle)) return;
    Plane plane = plane_of(triangle);
    Task k = Task(INTERSECTION, ADDED_FACE, LINES, triangle, 0.0);
    dvec3 p[4];
    for (int i = 0; i < 4; i++) p[i] = dvec3(plane.at);
    put(k, p, dvec2(plane.slope), dvec2(0.0), dvec2(0.0), 0.0);
}

// Is all that the edge adds beside the picture?
bool is_beside(uint half_edge) {
    vec4 a = screen_of(corners[half_edge]), b = screen_of(corners[next_in(half_edge)]);
    if (is_off_screen(a) || is_off_screen(b)) return false;
    vec2 low = min(a.xy, b.xy) - reach.w, high = max(a.xy, b.xy) + reach.w;
    return any(lessThan(high, vec2(0.0))) || any(greaterThan(low, picture.size.xy));
}

// Is the surface all around the edge nearer by more than what it adds reaches? Then nothing of that shows.
bool is_hidden(uint half_edge) {
    vec4 a = screen_of(corners[half_edge]), b = screen_of(corners[next_in(half_edge)]);
    if (hide.z == 0.0 || is_off_screen(a) || is_off_screen(b)) return false;
    vec2 last = picture.size.xy - 1.0;
    uvec2 from = uvec2(clamp(min(a.xy, b.xy) - reach.w, vec2(0.0), last)) / 8u,
          to = uvec2(clamp(max(a.xy, b.xy) + reach.w, vec2(0.0), last)) / 8u;
    uvec2 size = to - from + 1u;
    if (size.x * size.y > 64u) return false;
    float limit = max(a.z, b.z) * hide.x + hide.y;
    for (uint y = from.y; y <= to.y; y++)
        for (uint x = from.x; x <= to.x; x++)
            if (blocks[y * blocks_x + x] <= limit) return false;
    return true;
}

void shade(uint half_edge) {
    if (is_beside(half_edge) || !may_be_line(half_edge) || is_hidden(half_edge)) return;
    uint t = half_edge / 3u;
    Polygon p = polygon_with(t);
    if (!is_outer(p, half_edge) || (p.front && is_diagonal(half_edge))) return;
    Pen outline = Pen(double(reach.x), 0.0, 0.0, false),
        ridge = Pen(double(reach.y), picture.angles.x, picture.angles.y, reflex.x != 0u),
        valley = Pen(double(reach.z), picture.angles.z, picture.angles.w, reflex.y != 0u);
    Task first = Task(SILHOUETTE, 0u, LINES, t, 1.0), second = first;
    second.kind = BEVEL;
    bool outlines = draws(SILHOUETTE), ridges = ridge_line != NONE, valleys = draws(VALLEY);
    if (p.front) {
        first = Task(ridge_line, 0u, LINES, t, 1.0), outline = ridge;
        second = Task(VALLEY, ADDED_VALLEY, VALLEYS, t, -1.0);
    }
#ifdef PAPER
    shade_paper(p, half_edge, p.front ? ridges : outlines, p.front ? valleys : outlines, outline, valley,
                first, second);
#else
    shade_exact(p, half_edge, p.front ? ridges : outlines, p.front && valleys, outline, valley, first,
                second);
#endif
}

void main() {
    uint item = dp_item();
    if (item >= edge_count) return;
    if (ordered != 0u && (first_edge + item) % 3u == 0u) put_face((first_edge + item) / 3u);
    shade(first_edge + item);
    if (ordered != 0u) counts[item] = put_count;
}
