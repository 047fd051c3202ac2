// Polygons: each is a fan of triangles that follow each other and have its number (mesh.c). A polygon is named by the
// first of them, and its corners and edges are numbered as in the source: edge i runs from corner i to the next.
#include "scene.glsl"

uint first_of(uint triangle) {
    uint polygon = polygon_of(triangle);
    while (triangle > 0u && polygon_of(triangle - 1u) == polygon) triangle--;
    return triangle;
}
uint corner_count(uint first) {
    uint polygon = polygon_of(first), n = 3u;
    while (first + n - 2u < picture.counts.y && polygon_of(first + n - 2u) == polygon) n++;
    return n;
}
// The vertex at corner i < n.
uint vertex_at(uint first, uint i) {
    return corners[i < 2u ? 3u * first + i : 3u * (first + i - 2u) + 2u];
}
// The half-edge that is edge i of n.
uint half_edge_at(uint first, uint n, uint i) {
    if (n == 3u) return 3u * first + i;
    return i == 0u ? 3u * first : i + 1u == n ? 3u * (first + n - 3u) + 2u : 3u * (first + i - 1u) + 1u;
}
dvec3 corner_at(uint first, uint i) { return dvec3(world_of(vertex_at(first, i))); }

// By Newell's method; zero where the polygon has no area.
dvec3 unit(dvec3 v) {
    double l = length(v);
    return l > 0.0 ? v / l : dvec3(0.0);
}
dvec3 cross_of(dvec3 a, dvec3 b) {
    precise dvec3 c =
        dvec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
    return c;
}
dvec3 normal_of(uint first, uint n) {
    dvec3 o = corner_at(first, 0u), a = corner_at(first, 1u) - o, sum = dvec3(0.0);
    for (uint i = 2u; i < n; i++) {
        dvec3 b = corner_at(first, i) - o;
        sum += cross_of(a, b);
        a = b;
    }
    return unit(sum);
}
