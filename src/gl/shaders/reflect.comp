// The mirror image of a mesh's triangles: what lies behind the plane is cut off (Sutherland and Hodgman 1974, as mesh/reflect.c), and
// corners are reversed, so that fronts stay fronts.
//
// Each triangle has room for two, and for two new vertices behind those of the mesh; what is not needed has no area and no lines.
// An edge is cut alike from both its triangles, so that mates stay mates. The edge along the plane is none.
#define COMPUTE 64
#include "picture.glsl"
#include "reflection.glsl"

layout(std430, binding = 1) readonly buffer Indices { uint indices[]; };
layout(std430, binding = 2) readonly buffer Kinds { uvec2 kinds[]; };
layout(std430, binding = 3) buffer Reflected { float reflected[]; };
layout(std430, binding = 4) writeonly buffer Corners { uint corners[]; };
layout(std430, binding = 5) writeonly buffer Triangles { uvec2 triangles[]; };
layout(std430, binding = 6) writeonly buffer Origins { uint origins[]; }; // of a corner: the corner that was kept

uniform uint vertex_count, triangle_count;
uniform uint indices_at; // words; NONE: there are no indices
uniform uint has_kinds;

struct Corner {
    uint vertex, origin;
    uint bits; // of the edge to the next corner: 1: may be a line, 8: is a diagonal
};

vec3 reflected_at(uint v) { return vec3(reflected[3u * v], reflected[3u * v + 1u], reflected[3u * v + 2u]); }

bool is_before(vec3 a, vec3 b) {
    for (int k = 0; k < 3; k++)
        if (a[k] != b[k]) return a[k] < b[k];
    return false;
}

void cut(uint to, vec3 a, double side_a, vec3 b, double side_b) {
    if (is_before(b, a)) {
        vec3 p = a;
        a = b;
        b = p;
        double s = side_a;
        side_a = side_b;
        side_b = s;
    }
    precise double t = side_a / (side_a - side_b);
    for (uint k = 0u; k < 3u; k++) {
        precise double p = double(a[k]) + (double(b[k]) - double(a[k])) * t;
        reflected[3u * to + k] = float(p);
    }
}

void put(uint t, Corner a, Corner b, Corner c, uvec2 kind) {
    uint bits = a.bits | b.bits << 1 | c.bits << 2;
    corners[3u * t] = a.vertex, corners[3u * t + 1u] = b.vertex, corners[3u * t + 2u] = c.vertex;
    origins[3u * t] = a.origin, origins[3u * t + 1u] = b.origin, origins[3u * t + 2u] = c.origin;
    triangles[t] = uvec2(kind.x, (kind.y & ~63u) | bits);
}

void main() {
    uint t = dp_item();
    if (t >= triangle_count) return;
    Corner at[3], kept[4];
    vec3 p[3];
    double side[3];
    uint count = 0u, fresh = vertex_count + 2u * t;
    uvec2 kind = has_kinds != 0u ? kinds[t] : uvec2(t, 7u);
    bool good = true, before = false;
    for (uint k = 0u; k < 3u; k++) {
        uint v = indices_at == NONE ? 3u * t + k : indices[indices_at + 3u * t + k];
        good = good && v < vertex_count;
        at[k] = Corner(good ? v : 0u, 3u * t + k, kind.y >> k & 9u);
        p[k] = reflected_at(at[k].vertex);
        side[k] = -side_of(p[k]); // images lie beyond
        before = before || side[k] > 0.0;
    }
    for (uint k = 0u; k < 2u; k++)
        for (uint c = 0u; c < 3u; c++) reflected[3u * (fresh + k) + c] = intBitsToFloat(0x7fc00000);
    for (uint k = 0u; k < 3u && good && before; k++) {
        uint n = (k + 1u) % 3u;
        bool in_a = side[k] >= 0.0, in_b = side[n] >= 0.0;
        if (in_a) kept[count++] = at[k];
        if (in_a == in_b) continue;
        cut(fresh, p[k], side[k], p[n], side[n]);
        kept[count++] = Corner(fresh++, in_a ? at[k].origin : at[n].origin, in_a ? 0u : at[k].bits);
    }
    Corner none = Corner(at[0].vertex, 3u * t, 0u);
    kind.y &= ~63u;
    put(2u * t + 1u, none, none, none, kind);
    if (count < 3u) {
        put(2u * t, none, none, none, kind);
        return;
    }
    // backwards: the edge from corner i + 1 to i is that from i to i + 1
    Corner a = kept[0], b = kept[1], c = kept[2];
    if (count == 4u) {
        Corner d = kept[3];
        put(2u * t + 1u, Corner(a.vertex, a.origin, d.bits), Corner(d.vertex, d.origin, c.bits),
            Corner(c.vertex, c.origin, 0u), kind);
        c.bits = 0u;
    }
    put(2u * t, Corner(a.vertex, a.origin, c.bits), Corner(c.vertex, c.origin, b.bits),
        Corner(b.vertex, b.origin, a.bits), kind);
}
