/* What Assimp's scene says beside its polygons: who read it, what is up, colours. */
#ifndef DP_IO_ASSIMP_LOOK_H
#define DP_IO_ASSIMP_LOOK_H

#include <assimp/mesh.h>
#include <assimp/scene.h>

#include <stdbool.h>

/* Did that reader make the scene? */
bool dp_assimp_is_from(const struct aiScene *scene, const char *reader);

/* What the file, or its format, says is up; otherwise *up is not changed. */
void dp_assimp_find_up(const struct aiScene *scene, double up[3]);

/* The colour of a mesh's material, in the file's own encoding; false: none. Assimp gives files without
 * materials a grey one. */
bool dp_assimp_find_color(const struct aiScene *scene, const struct aiMesh *mesh, float rgb[3]);
bool dp_assimp_is_textured(const struct aiScene *scene, const struct aiMesh *mesh);

/* Are there polygons in it, or only points and lines? */
static inline bool dp_assimp_has_areas(const struct aiMesh *mesh) {
    const unsigned areas = aiPrimitiveType_TRIANGLE | aiPrimitiveType_POLYGON;
    return !mesh->mPrimitiveTypes || (mesh->mPrimitiveTypes & areas);
}

#endif
