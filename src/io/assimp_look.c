/* Materials and metadata of Assimp's scenes. */
#include "io/assimp_look.h"

#include <assimp/commonMetaData.h>
#include <assimp/material.h>

#include <stdint.h>
#include <string.h>

bool dp_assimp_is_from(const struct aiScene *scene, const char *reader) {
    const struct aiMetadata *const data = scene->mMetaData;
    for (unsigned i = 0; data && i < data->mNumProperties; i++) {
        if (strcmp(data->mKeys[i].data, AI_METADATA_SOURCE_FORMAT) != 0) continue;
        const struct aiString *const name = data->mValues[i].mData;
        return data->mValues[i].mType == AI_AISTRING && !strcmp(name->data, reader);
    }
    return false;
}

static bool find_integer(const struct aiScene *scene, const char *key, int32_t *value) {
    const struct aiMetadata *const data = scene->mMetaData;
    for (unsigned i = 0; data && i < data->mNumProperties; i++) {
        if (strcmp(data->mKeys[i].data, key) != 0 || data->mValues[i].mType != AI_INT32) continue;
        memcpy(value, data->mValues[i].mData, sizeof *value);
        return true;
    }
    return false;
}

/* COLLADA comes turned to +y by its own up_axis; FBX as it is, with its axis beside it. */
void dp_assimp_find_up(const struct aiScene *scene, double up[3]) {
    static const char *const on_y[] = {"glTF2 Importer", "glTF Importer", "Collada Importer"};
    int32_t axis = -1, sign = 1;
    find_integer(scene, "UpAxisSign", &sign);
    find_integer(scene, "UpAxis", &axis);
    for (size_t k = 0; k < sizeof on_y / sizeof *on_y; k++)
        if (dp_assimp_is_from(scene, on_y[k])) axis = 1, sign = 1;
    if (dp_assimp_is_from(scene, "3mf Importer")) axis = 2, sign = 1;
    if (axis >= 0 && axis < 3) up[axis] = sign < 0 ? -1 : 1;
}

static const struct aiMaterial *material_of(const struct aiScene *scene,
                                            const struct aiMesh *mesh) {
    return mesh->mMaterialIndex < scene->mNumMaterials ? scene->mMaterials[mesh->mMaterialIndex]
                                                       : NULL;
}

bool dp_assimp_find_color(const struct aiScene *scene, const struct aiMesh *mesh, float rgb[3]) {
    struct aiColor4D c;
    struct aiString name;
    const struct aiMaterial *const material = material_of(scene, mesh);
    if (!material) return false;
    if (aiGetMaterialString(material, AI_MATKEY_NAME, &name) == aiReturn_SUCCESS &&
        !strcmp(name.data, AI_DEFAULT_MATERIAL_NAME))
        return false;
    if (aiGetMaterialColor(material, AI_MATKEY_COLOR_DIFFUSE, &c) != aiReturn_SUCCESS) return false;
    rgb[0] = c.r, rgb[1] = c.g, rgb[2] = c.b;
    return true;
}

bool dp_assimp_is_textured(const struct aiScene *scene, const struct aiMesh *mesh) {
    const struct aiMaterial *const material = material_of(scene, mesh);
    return material && (aiGetMaterialTextureCount(material, aiTextureType_DIFFUSE) ||
                        aiGetMaterialTextureCount(material, aiTextureType_BASE_COLOR));
}
