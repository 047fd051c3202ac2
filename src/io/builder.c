/* An indexed mesh that grows as a file is read, and the source made of it.
 *
 * Invariant: firsts and groups exist from the first polygon that needs them, and then for all;
 * closed <= corner_count is where the open polygon begins. Arrays are shrunk to size at the end.
 *
 * Not handled: bad indices and coordinates (binning drops and counts such polygons); more than
 * 2^32 - 1 vertices or corners. */
#include "io/builder.h"

#include "base/diag.h"
#include "mesh/source.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

void dp_builder_init(dp_builder *builder, const dp_allocator *allocator) {
    *builder = (dp_builder){.allocator = *allocator, .names = {.allocator = *allocator}};
}

void dp_builder_destroy(dp_builder *builder) {
    dp_free(&builder->allocator, builder->positions);
    dp_wide_free(&builder->wide, &builder->allocator);
    dp_free(&builder->allocator, builder->indices);
    dp_free(&builder->allocator, builder->firsts);
    dp_free(&builder->allocator, builder->groups);
    dp_free(&builder->allocator, builder->colors);
    dp_free(&builder->allocator, builder->vertex_colors);
    dp_free(&builder->allocator, builder->normals.values);
    dp_free(&builder->allocator, builder->normals.indices);
    dp_free(&builder->allocator, builder->texcoords.values);
    dp_free(&builder->allocator, builder->texcoords.indices);
    dp_groups_destroy(&builder->names);
}

bool dp_builder_expect_vertices(dp_builder *builder, size_t count) {
    return dp_reserve(&builder->allocator, &builder->positions, &builder->vertex_capacity, count,
                      3 * sizeof(float));
}

bool dp_builder_expect_corners(dp_builder *builder, size_t count) {
    return dp_reserve(&builder->allocator, &builder->indices, &builder->corner_capacity, count,
                      sizeof(uint32_t));
}

bool dp_builder_grow_vertices(dp_builder *builder) {
    return builder->vertex_count < UINT32_MAX &&
           dp_builder_expect_vertices(builder, builder->vertex_count + 1);
}

bool dp_builder_grow_corners(dp_builder *builder) {
    return builder->corner_count < UINT32_MAX &&
           dp_builder_expect_corners(builder, builder->corner_count + 1);
}

/* Makes firsts for the polygons so far, which are triangles. */
static bool start_firsts(dp_builder *builder) {
    if (!dp_reserve(&builder->allocator, &builder->firsts, &builder->first_capacity,
                    builder->polygon_count + 2, sizeof *builder->firsts))
        return false;
    for (size_t i = 0; i <= builder->polygon_count; i++) builder->firsts[i] = (uint32_t)(3 * i);
    return true;
}

static bool start_groups(dp_builder *builder) {
    if (!dp_reserve(&builder->allocator, &builder->groups, &builder->group_capacity,
                    builder->polygon_count + 1, sizeof *builder->groups))
        return false;
    memset(builder->groups, 0, builder->polygon_count * sizeof *builder->groups);
    return true;
}

bool dp_builder_close_unusual(dp_builder *builder, uint16_t group) {
    if (!builder->firsts && builder->corner_count != builder->closed + 3 && !start_firsts(builder))
        return false;
    if (!builder->groups && group && !start_groups(builder)) return false;
    const size_t polygon = builder->polygon_count;
    if (builder->firsts) {
        if (!dp_reserve(&builder->allocator, &builder->firsts, &builder->first_capacity,
                        polygon + 2, sizeof *builder->firsts))
            return false;
        builder->firsts[polygon + 1] = (uint32_t)builder->corner_count;
    }
    if (builder->groups) {
        if (!dp_reserve(&builder->allocator, &builder->groups, &builder->group_capacity,
                        polygon + 1, sizeof *builder->groups))
            return false;
        builder->groups[polygon] = group;
    }
    builder->polygon_count++;
    builder->closed = builder->corner_count;
    return true;
}

bool dp_builder_color(dp_builder *builder, uint16_t group, uint32_t rgba) {
    if (!dp_reserve(&builder->allocator, &builder->colors, &builder->color_capacity,
                    (size_t)group + 1, sizeof *builder->colors))
        return false;
    while (builder->color_count <= group) builder->colors[builder->color_count++] = 0;
    if (!builder->colors[group]) builder->colors[group] = rgba;
    return true;
}

/* Gives the first `count` vertices colours, those without one 0. */
static bool fill_vertex_colors(dp_builder *builder, size_t count) {
    if (!dp_reserve(&builder->allocator, &builder->vertex_colors, &builder->vertex_color_capacity,
                    count, sizeof *builder->vertex_colors))
        return false;
    while (builder->vertex_color_count < count)
        builder->vertex_colors[builder->vertex_color_count++] = 0;
    return true;
}

bool dp_builder_vertex_color(dp_builder *builder, size_t vertex, uint32_t rgba) {
    if (!fill_vertex_colors(builder, vertex + 1)) return false;
    builder->vertex_colors[vertex] = rgba;
    return true;
}

/* Groups are numbered in 16 bits: when most numbers are taken, colours are rounded to four bits per
 * channel, which are 4096. */
static uint32_t round_color(const dp_builder *builder, uint32_t rgba) {
    if (builder->names.count < DP_GROUPS_MOST - 5000) return rgba;
    return (rgba & 0xF0F0F000) | (rgba & 0xF0F0F000) >> 4 | 255;
}

bool dp_builder_polygon_color(dp_builder *builder, uint32_t rgba) {
    char name[16];
    uint16_t group;
    rgba = round_color(builder, rgba);
    snprintf(name, sizeof name, "#%06" PRIX32, rgba >> 8);
    /* Group 0 is for polygons without a colour. */
    if ((!builder->names.count && !dp_groups_find(&builder->names, "", &group)) ||
        !dp_groups_find(&builder->names, name, &group) ||
        (!builder->groups && group && !start_groups(builder)))
        return false;
    if (builder->groups) builder->groups[builder->polygon_count - 1] = group;
    return dp_builder_color(builder, group, rgba);
}

void dp_builder_note_textures(dp_builder *builder) {
    if (!*builder->color_remark)
        snprintf(builder->color_remark, sizeof builder->color_remark, "%s", DP_TEXTURES_REMARK);
}

float *dp_builder_value(dp_builder *builder, dp_builder_attribute *a, size_t width) {
    if (a->count + 1 >= UINT32_MAX || !dp_reserve(&builder->allocator, &a->values, &a->capacity,
                                                  a->count + 1, width * sizeof(float)))
        return NULL;
    return a->values + width * a->count++;
}

float *dp_builder_vertex_value(dp_builder *builder, dp_builder_attribute *a, size_t width) {
    if (!dp_reserve(&builder->allocator, &a->values, &a->capacity, builder->vertex_count,
                    width * sizeof(float)))
        return NULL;
    const size_t last = builder->vertex_count - 1;
    memset(a->values + width * a->count, 0, (last - a->count) * width * sizeof(float));
    a->count = builder->vertex_count;
    return a->values + width * last;
}

/* Fills indices of all corners up to `count`. */
static bool fill_indices(dp_builder *builder, dp_builder_attribute *a, size_t count) {
    if (!dp_reserve(&builder->allocator, &a->indices, &a->index_capacity, count,
                    sizeof *a->indices))
        return false;
    for (; a->indexed < count; a->indexed++) a->indices[a->indexed] = UINT32_MAX;
    return true;
}

bool dp_builder_corner_value(dp_builder *builder, dp_builder_attribute *a, uint32_t number) {
    if (!fill_indices(builder, a, builder->corner_count)) return false;
    a->indices[builder->corner_count - 1] = number;
    return true;
}

dp_result dp_builder_fail(const dp_builder *builder, dp_diag *diag) {
    if (builder->vertex_count >= UINT32_MAX || builder->corner_count >= UINT32_MAX)
        return dp_fail(
            diag, DP_ERR_LIMIT,
            "more than 4294967295 vertices or corners: split the model into several files");
    return dp_fail(diag, DP_ERR_MEMORY, "out of memory after %zu vertices and %zu polygons",
                   builder->vertex_count, builder->polygon_count);
}

static dp_attribute attribute_of(const dp_builder_attribute *a) {
    return (dp_attribute){
        .values = a->count ? a->values : NULL, .count = a->count, .indices = a->indices};
}

/* The source. */
typedef struct mesh {
    dp_builder built;
    bool done;
} mesh;

static dp_result mesh_next(void *user, dp_batch *batch, dp_diag *diag) {
    mesh *const self = user;
    const dp_builder *const built = &self->built;
    (void)diag;
    if (self->done) return DP_OK;
    self->done = true;
    *batch = (dp_batch){.positions = built->positions,
                        .vertex_count = built->vertex_count,
                        .indices = built->indices,
                        .corner_count = built->closed,
                        .firsts = built->firsts,
                        .polygon_count = built->polygon_count,
                        .groups = built->groups,
                        .normals = attribute_of(&built->normals),
                        .texcoords = attribute_of(&built->texcoords),
                        .colors = built->vertex_colors,
                        .stable = true,
                        .spacing = built->spacing};
    memcpy(batch->origin, built->origin, sizeof batch->origin);
    return DP_OK;
}

static dp_result mesh_rewind(void *user, dp_diag *diag) {
    (void)diag;
    ((mesh *)user)->done = false;
    return DP_OK;
}

static const char *mesh_group_name(void *user, uint32_t group) {
    return dp_groups_name(&((mesh *)user)->built.names, group);
}

static uint32_t mesh_group_color(void *user, uint32_t group) {
    const dp_builder *const built = &((mesh *)user)->built;
    return group < built->color_count ? built->colors[group] : 0;
}

static const char *mesh_color_remark(void *user) {
    const dp_builder *const built = &((mesh *)user)->built;
    return *built->color_remark ? built->color_remark : NULL;
}

static void mesh_destroy(void *user) {
    mesh *const self = user;
    const dp_allocator memory = self->built.allocator;
    dp_builder_destroy(&self->built);
    dp_free(&memory, self);
}

/* Shrinks a block to its size; if that fails, the larger block stays. */
static void shrink(const dp_allocator *allocator, void *block_address, size_t capacity,
                   size_t count, size_t item_size) {
    if (!count || count == capacity) return;
    void *block;
    memcpy(&block, block_address, sizeof block);
    block = allocator->realloc(block, count * item_size, allocator->user);
    if (block) memcpy(block_address, &block, sizeof block);
}

static void shrink_all(dp_builder *b) {
    shrink(&b->allocator, &b->positions, b->vertex_capacity, b->vertex_count, 3 * sizeof(float));
    shrink(&b->allocator, &b->indices, b->corner_capacity, b->corner_count, sizeof *b->indices);
    if (b->firsts)
        shrink(&b->allocator, &b->firsts, b->first_capacity, b->polygon_count + 1,
               sizeof *b->firsts);
    if (b->groups)
        shrink(&b->allocator, &b->groups, b->group_capacity, b->polygon_count, sizeof *b->groups);
}

dp_result dp_builder_finish(dp_builder *builder, dp_source **out, dp_diag *diag) {
    if (!builder->polygon_count)
        return dp_fail(diag, DP_ERR_FORMAT,
                       "%s: there is nothing to draw, export the model with its faces",
                       builder->vertex_count ? "points but no polygons" : "no polygons");
    /* Without vertices all polygons are dropped later, but a batch needs an array. */
    if (!builder->positions && !dp_builder_expect_vertices(builder, 1))
        return dp_builder_fail(builder, diag);
    if ((builder->normals.indices &&
         !fill_indices(builder, &builder->normals, builder->corner_count)) ||
        (builder->texcoords.indices &&
         !fill_indices(builder, &builder->texcoords, builder->corner_count)) ||
        (builder->vertex_colors && !fill_vertex_colors(builder, builder->vertex_count)))
        return dp_builder_fail(builder, diag);
    mesh *const self = dp_alloc(&builder->allocator, sizeof *self);
    if (!self) return dp_builder_fail(builder, diag);
    shrink_all(builder);
    dp_wide_settle(&builder->wide, builder->positions, builder->vertex_count, builder->origin,
                   &builder->allocator);
    *self = (mesh){.built = *builder};
    const dp_source_callbacks callbacks = {.user = self,
                                           .next = mesh_next,
                                           .rewind = mesh_rewind,
                                           .destroy = mesh_destroy,
                                           .group_name = mesh_group_name,
                                           .group_color = mesh_group_color,
                                           .color_remark = mesh_color_remark,
                                           .up = {builder->up[0], builder->up[1], builder->up[2]}};
    const dp_result result = dp_source_from_callbacks(&callbacks, &builder->allocator, out, diag);
    if (result)
        dp_free(&builder->allocator, self);
    else {
        (*out)->constant = true;
        dp_builder_init(builder, &self->built.allocator);
    }
    return result;
}
