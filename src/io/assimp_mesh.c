/* Meshes of Assimp's as those of drypoint/scene.h: arrays without gaps. Points and lines are left out;
 * indices out of range stay so, and drawing drops their polygons. */
#include "io/assimp_look.h"
#include "io/assimp_scene.h"
#include "io/color.h"
#include "mesh/wide.h"

#include <math.h>
#include <string.h>

/* Assimp's vectors as floats; NULL: memory is out. */
static float *copy_vectors(dp_assimp_tables *t, const struct aiVector3D *from, unsigned count,
                           unsigned width) {
    float *const to = dp_arena_take(&t->arena, dp_times(count, width), sizeof *to);
    for (unsigned i = 0; to && i < count; i++) {
        const float v[3] = {(float)from[i].x, (float)from[i].y, (float)from[i].z};
        memcpy(to + (size_t)i * width, v, width * sizeof *to);
    }
    return to;
}

static bool fill_attribute(dp_assimp_tables *t, const struct aiVector3D *from, unsigned count,
                           unsigned width, dp_attribute *to) {
    if (!from) return true;
    to->values = copy_vectors(t, from, count, width);
    to->count = count;
    to->stride = width * sizeof(float);
    return to->values;
}

/* Counts polygons and their corners. True: all are triangles. */
static bool count_polygons(const struct aiMesh *from, dp_batch *to) {
    bool only_triangles = true;
    for (unsigned i = 0; i < from->mNumFaces; i++) {
        const unsigned corners = from->mFaces[i].mNumIndices;
        if (corners < 3) continue; /* a point or a line */
        only_triangles &= corners == 3;
        to->polygon_count++;
        to->corner_count += corners;
    }
    return only_triangles;
}

static bool fill_polygons(dp_assimp_tables *t, const struct aiMesh *from, dp_batch *to) {
    const bool only_triangles = count_polygons(from, to);
    uint32_t *const indices = dp_arena_take(&t->arena, to->corner_count, sizeof *indices);
    uint32_t *const firsts = dp_arena_take(&t->arena, to->polygon_count + 1, sizeof *firsts);
    size_t polygon = 0, corner = 0;
    if (!indices || !firsts) return false;
    for (unsigned i = 0; i < from->mNumFaces; i++) {
        const struct aiFace *const face = &from->mFaces[i];
        if (face->mNumIndices < 3) continue;
        for (unsigned k = 0; k < face->mNumIndices; k++)
            indices[corner++] =
                face->mIndices[k] < from->mNumVertices ? face->mIndices[k] : UINT32_MAX;
        firsts[++polygon] = (uint32_t)corner;
    }
    to->indices = indices;
    to->firsts = only_triangles ? NULL : firsts;
    return true;
}

/* The colours of vertices: each is multiplied by the material's. */
static bool fill_colors(dp_assimp_tables *t, const struct aiMesh *from, dp_scene_mesh *to) {
    float rgb[3] = {1, 1, 1};
    if (dp_assimp_find_color(t->from, from, rgb)) to->color = dp_color_of(rgb, 1);
    if (!from->mColors[0]) return true;
    uint32_t *const colors = dp_arena_take(&t->arena, from->mNumVertices, sizeof *colors);
    for (unsigned i = 0; colors && i < from->mNumVertices; i++) {
        const struct aiColor4D c = from->mColors[0][i];
        const float product[3] = {c.r * rgb[0], c.g * rgb[1], c.b * rgb[2]};
        colors[i] = dp_color_of(product, 1);
    }
    to->batch.colors = colors;
    return colors;
}

/* Morph targets come as positions, but for COLLADA's relative ones, and become what is added. */
static const float *subtract(dp_assimp_tables *t, const struct aiVector3D *target,
                             const struct aiVector3D *base, unsigned count) {
    float *const to = copy_vectors(t, target, count, 3);
    for (unsigned i = 0; to && base && i < count; i++) {
        to[3 * (size_t)i] = (float)((double)target[i].x - (double)base[i].x);
        to[3 * (size_t)i + 1] = (float)((double)target[i].y - (double)base[i].y);
        to[3 * (size_t)i + 2] = (float)((double)target[i].z - (double)base[i].z);
    }
    return to;
}

static bool fill_morphs(dp_assimp_tables *t, const struct aiMesh *from, dp_scene_mesh *to) {
    const bool relative = from->mMethod == aiMorphingMethod_MORPH_RELATIVE &&
                          dp_assimp_is_from(t->from, "Collada Importer");
    const unsigned count = from->mNumVertices;
    dp_scene_morph *const morphs = dp_arena_take(&t->arena, from->mNumAnimMeshes, sizeof *morphs);
    if (!morphs) return false;
    for (unsigned k = 0; k < from->mNumAnimMeshes; k++) {
        const struct aiAnimMesh *const target = from->mAnimMeshes[k];
        if (!target || target->mNumVertices != count) continue;
        if (target->mVertices &&
            !(morphs[k].positions =
                  subtract(t, target->mVertices, relative ? NULL : from->mVertices, count)))
            return false;
        if (target->mNormals && from->mNormals &&
            !(morphs[k].normals =
                  subtract(t, target->mNormals, relative ? NULL : from->mNormals, count)))
            return false;
    }
    to->morphs = morphs;
    to->morph_count = from->mNumAnimMeshes;
    return true;
}

/* Assimp keeps float32 (in nearly all builds, also Debian's): what a file says beyond that is lost
 * before anything moves it. */
static double spacing_of(const struct aiMesh *from) {
    double farthest = 0;
    for (unsigned i = 0; i < from->mNumVertices; i++) {
        const struct aiVector3D p = from->mVertices[i];
        farthest =
            fmax(farthest, fmax(fabs((double)p.x), fmax(fabs((double)p.y), fabs((double)p.z))));
    }
    return sizeof(ai_real) == sizeof(float) && isfinite(farthest) ? dp_float_spacing(farthest) : 0;
}

static bool fill_mesh(dp_assimp_tables *t, const struct aiMesh *from, dp_scene_mesh *to,
                      dp_assimp_mesh *part) {
    const unsigned count = from->mNumVertices;
    to->name = *from->mName.data ? from->mName.data : NULL;
    part->has_areas = dp_assimp_has_areas(from);
    if (!part->has_areas) return true;
    to->batch.positions = copy_vectors(t, from->mVertices, count, 3);
    to->batch.position_stride = 3 * sizeof(float);
    to->batch.vertex_count = count;
    to->batch.spacing = spacing_of(from);
    to->batch.stable = true;
    return to->batch.positions && fill_polygons(t, from, &to->batch) &&
           fill_attribute(t, from->mNormals, count, 3, &to->batch.normals) &&
           fill_attribute(t, from->mTextureCoords[0], count, 2, &to->batch.texcoords) &&
           fill_colors(t, from, to) && (!from->mNumAnimMeshes || fill_morphs(t, from, to)) &&
           (!from->mNumBones || dp_assimp_fill_bones(t, from, to, part));
}

bool dp_assimp_fill_meshes(dp_assimp_tables *t) {
    const unsigned count = t->from->mNumMeshes;
    t->meshes = dp_arena_take(&t->arena, count, sizeof *t->meshes);
    t->parts = dp_arena_take(&t->arena, count, sizeof *t->parts);
    if (!t->meshes || !t->parts) return false;
    for (unsigned i = 0; i < count; i++)
        if (t->from->mMeshes[i] && !fill_mesh(t, t->from->mMeshes[i], &t->meshes[i], &t->parts[i]))
            return false;
    return true;
}
