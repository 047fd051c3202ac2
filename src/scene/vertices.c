/* Places the vertices of a scene: morph targets, then joints or the node's transform.
 *
 * All in double precision, about the batch's origin, in blocks that different threads may take:
 * a vertex depends on nothing but the pose. Normals are turned by the cofactors of the same
 * matrix that moves their vertex (the inverse transpose, up to its length), so that they stay at
 * right angles to the surface where it is scaled unevenly; of a skin, by those of the vertex's
 * own mean of matrices, as if its weights were the same all around. A normal of length 0 stays
 * one. */
#include "scene/scene.h"

#include <math.h>

/* ------- matrices ------- */

/* The mean of the matrices of a vertex's joints, by their weights. */
static dp_affine blend(const dp_scene_mesh *mesh, const dp_affine *joints, uint32_t joint_count,
                       uint32_t vertex) {
    const size_t base = (size_t)vertex * mesh->influences;
    dp_affine mean = {{{0}}};
    double sum = 0;
    for (uint32_t i = 0; i < mesh->influences; i++) {
        const double weight = mesh->weights[base + i];
        const uint32_t joint = mesh->joints[base + i];
        if (!(weight > 0) || joint >= joint_count) continue;
        sum += weight;
        for (int r = 0; r < 3; r++)
            for (int c = 0; c < 4; c++) mean.row[r][c] += weight * joints[joint].row[r][c];
    }
    if (!(sum > 0)) return joints[0];
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 4; c++) mean.row[r][c] /= sum;
    return mean;
}

/* What turns normals: cofactors, negated where the matrix mirrors. */
static void find_turn(const dp_affine *matrix, double turn[3][3]) {
    dp_affine_cofactors(matrix, turn);
    if (dp_affine_determinant(matrix) < 0)
        for (int r = 0; r < 3; r++)
            for (int c = 0; c < 3; c++) turn[r][c] = -turn[r][c];
}

/* Where a scale is very small or large: by a power of two, which changes no direction, so that
 * floats hold the products. */
static void tame(double turn[3][3]) {
    double most = 0;
    int exponent;
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++) most = dp_max(most, fabs(turn[r][c]));
    if (!(most > 0) || !isfinite(most) || (most > 1e-9 && most < 1e9)) return;
    frexp(most, &exponent);
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++) turn[r][c] = ldexp(turn[r][c], 1 - exponent);
}

/* ------- one vertex, one normal ------- */

static void morph(const dp_placed *placed, uint32_t vertex, double p[3]) {
    const dp_scene_mesh *const mesh = placed->mesh;
    const float *const at = mesh->batch.positions + 3 * (size_t)vertex;
    for (int k = 0; k < 3; k++) p[k] = mesh->batch.origin[k] + (double)at[k];
    for (uint32_t m = 0; m < mesh->morph_count; m++) {
        const float *const by = mesh->morphs[m].positions;
        if (!by || placed->weights[m] == 0) continue;
        for (int k = 0; k < 3; k++) p[k] += placed->weights[m] * by[3 * (size_t)vertex + (size_t)k];
    }
}

static void morph_normal(const dp_placed *placed, uint32_t normal, double n[3]) {
    const dp_scene_mesh *const mesh = placed->mesh;
    for (int k = 0; k < 3; k++) n[k] = mesh->batch.normals.values[3 * (size_t)normal + (size_t)k];
    for (uint32_t m = 0; m < mesh->morph_count; m++) {
        const float *const by = mesh->morphs[m].normals;
        if (!by || placed->weights[m] == 0) continue;
        for (int k = 0; k < 3; k++) n[k] += placed->weights[m] * by[3 * (size_t)normal + (size_t)k];
    }
}

static void transform(const dp_affine *m, const double p[3], double to[3]) {
    for (int r = 0; r < 3; r++)
        to[r] = m->row[r][0] * p[0] + m->row[r][1] * p[1] + m->row[r][2] * p[2] + m->row[r][3];
}

static void put_position(const dp_scene *s, const dp_affine *m, const dp_placed *placed,
                         uint32_t vertex, float *to) {
    double p[3], world[3];
    morph(placed, vertex, p);
    transform(m, p, world);
    for (int k = 0; k < 3; k++) to[k] = (float)(world[k] - s->batch.origin[k]);
}

static void put_normal(double turn[3][3], const dp_placed *placed, uint32_t normal, bool is_unit,
                       float *to) {
    double n[3], t[3];
    morph_normal(placed, normal, n);
    for (int r = 0; r < 3; r++) t[r] = n[0] * turn[r][0] + n[1] * turn[r][1] + n[2] * turn[r][2];
    double by = 1;
    if (is_unit) {
        const double length = sqrt(t[0] * t[0] + t[1] * t[1] + t[2] * t[2]);
        by = length > 0 && isfinite(length) ? 1 / length : 0;
    }
    for (int r = 0; r < 3; r++) to[r] = (float)(t[r] * by);
}

/* ------- blocks ------- */

static const dp_affine *rigid_of(const dp_scene *s, const dp_placed *placed) {
    const uint32_t node = s->desc.instances[dp_scene_number(s, placed)].node;
    return node ? &s->worlds[node - 1] : &dp_affine_identity;
}

static dp_affine skinned_of(const dp_scene *s, const dp_placed *placed, uint32_t vertex) {
    const uint32_t skin = s->desc.instances[dp_scene_number(s, placed)].skin - 1;
    return blend(placed->mesh, s->joints[skin], s->desc.skins[skin].joint_count, vertex);
}

/* Have the mesh's normals the numbers of its vertices? */
static bool has_vertex_normals(const dp_scene *s, const dp_placed *placed) {
    return s->normals && placed->mesh->batch.normals.values && !placed->mesh->batch.normals.indices;
}

static void place_rigid(const dp_scene *s, const dp_placed *placed, const dp_scene_block *b) {
    const dp_affine *const matrix = rigid_of(s, placed);
    double turn[3][3];
    find_turn(matrix, turn);
    tame(turn);
    for (uint32_t v = b->first; !b->is_normals && v < b->last; v++)
        put_position(s, matrix, placed, v, s->positions + 3 * ((size_t)placed->vertex + v));
    if (!b->is_normals && !has_vertex_normals(s, placed)) return;
    for (uint32_t n = b->first; n < b->last; n++)
        put_normal(turn, placed, n, false, s->normals + 3 * ((size_t)placed->normal + n));
}

static void place_skinned(const dp_scene *s, const dp_placed *placed, const dp_scene_block *b) {
    const bool has_normals = has_vertex_normals(s, placed);
    for (uint32_t v = b->first; v < b->last; v++) {
        const dp_affine matrix = skinned_of(s, placed, v);
        double turn[3][3];
        put_position(s, &matrix, placed, v, s->positions + 3 * ((size_t)placed->vertex + v));
        if (!has_normals) continue;
        find_turn(&matrix, turn);
        put_normal(turn, placed, v, true, s->normals + 3 * ((size_t)placed->normal + v));
    }
}

static void place_skinned_normals(const dp_scene *s, const dp_placed *placed,
                                  const dp_scene_block *b) {
    const uint32_t *const owners = s->normal_owners[placed->mesh - s->desc.meshes];
    for (uint32_t n = b->first; n < b->last; n++) {
        const dp_affine matrix = skinned_of(s, placed, owners[n]);
        double turn[3][3];
        find_turn(&matrix, turn);
        put_normal(turn, placed, n, true, s->normals + 3 * ((size_t)placed->normal + n));
    }
}

static void place_block(void *arg, uint32_t index, uint32_t worker) {
    const dp_scene *const s = arg;
    const dp_scene_block *const b = &s->blocks[index];
    const dp_placed *const placed = &s->placed[b->instance];
    (void)worker;
    if (!s->dirty[b->instance]) return;
    if (!placed->is_skinned)
        place_rigid(s, placed, b);
    else if (b->is_normals)
        place_skinned_normals(s, placed, b);
    else
        place_skinned(s, placed, b);
}

void dp_scene_place(dp_scene *s) {
    if (s->threads)
        dp_parallel(s->threads, s->block_count, place_block, s);
    else
        for (uint32_t i = 0; i < s->block_count; i++) place_block(s, i, 0);
}

void dp_scene_vertex(const dp_scene *s, const dp_placed *placed, uint32_t vertex, double to[3]) {
    double p[3];
    morph(placed, vertex, p);
    if (placed->is_skinned) {
        const dp_affine matrix = skinned_of(s, placed, vertex);
        transform(&matrix, p, to);
    } else {
        transform(rigid_of(s, placed), p, to);
    }
}
