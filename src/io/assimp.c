/* dp_io_open and dp_io_open_memory: the library's own readers first, then Assimp.
 *
 * The scene's nodes are walked with their transforms, so that every instance of a mesh becomes
 * vertices and polygons of its own in world space; where a transform mirrors, corners are reversed,
 * so that fronts stay fronts. Groups are named "node/mesh". Nothing is welded or triangulated.
 * Taken are positions, normals, texture coordinates, colours and faces.
 *
 * That is for what stands still; scenes with bones, morph targets or animations go to
 * assimp_scene.c.
 *
 * Not handled: points, lines, reading from a pipe. Progress is reported only before and after, as
 * Assimp cannot be stopped from C. */
#include <drypoint/io.h>

#include "base/diag.h"
#include "base/vec.h"
#include "io/assimp_files.h"
#include "io/assimp_look.h"
#include "io/assimp_scene.h"
#include "io/color.h"
#include "io/readers.h"

#include <assimp/cimport.h>
#include <assimp/config.h>
#include <assimp/matrix4x4.h>
#include <assimp/scene.h>
#include <assimp/version.h>

#include <stdio.h>
#include <string.h>

/* Rows that take (x, y, z, 1) to one coordinate each. */
typedef struct transform {
    double row[3][4];
} transform;

static const transform identity = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

/* parent * local; a projective last row is ignored. */
static transform compose(const transform *parent, const struct aiMatrix4x4 *m) {
    const double local[3][4] = {
        {m->a1, m->a2, m->a3, m->a4}, {m->b1, m->b2, m->b3, m->b4}, {m->c1, m->c2, m->c3, m->c4}};
    transform product;
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 4; c++) {
            double sum = c == 3 ? parent->row[r][3] : 0;
            for (int k = 0; k < 3; k++) sum += parent->row[r][k] * local[k][c];
            product.row[r][c] = sum;
        }
    return product;
}

static bool mirrors(const transform *t) {
    const double(*const m)[4] = t->row;
    const double determinant = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                               m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                               m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
    return determinant < 0;
}

/* Transforms a normal by the matrix of cofactors, negated if the transform mirrors. */
static void turn_normal(const transform *t, struct aiVector3D n, float to[3]) {
    const double(*const m)[4] = t->row;
    const double sign = mirrors(t) ? -1 : 1, v[3] = {n.x, n.y, n.z};
    for (int r = 0; r < 3; r++) {
        const int i = (r + 1) % 3, j = (r + 2) % 3;
        double sum = 0;
        for (int c = 0; c < 3; c++) {
            const int k = (c + 1) % 3, l = (c + 2) % 3;
            sum += v[c] * (m[i][k] * m[j][l] - m[i][l] * m[j][k]);
        }
        to[r] = (float)(sign * sum);
    }
}

static bool add_attributes(dp_builder *builder, const struct aiMesh *mesh, unsigned i,
                           const transform *t) {
    if (mesh->mNormals) {
        float *const to = dp_builder_vertex_value(builder, &builder->normals, 3);
        if (!to) return false;
        turn_normal(t, mesh->mNormals[i], to);
    }
    if (mesh->mTextureCoords[0]) {
        float *const to = dp_builder_vertex_value(builder, &builder->texcoords, 2);
        if (!to) return false;
        to[0] = mesh->mTextureCoords[0][i].x, to[1] = mesh->mTextureCoords[0][i].y;
    }
    return true;
}

/* Assimp keeps float32 (in nearly all builds, also Debian's): what a file says beyond that is lost
 * before a node's transform moves it to its place. */
static void note_spacing(dp_builder *builder, const struct aiMesh *mesh, const transform *t) {
    double farthest = 0, scale = 0;
    for (unsigned i = 0; i < mesh->mNumVertices; i++) {
        const struct aiVector3D p = mesh->mVertices[i];
        farthest = dp_max(farthest,
                          dp_max(fabs((double)p.x), dp_max(fabs((double)p.y), fabs((double)p.z))));
    }
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++) scale = dp_max(scale, fabs(t->row[r][c]));
    if (sizeof(ai_real) == sizeof(float) && isfinite(farthest))
        builder->spacing = dp_max(builder->spacing, dp_float_spacing(farthest) * scale);
}

static bool add_vertices(dp_builder *builder, const struct aiMesh *mesh, const transform *t) {
    for (unsigned i = 0; i < mesh->mNumVertices; i++) {
        const struct aiVector3D p = mesh->mVertices[i];
        double position[3];
        float rounded[3];
        for (int r = 0; r < 3; r++) {
            position[r] =
                t->row[r][0] * p.x + t->row[r][1] * p.y + t->row[r][2] * p.z + t->row[r][3];
            rounded[r] = (float)position[r];
        }
        if (!dp_builder_place(builder, position, rounded)) return false;
        if (!add_attributes(builder, mesh, i, t)) return false;
    }
    return true;
}

/* The face's vertices are [base, builder->vertex_count). */
static bool add_face(dp_builder *builder, const struct aiFace *face, size_t base, bool turned,
                     uint16_t group) {
    const unsigned count = face->mNumIndices;
    const size_t vertices = builder->vertex_count - base;
    if (count < 3) return true; /* a point or a line */
    for (unsigned c = 0; c < count; c++) {
        const unsigned index = face->mIndices[turned ? count - 1 - c : c];
        if (!dp_builder_corner(builder, index < vertices ? (int64_t)(base + index) : -1))
            return false;
    }
    return dp_builder_close(builder, group);
}

static bool find_group(dp_builder *builder, const struct aiNode *node, const struct aiMesh *mesh,
                       uint16_t *group) {
    const char *const names[2] = {node->mName.data, mesh->mName.data};
    const bool both = *names[0] && *names[1] && strcmp(names[0], names[1]) != 0;
    char name[512];
    if (both)
        snprintf(name, sizeof name, "%.250s/%.250s", names[0], names[1]);
    else
        snprintf(name, sizeof name, "%.500s", *names[0] ? names[0] : names[1]);
    return dp_groups_find(&builder->names, name, group);
}

/* The colours of the last vertices, those of the mesh: each is multiplied by the material's. */
static bool add_vertex_colors(dp_builder *builder, const struct aiMesh *mesh, const float rgb[3]) {
    const size_t base = builder->vertex_count - mesh->mNumVertices;
    for (unsigned i = 0; i < mesh->mNumVertices; i++) {
        const struct aiColor4D c = mesh->mColors[0][i];
        const float product[3] = {c.r * rgb[0], c.g * rgb[1], c.b * rgb[2]};
        if (!dp_builder_vertex_color(builder, base + i, dp_color_of(product, 1))) return false;
    }
    return true;
}

/* The colours of the mesh whose vertices were added last. */
static bool add_colors(dp_builder *builder, const struct aiScene *scene, const struct aiMesh *mesh,
                       uint16_t group) {
    float rgb[3] = {1, 1, 1};
    const bool colored = dp_assimp_find_color(scene, mesh, rgb);
    if (dp_assimp_is_textured(scene, mesh)) dp_builder_note_textures(builder);
    return (!colored || dp_builder_color(builder, group, dp_color_of(rgb, 1))) &&
           (!mesh->mColors[0] || add_vertex_colors(builder, mesh, rgb));
}

static bool add_mesh(dp_builder *builder, const struct aiScene *scene, const struct aiNode *node,
                     const struct aiMesh *mesh, const transform *t) {
    if (!dp_assimp_has_areas(mesh)) return true;
    const size_t base = builder->vertex_count;
    const bool turned = mirrors(t);
    uint16_t group;
    if (!find_group(builder, node, mesh, &group) || !add_vertices(builder, mesh, t) ||
        !add_colors(builder, scene, mesh, group))
        return false;
    note_spacing(builder, mesh, t);
    for (unsigned i = 0; i < mesh->mNumFaces; i++)
        if (!add_face(builder, &mesh->mFaces[i], base, turned, group)) return false;
    return true;
}

static dp_result add_node(dp_builder *builder, const struct aiScene *scene,
                          const struct aiNode *node, const transform *parent, int depth,
                          dp_diag *diag) {
    if (!node) return DP_OK; /* Assimp's RAW reader has such children */
    if (depth > DP_ASSIMP_DEEPEST)
        return dp_fail(diag, DP_ERR_LIMIT, "nodes are nested more than %d deep: flatten the scene",
                       (int)DP_ASSIMP_DEEPEST);
    const transform t = compose(parent, &node->mTransformation);
    for (unsigned i = 0; i < node->mNumMeshes; i++)
        if (node->mMeshes[i] < scene->mNumMeshes && scene->mMeshes[node->mMeshes[i]] &&
            !add_mesh(builder, scene, node, scene->mMeshes[node->mMeshes[i]], &t))
            return dp_builder_fail(builder, diag);
    for (unsigned i = 0; i < node->mNumChildren; i++) {
        const dp_result result = add_node(builder, scene, node->mChildren[i], &t, depth + 1, diag);
        if (result) return result;
    }
    return DP_OK;
}

/* Before 5.4, the reader of 3MF frees the textures that it hands out (pictures in the archive, among
 * them thumbnails), and they would be freed again with the scene. */
static void forget_freed_textures(struct aiScene *scene) {
    const unsigned version = 100 * aiGetVersionMajor() + aiGetVersionMinor();
    if (version < 504 && dp_assimp_is_from(scene, "3mf Importer")) scene->mNumTextures = 0;
}

/* Without post-processing: its step that leaves out what is not needed would touch these textures.
 * FBX in its own axes, which later versions would turn. `files` NULL: the system's. */
static struct aiScene *import(const char *path, struct aiFileIO *files, bool pivots) {
    struct aiPropertyStore *const properties = aiCreatePropertyStore();
    if (!properties) return NULL;
    aiSetImportPropertyInteger(properties, AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, pivots);
#ifdef AI_CONFIG_IMPORT_FBX_IGNORE_UP_DIRECTION
    aiSetImportPropertyInteger(properties, AI_CONFIG_IMPORT_FBX_IGNORE_UP_DIRECTION, 1);
#endif
    struct aiScene *const scene =
        (struct aiScene *)aiImportFileExWithProperties(path, 0, files, properties);
    aiReleasePropertyStore(properties);
    if (scene) forget_freed_textures(scene);
    return scene;
}

/* FBX comes without the helper nodes that its pivots may become; only animations need them, as they
 * move one or another of these. */
static struct aiScene *import_moving(const char *path, struct aiFileIO *files) {
    struct aiScene *const plain = import(path, files, false);
    if (!plain || !plain->mNumAnimations || !dp_assimp_is_from(plain, "Autodesk FBX Importer"))
        return plain;
    struct aiScene *const pivoted = import(path, files, true);
    aiReleaseImport(pivoted ? plain : NULL);
    return pivoted ? pivoted : plain;
}

/* Copies Assimp's message as one line, up to where it names the file, which the caller names. */
static void copy_error(const char *text, const char *path, char *line, size_t size) {
    const char *const named = *path ? strstr(text, path) : NULL;
    size_t length = named ? (size_t)(named - text) : strlen(text);
    if (length > size - 1) length = size - 1;
    for (size_t i = 0; i < length; i++) line[i] = (unsigned char)text[i] < ' ' ? ' ' : text[i];
    while (length && (line[length - 1] == ' ' || line[length - 1] == '"')) length--;
    line[length] = 0;
}

/* Does a reader of Assimp's claim the file's ending? If none does, Assimp tries all, and what the
 * last one says tells nothing. */
static bool is_claimed(const char *path) {
    const char *const dot = strrchr(path, '.');
    return dot && aiIsExtensionSupported(dot);
}

static dp_result import_failed(const char *path, dp_diag *diag) {
    char line[160];
    if (strstr(aiGetErrorString(), "bad_alloc"))
        return dp_fail(diag, DP_ERR_MEMORY,
                       "out of memory while Assimp read it: it is broken, or too large");
    copy_error(aiGetErrorString(), path, line, sizeof line);
    return dp_fail(diag, DP_ERR_FORMAT, "Assimp cannot read it: %s", line);
}

static bool stopped(const dp_file_options *options, double fraction) {
    return options && options->progress && options->progress(options->user, fraction);
}

static dp_result build_still(const struct aiScene *scene, const dp_file_options *options,
                             dp_source **out, dp_diag *diag) {
    const dp_allocator memory = dp_allocator_resolve(options ? options->allocator : NULL);
    dp_builder builder;
    dp_builder_init(&builder, &memory);
    dp_result result = DP_OK;
    dp_assimp_find_up(scene, builder.up);
    if (scene->mRootNode) result = add_node(&builder, scene, scene->mRootNode, &identity, 0, diag);
    if (!result && stopped(options, 1))
        result = dp_fail(diag, DP_ERR_CANCELLED, "reading was stopped");
    if (!result) result = dp_builder_finish(&builder, out, diag);
    dp_builder_destroy(&builder);
    return result;
}

static dp_result build(const struct aiScene *scene, const dp_file_options *options, dp_source **out,
                       dp_diag *diag) {
    if (!dp_assimp_moves(scene)) return build_still(scene, options, out, diag);
    if (stopped(options, 1)) return dp_fail(diag, DP_ERR_CANCELLED, "reading was stopped");
    return dp_assimp_make_scene(scene, options ? options->allocator : NULL, out, diag);
}

/* Opens what the library's own readers did not know; `first` is their diagnostic. */
static dp_result open_by_assimp(const char *path, struct aiFileIO *files, const dp_diag *first,
                                const dp_file_options *options, dp_source **out, dp_diag *diag) {
    if (stopped(options, -1)) return dp_fail(diag, DP_ERR_CANCELLED, "reading was stopped");
    const struct aiScene *const scene = import_moving(path, files);
    const dp_result result = scene ? build(scene, options, out, diag) : import_failed(path, diag);
    aiReleaseImport(scene);
    if (result != DP_ERR_FORMAT || is_claimed(path)) return result;
    if (diag) *diag = *first;
    return first->result;
}

/* Is Assimp to try? Not if the caller has named a format, or the file's name has: Assimp goes by
 * its ending, too. */
static bool is_for_assimp(dp_result result, const char *name, const dp_file_options *options) {
    return result == DP_ERR_UNSUPPORTED && (!options || options->format == DP_FORMAT_AUTO) &&
           !dp_has_own_ending(name);
}

dp_result dp_io_open(const char *path, const dp_file_options *options, dp_source **out,
                     dp_diag *diag) {
    dp_diag first = {0};
    if (!out) return dp_fail(diag, DP_ERR_ARGUMENT, "dp_io_open: out is NULL");
    *out = NULL;
    if (!path) return dp_fail(diag, DP_ERR_ARGUMENT, "dp_io_open: path is NULL");
    const dp_result result = dp_open_path(path, options, true, out, &first);
    if (diag && result) *diag = first;
    if (!is_for_assimp(result, path, options) || strcmp(path, "-") == 0) return result;
    return open_by_assimp(path, NULL, &first, options, out, diag);
}

dp_result dp_io_open_memory(const dp_memory_file *file, const dp_file_options *options,
                            dp_source **out, dp_diag *diag) {
    dp_diag first = {0};
    if (!out) return dp_fail(diag, DP_ERR_ARGUMENT, "dp_io_open_memory: out is NULL");
    *out = NULL;
    if (!file || (file->size && !file->data))
        return dp_fail(diag, DP_ERR_ARGUMENT, "dp_io_open_memory: file or its data is NULL");
    const dp_result result = dp_open_memory(file, options, true, out, &first);
    if (diag && result) *diag = first;
    if (!is_for_assimp(result, file ? file->name : NULL, options)) return result;
    const dp_allocator memory = dp_allocator_resolve(options ? options->allocator : NULL);
    dp_assimp_files files;
    dp_assimp_files_init(&files, file, &memory);
    return open_by_assimp(files.name, &files.io, &first, options, out, diag);
}
