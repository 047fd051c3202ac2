/* The one batch of all instances of a scene. Indices, groups, texture coordinates and colours
 * are made once; positions and normals have room, and are written by each pose. */
#include "scene/scene.h"

#include "base/hostile.h"
#include "mesh/wide.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { BLOCK = DP_TUNED(2048, 3) /* vertices of a task */, NAME = 512 /* bytes */ };

/* ------- where what lies ------- */

static const dp_batch *batch_of(const dp_scene *s, uint32_t i) {
    return &s->desc.meshes[s->desc.instances[i].mesh - 1].batch;
}

static bool is_indexed(const dp_scene *s, bool texcoords) {
    for (uint32_t i = 0; i < s->desc.instance_count; i++) {
        const dp_batch *const b = batch_of(s, i);
        if ((texcoords ? b->texcoords : b->normals).indices) return true;
    }
    return false;
}

/* Values that an instance has of an attribute: without indices, one for each vertex. */
static uint32_t value_count(const dp_attribute *a, const dp_batch *b, bool indexed) {
    return (uint32_t)(!indexed ? b->vertex_count : a->values ? a->count : 0);
}

static const char *copy_name(dp_scene *s, const dp_scene_instance *instance) {
    const char *node = instance->node ? s->desc.nodes[instance->node - 1].name : NULL;
    const char *mesh = s->desc.meshes[instance->mesh - 1].name;
    char name[NAME];
    bool enough = true;
    if (!node) node = "";
    if (!mesh) mesh = "";
    if (*node && *mesh && strcmp(node, mesh) != 0)
        snprintf(name, sizeof name, "%.250s/%.250s", node, mesh);
    else
        snprintf(name, sizeof name, "%.500s", *node ? node : mesh);
    return dp_arena_text(&s->arena, name, &enough);
}

static bool lay_out(dp_scene *s) {
    const bool indexed = is_indexed(s, false);
    dp_batch *const sum = &s->batch;
    size_t normals = 0;
    for (uint32_t i = 0; i < s->desc.instance_count; i++) {
        const dp_scene_instance *const instance = &s->desc.instances[i];
        const dp_scene_mesh *const mesh = &s->desc.meshes[instance->mesh - 1];
        const bool skinned =
            instance->skin && mesh->influences && s->desc.skins[instance->skin - 1].joint_count;
        s->placed[i] = (dp_placed){.mesh = mesh,
                                   .name = copy_name(s, instance),
                                   .vertex = (uint32_t)sum->vertex_count,
                                   .corner = (uint32_t)sum->corner_count,
                                   .polygon = (uint32_t)sum->polygon_count,
                                   .normal = (uint32_t)normals,
                                   .is_skinned = skinned};
        if (!s->placed[i].name) return false;
        sum->vertex_count += mesh->batch.vertex_count;
        sum->corner_count += mesh->batch.corner_count;
        sum->polygon_count += mesh->batch.polygon_count;
        normals += value_count(&mesh->batch.normals, &mesh->batch, indexed);
    }
    return true;
}

/* ------- polygons ------- */

static bool any_has(const dp_scene *s, size_t pointer) {
    for (uint32_t i = 0; i < s->desc.instance_count; i++) {
        const void *array;
        memcpy(&array, (const char *)batch_of(s, i) + pointer, sizeof array);
        if (array) return true;
    }
    return false;
}

static bool fill_corners(dp_scene *s) {
    s->indices = dp_arena_take(&s->arena, s->batch.corner_count, sizeof *s->indices);
    s->batch.indices = s->indices;
    for (uint32_t i = 0; s->indices && i < s->desc.instance_count; i++) {
        const dp_batch *const b = batch_of(s, i);
        uint32_t *const to = s->indices + s->placed[i].corner;
        for (size_t c = 0; c < b->corner_count; c++)
            to[c] =
                b->indices[c] < b->vertex_count ? s->placed[i].vertex + b->indices[c] : UINT32_MAX;
    }
    return s->indices;
}

static bool fill_firsts(dp_scene *s) {
    if (!any_has(s, offsetof(dp_batch, firsts))) return true;
    uint32_t *const firsts = dp_arena_take(&s->arena, s->batch.polygon_count + 1, sizeof *firsts);
    s->batch.firsts = firsts;
    for (uint32_t i = 0; firsts && i < s->desc.instance_count; i++) {
        const dp_batch *const b = batch_of(s, i);
        uint32_t *const to = firsts + s->placed[i].polygon;
        for (uint32_t p = 0; p <= b->polygon_count; p++)
            to[p] = s->placed[i].corner + (b->firsts ? b->firsts[p] : 3 * p);
    }
    return firsts;
}

static bool fill_flags(dp_scene *s) {
    if (!any_has(s, offsetof(dp_batch, edge_flags))) return true;
    s->edge_flags = dp_arena_take(&s->arena, s->batch.corner_count, 1);
    s->batch.edge_flags = s->edge_flags;
    if (!s->edge_flags) return false;
    memset(s->edge_flags, 1, s->batch.corner_count);
    for (uint32_t i = 0; i < s->desc.instance_count; i++) {
        const dp_batch *const b = batch_of(s, i);
        if (b->edge_flags)
            memcpy(s->edge_flags + s->placed[i].corner, b->edge_flags, b->corner_count);
    }
    return true;
}

static bool fill_groups(dp_scene *s) {
    uint16_t *const groups = dp_arena_take(&s->arena, s->batch.polygon_count, sizeof *groups);
    s->batch.groups = groups;
    for (uint32_t i = 0; groups && i < s->desc.instance_count; i++)
        for (size_t p = 0; p < batch_of(s, i)->polygon_count; p++)
            groups[s->placed[i].polygon + p] = (uint16_t)(i < UINT16_MAX ? i : UINT16_MAX);
    return groups;
}

static bool fill_colors(dp_scene *s) {
    if (!any_has(s, offsetof(dp_batch, colors))) return true;
    uint32_t *const colors = dp_arena_take(&s->arena, s->batch.vertex_count, sizeof *colors);
    s->batch.colors = colors;
    for (uint32_t i = 0; colors && i < s->desc.instance_count; i++) {
        const dp_batch *const b = batch_of(s, i);
        if (b->colors)
            memcpy(colors + s->placed[i].vertex, b->colors, b->vertex_count * sizeof *colors);
    }
    return colors;
}

/* ------- attributes ------- */

static bool fill_value_numbers(dp_scene *s, bool texcoords, uint32_t **numbers) {
    *numbers = dp_arena_take(&s->arena, s->batch.corner_count, sizeof **numbers);
    uint32_t first = 0;
    for (uint32_t i = 0; *numbers && i < s->desc.instance_count; i++) {
        const dp_batch *const b = batch_of(s, i);
        const dp_attribute *const a = texcoords ? &b->texcoords : &b->normals;
        const uint32_t count = value_count(a, b, true);
        for (size_t c = 0; c < b->corner_count; c++) {
            const uint32_t number = a->indices ? a->indices[c] : b->indices[c];
            (*numbers)[s->placed[i].corner + c] = number < count ? first + number : UINT32_MAX;
        }
        first += count;
    }
    return *numbers;
}

static size_t count_values(const dp_scene *s, bool texcoords, bool indexed) {
    size_t count = 0;
    for (uint32_t i = 0; i < s->desc.instance_count; i++) {
        const dp_batch *const b = batch_of(s, i);
        count += value_count(texcoords ? &b->texcoords : &b->normals, b, indexed);
    }
    return count;
}

static bool fill_texcoords(dp_scene *s) {
    const bool indexed = is_indexed(s, true);
    if (!any_has(s, offsetof(dp_batch, texcoords.values))) return true;
    dp_attribute *const all = &s->batch.texcoords;
    all->count = count_values(s, true, indexed);
    float *const values = dp_arena_take(&s->arena, all->count, 2 * sizeof *values);
    all->values = values;
    if (!values || (indexed && !fill_value_numbers(s, true, &s->texcoord_indices))) return false;
    all->indices = s->texcoord_indices;
    size_t first = 0;
    for (uint32_t i = 0; i < s->desc.instance_count; i++) {
        const dp_batch *const b = batch_of(s, i);
        const uint32_t count = value_count(&b->texcoords, b, indexed);
        if (b->texcoords.values)
            memcpy(values + 2 * first, b->texcoords.values, 2 * sizeof *values * count);
        first += count;
    }
    return true;
}

static bool fill_normals(dp_scene *s) {
    const bool indexed = is_indexed(s, false);
    if (!any_has(s, offsetof(dp_batch, normals.values))) return true;
    dp_attribute *const all = &s->batch.normals;
    all->count = count_values(s, false, indexed);
    s->normals = dp_arena_take(&s->arena, all->count, 3 * sizeof *s->normals);
    all->values = s->normals;
    if (!s->normals || (indexed && !fill_value_numbers(s, false, &s->normal_indices))) return false;
    all->indices = s->normal_indices;
    return true;
}

/* The vertices of normals that have numbers of their own. */
static bool find_owners(dp_scene *s, uint32_t m) {
    const dp_batch *const b = &s->desc.meshes[m].batch;
    if (!b->normals.indices || !s->desc.meshes[m].influences) return true;
    uint32_t *const owners = dp_arena_take(&s->arena, b->normals.count, sizeof *owners);
    s->normal_owners[m] = owners;
    for (size_t c = b->corner_count; owners && c > 0; c--) /* the first corner tells */
        if (b->normals.indices[c - 1] < b->normals.count && b->indices[c - 1] < b->vertex_count)
            owners[b->normals.indices[c - 1]] = b->indices[c - 1];
    return owners;
}

/* ------- blocks ------- */

static uint32_t blocks_of(size_t count) { return (uint32_t)((count + BLOCK - 1) / BLOCK); }

static void cut(dp_scene *s, uint32_t instance, size_t count, bool normals) {
    for (size_t first = 0; first < count; first += BLOCK)
        s->blocks[s->block_count++] =
            (dp_scene_block){.instance = instance,
                             .first = (uint32_t)first,
                             .last = (uint32_t)(first + BLOCK < count ? first + BLOCK : count),
                             .is_normals = normals};
}

static size_t own_normals(const dp_batch *b) {
    return b->normals.indices && b->vertex_count ? b->normals.count : 0;
}

static bool fill_blocks(dp_scene *s) {
    size_t count = 0;
    for (uint32_t i = 0; i < s->desc.instance_count; i++)
        count += (size_t)blocks_of(batch_of(s, i)->vertex_count) +
                 blocks_of(own_normals(batch_of(s, i)));
    s->blocks = dp_arena_take(&s->arena, count, sizeof *s->blocks);
    for (uint32_t i = 0; s->blocks && i < s->desc.instance_count; i++) {
        cut(s, i, batch_of(s, i)->vertex_count, false);
        cut(s, i, own_normals(batch_of(s, i)), true);
    }
    return s->blocks;
}

bool dp_scene_build(dp_scene *s) {
    s->placed = dp_arena_take(&s->arena, s->desc.instance_count, sizeof *s->placed);
    s->normal_owners = dp_arena_take(&s->arena, s->desc.mesh_count, sizeof *s->normal_owners);
    s->batch = (dp_batch){.stable = true, .position_stride = 3 * sizeof(float)};
    if (!s->placed || !s->normal_owners || !lay_out(s)) return false;
    s->positions = dp_arena_take(&s->arena, s->batch.vertex_count, 3 * sizeof *s->positions);
    s->batch.positions = s->positions;
    bool enough = s->positions && fill_corners(s) && fill_firsts(s) && fill_flags(s) &&
                  fill_groups(s) && fill_colors(s) && fill_texcoords(s) && fill_normals(s) &&
                  fill_blocks(s);
    for (uint32_t m = 0; enough && m < s->desc.mesh_count; m++) enough = find_owners(s, m);
    return enough;
}

/* ------- mirrored instances ------- */

static void reverse(uint32_t *items, size_t first, size_t last) {
    for (; items && first + 1 < last; first++, last--) {
        const uint32_t swap = items[first];
        items[first] = items[last - 1], items[last - 1] = swap;
    }
}

/* A flag belongs to the edge after its corner: the last one stays where it is. */
static void reverse_flags(uint8_t *flags, size_t first, size_t last) {
    for (; flags && first + 2 < last; first++, last--) {
        const uint8_t swap = flags[first];
        flags[first] = flags[last - 2], flags[last - 2] = swap;
    }
}

void dp_scene_turn(dp_scene *s, dp_placed *placed) {
    const dp_batch *const b = &placed->mesh->batch;
    for (size_t p = 0; p < b->polygon_count; p++) {
        const size_t first = placed->corner + (b->firsts ? b->firsts[p] : 3 * p);
        const size_t last = placed->corner + (b->firsts ? b->firsts[p + 1] : 3 * p + 3);
        reverse(s->indices, first, last);
        reverse(s->normal_indices, first, last);
        reverse(s->texcoord_indices, first, last);
        reverse_flags(s->edge_flags, first, last);
    }
    placed->is_turned = !placed->is_turned;
}

/* ------- where the scene lies ------- */

void dp_scene_settle(dp_scene *s) {
    dp_wide wide = {0};
    bool enough = true;
    size_t number = 0;
    for (uint32_t i = 0; i < s->desc.instance_count; i++)
        for (uint32_t v = 0; v < batch_of(s, i)->vertex_count && enough && !wide.is_near; v++) {
            double p[3];
            dp_scene_vertex(s, &s->placed[i], v, p);
            const float rounded[3] = {(float)p[0], (float)p[1], (float)p[2]};
            enough = dp_wide_note(&wide, number++, p, rounded, &s->arena.memory);
        }
    dp_wide_settle(&wide, NULL, 0, s->batch.origin, &s->arena.memory);
}

/* How coarse a mesh's float32 positions become by its place. */
static double spacing_of(const dp_scene *s, uint32_t i, double farthest) {
    const uint32_t node = s->desc.instances[i].node;
    double scale = 1;
    if (node && !s->placed[i].is_skinned) {
        const dp_affine *const world = &s->worlds[node - 1];
        scale = 0;
        for (int r = 0; r < 3; r++)
            for (int c = 0; c < 3; c++) scale = dp_max(scale, fabs(world->row[r][c]));
    }
    return dp_max(dp_float_spacing(farthest), batch_of(s, i)->spacing) * scale;
}

void dp_scene_note_spacing(dp_scene *s, double *farthest) {
    for (uint32_t m = 0; m < s->desc.mesh_count; m++) {
        const dp_batch *const b = &s->desc.meshes[m].batch;
        double most = 0;
        for (size_t k = 0; k < 3 * b->vertex_count; k++)
            most = dp_max(most, fabs((double)b->positions[k]));
        farthest[m] = isfinite(most) ? most : 0;
    }
    for (uint32_t i = 0; i < s->desc.instance_count; i++)
        s->batch.spacing =
            dp_max(s->batch.spacing, spacing_of(s, i, farthest[s->desc.instances[i].mesh - 1]));
}
