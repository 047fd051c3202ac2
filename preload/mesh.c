/* mesh.c: turns the vertices of a primitive into triangles, as in the OpenGL specification's section on
 * primitive types.
 *
 * Raskar's method wants convex polygons with their own edges: a quad's diagonal is not one. So each corner
 * says whether its edge belongs to the polygon. Triangles of a fan or strip have all three.
 * Invariant: a mesh's count is a multiple of 3 and at most MESH_CORNERS_MAX.
 *
 * Not handled: glEdgeFlag (it is about wire frames), and quads that are not plane lose their diagonal, so a
 * crease along it has no line. */
#include "mesh.h"
#include "real.h"

#include <stdlib.h>
#include <string.h>

struct mesh *mesh_create(void) {
    struct mesh *const mesh = calloc(1, sizeof *mesh);
    if (mesh) atomic_init(&mesh->users, 1);
    return mesh;
}

struct mesh *mesh_share(struct mesh *mesh) {
    atomic_fetch_add(&mesh->users, 1);
    return mesh;
}

void mesh_release(struct mesh *mesh) {
    if (!mesh || atomic_fetch_sub(&mesh->users, 1) != 1) return;
    free(mesh->corners);
    free(mesh);
}

bool is_polygon_mode(unsigned mode) { return mode >= GL_TRIANGLES && mode <= GL_POLYGON; }

void builder_begin(struct polygon_builder *builder, unsigned mode) {
    builder->open = true;
    builder->unknown = !is_polygon_mode(mode);
    builder->mode = mode;
    builder->count = 0;
}

static bool vertices_grow(struct polygon_builder *builder) {
    const size_t room = builder->room ? 2 * builder->room : 256;
    if (room > MESH_CORNERS_MAX) return false;
    float(*const grown)[3] = realloc(builder->vertices, room * sizeof *grown);
    if (!grown) return false;
    builder->vertices = grown;
    builder->room = room;
    return true;
}

void builder_vertex(struct polygon_builder *builder, float x, float y, float z, float w) {
    if (!builder->open || builder->unknown) return;
    if (!(w > 0) || (builder->count == builder->room && !vertices_grow(builder))) {
        builder->unknown = true;
        return;
    }
    float *const vertex = builder->vertices[builder->count++];
    vertex[0] = x / w;
    vertex[1] = y / w;
    vertex[2] = z / w;
}

static bool mesh_reserve(struct mesh *mesh, size_t more) {
    if (more > MESH_CORNERS_MAX - mesh->count) return false;
    if (mesh->count + more <= mesh->room) return true;
    size_t room = mesh->room ? mesh->room : 96;
    while (room < mesh->count + more) room *= 2;
    struct corner *const grown = realloc(mesh->corners, room * sizeof *grown);
    if (!grown) return false;
    mesh->corners = grown;
    mesh->room = room;
    return true;
}

enum { EDGE_AB = 1, EDGE_BC = 2, EDGE_CA = 4, EDGES_ALL = 7 };

/* Room is reserved. */
static void add_triangle(struct mesh *mesh, const struct polygon_builder *builder, size_t a,
                         size_t b, size_t c, unsigned edges) {
    const size_t index[3] = {a, b, c};
    for (int i = 0; i < 3; i++) {
        const float *const v = builder->vertices[index[i]];
        mesh->corners[mesh->count++] = (struct corner){v[0], v[1], v[2], (float)(edges >> i & 1)};
    }
}

static bool same_place(const struct polygon_builder *builder, size_t a, size_t b) {
    return memcmp(builder->vertices[a], builder->vertices[b], sizeof builder->vertices[a]) == 0;
}

/* Quads are often used for triangles, by giving a corner twice: then no diagonal divides it. */
static void add_quad(struct mesh *mesh, const struct polygon_builder *builder, size_t a, size_t b,
                     size_t c, size_t d) {
    if (same_place(builder, a, b) || same_place(builder, b, c)) {
        add_triangle(mesh, builder, a, c, d, EDGES_ALL);
    } else if (same_place(builder, c, d) || same_place(builder, d, a)) {
        add_triangle(mesh, builder, a, b, c, EDGES_ALL);
    } else {
        add_triangle(mesh, builder, a, b, c, EDGE_AB | EDGE_BC);
        add_triangle(mesh, builder, a, c, d, EDGE_BC | EDGE_CA);
    }
}

static void add_polygon(struct mesh *mesh, const struct polygon_builder *builder) {
    for (size_t i = 1; i + 1 < builder->count; i++)
        add_triangle(mesh, builder, 0, i, i + 1,
                     EDGE_BC | (i == 1 ? EDGE_AB : 0) | (i + 2 == builder->count ? EDGE_CA : 0));
}

/* Vertices that are left over make nothing, as in OpenGL. */
static void add_primitives(struct mesh *mesh, const struct polygon_builder *builder) {
    const size_t n = builder->count;
    switch (builder->mode) {
    case GL_TRIANGLES:
        for (size_t i = 0; i + 2 < n; i += 3)
            add_triangle(mesh, builder, i, i + 1, i + 2, EDGES_ALL);
        break;
    case GL_TRIANGLE_STRIP:
        for (size_t i = 0; i + 2 < n; i++)
            add_triangle(mesh, builder, i + i % 2, i + 1 - i % 2, i + 2, EDGES_ALL);
        break;
    case GL_TRIANGLE_FAN:
        for (size_t i = 1; i + 1 < n; i++) add_triangle(mesh, builder, 0, i, i + 1, EDGES_ALL);
        break;
    case GL_QUADS:
        for (size_t i = 0; i + 3 < n; i += 4) add_quad(mesh, builder, i, i + 1, i + 2, i + 3);
        break;
    case GL_QUAD_STRIP:
        for (size_t i = 0; i + 3 < n; i += 2) add_quad(mesh, builder, i, i + 1, i + 3, i + 2);
        break;
    case GL_POLYGON:
        add_polygon(mesh, builder);
        break;
    default:
        break;
    }
}

bool builder_end(struct polygon_builder *builder, struct mesh *mesh) {
    builder->open = false;
    if (builder->unknown || builder->count < 3) return true;
    if (!mesh_reserve(mesh, 3 * builder->count)) return false; /* no mode makes more */
    add_primitives(mesh, builder);
    return true;
}

void builder_free(struct polygon_builder *builder) {
    free(builder->vertices);
    *builder = (struct polygon_builder){0};
}
