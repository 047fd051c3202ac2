/* Collects the polygons of an indexed file, and makes a source of them. */
#ifndef DP_IO_BUILDER_H
#define DP_IO_BUILDER_H

#include "io/groups.h"
#include "mesh/wide.h"
#include <drypoint/source.h>

/* What corners carry besides a position. */
typedef struct dp_builder_attribute {
    float *values;     /* [count][3 or 2] */
    uint32_t *indices; /* [corners]; NULL while values have the vertices' numbers */
    size_t count, capacity, index_capacity;
    size_t indexed; /* corners that have an index */
} dp_builder_attribute;

typedef struct dp_builder {
    dp_allocator allocator;
    float *positions; /* [vertex_count][3] */
    size_t vertex_count, vertex_capacity;
    dp_wide wide;      /* of vertices that came in double precision */
    double origin[3];  /* of the positions; chosen by dp_builder_finish */
    double up[3];      /* what the file says is up; 0: nothing */
    double spacing;    /* world units: how far apart neighbouring values of the file lie, where they
                         were too coarse for float32 positions to tell; 0: no farther than those */
    uint32_t *indices; /* [corner_count] */
    size_t corner_count, corner_capacity;
    uint32_t *firsts; /* [polygon_count + 1]; NULL while all polygons are triangles */
    size_t first_capacity;
    uint16_t *groups; /* [polygon_count]; NULL while all polygons are in group 0 */
    size_t group_capacity;
    size_t polygon_count;
    size_t closed; /* corners of closed polygons; later ones are of the open polygon */
    dp_groups names;
    uint32_t *colors; /* [color_count] by group, 0xRRGGBBAA, 0: none */
    size_t color_count, color_capacity;
    uint32_t *vertex_colors; /* [vertex_color_count] dp_batch.colors, of the first vertices */
    size_t vertex_color_count, vertex_color_capacity;
    char color_remark[256];                  /* dp_source_color_remark, or "" */
    dp_builder_attribute normals, texcoords; /* 3 and 2 floats each */
} dp_builder;

void dp_builder_init(dp_builder *builder, const dp_allocator *allocator);
void dp_builder_destroy(dp_builder *builder);

/* Reserve room in advance. False when memory is out. */
bool dp_builder_expect_vertices(dp_builder *builder, size_t count);
bool dp_builder_expect_corners(dp_builder *builder, size_t count);

/* Used by the three functions below. */
bool dp_builder_grow_vertices(dp_builder *builder);
bool dp_builder_grow_corners(dp_builder *builder);
bool dp_builder_close_unusual(dp_builder *builder, uint16_t group);

/* Adds a vertex, whose x, y, z the caller writes. NULL on failure: dp_builder_fail. */
static inline float *dp_builder_vertex(dp_builder *builder) {
    if (builder->vertex_count == builder->vertex_capacity && !dp_builder_grow_vertices(builder))
        return NULL;
    return builder->positions + 3 * builder->vertex_count++;
}

/* Adds a vertex in double precision; `rounded` is the same as float32. False: dp_builder_fail. */
static inline bool dp_builder_place(dp_builder *builder, const double position[3],
                                    const float rounded[3]) {
    float *const to = dp_builder_vertex(builder);
    if (!to) return false;
    for (int k = 0; k < 3; k++) to[k] = rounded[k];
    return builder->wide.is_near || dp_wide_note(&builder->wide, builder->vertex_count - 1,
                                                 position, rounded, &builder->allocator);
}

/* Adds a corner to the open polygon. A vertex number that no uint32_t can hold becomes UINT32_MAX,
 * which is out of range, so that the polygon is dropped and counted. False: dp_builder_fail. */
static inline bool dp_builder_corner(dp_builder *builder, int64_t vertex) {
    if (builder->corner_count == builder->corner_capacity && !dp_builder_grow_corners(builder))
        return false;
    const bool fits = vertex >= 0 && vertex < UINT32_MAX;
    builder->indices[builder->corner_count++] = fits ? (uint32_t)vertex : UINT32_MAX;
    return true;
}

/* Closes the open polygon. False: dp_builder_fail. */
static inline bool dp_builder_close(dp_builder *builder, uint16_t group) {
    if (builder->firsts || builder->groups || group || builder->corner_count != builder->closed + 3)
        return dp_builder_close_unusual(builder, group);
    builder->polygon_count++;
    builder->closed += 3;
    return true;
}

/* Sets a group's colour, if it has none yet. False: dp_builder_fail. */
bool dp_builder_color(dp_builder *builder, uint16_t group, uint32_t rgba);

/* Sets a vertex's colour; vertices in ascending order. False: dp_builder_fail. */
bool dp_builder_vertex_color(dp_builder *builder, size_t vertex, uint32_t rgba);
/* Moves the last polygon to the group of that colour, whose name is the colour. False:
 * dp_builder_fail. */
bool dp_builder_polygon_color(dp_builder *builder, uint32_t rgba);
/* Remarks that the model's textures are not drawn, unless there is a remark already. */
#define DP_TEXTURES_REMARK "the model's textures are not drawn, only its other colours"
void dp_builder_note_textures(dp_builder *builder);

/* Adds a value of `width` floats, which the caller writes; NULL when memory is out. */
float *dp_builder_value(dp_builder *builder, dp_builder_attribute *attribute, size_t width);
/* The same, for the last vertex: earlier vertices without a value get zeros. */
float *dp_builder_vertex_value(dp_builder *builder, dp_builder_attribute *attribute, size_t width);
/* Sets the value number of the last corner; earlier corners without one have none. False:
 * dp_builder_fail. */
bool dp_builder_corner_value(dp_builder *builder, dp_builder_attribute *attribute, uint32_t number);

/* Reports why the last call returned NULL or false: DP_ERR_LIMIT or DP_ERR_MEMORY. */
dp_result dp_builder_fail(const dp_builder *builder, dp_diag *diag);

/* Makes a source of one stable batch, which owns the builder's arrays on success; the builder is
 * still to be destroyed. DP_ERR_FORMAT if there is no polygon, DP_ERR_MEMORY. */
dp_result dp_builder_finish(dp_builder *builder, dp_source **out, dp_diag *diag);

#endif
