/* drypoint/shapes.h: generated models with known features, as polygon sources. */
#ifndef DRYPOINT_SHAPES_H
#define DRYPOINT_SHAPES_H

#include <drypoint/source.h>

#ifdef __cplusplus
extern "C" {
#endif

/* One generated model. `name` is one of dp_shape_name(0 … dp_shape_count() - 1). */
typedef struct dp_shape {
    const char *name;
    uint64_t triangles; /* about; 0 means the shape's own default (plane shapes: the fewest) */
    double size;        /* extent, world units; 0 means 2 */
    uint32_t seed;      /* of shapes with noise (terrain) */
    const dp_allocator *allocator;
} dp_shape;

DP_API uint32_t dp_shape_count(void);
DP_API const char *dp_shape_name(uint32_t index);  /* "cube" */
DP_API const char *dp_shape_about(uint32_t index); /* "twelve ridges, …", one line */

/* Makes a source that generates each batch when it is read: memory does not grow with `triangles`.
 * The caller destroys *out. DP_ERR_ARGUMENT for an unknown name (the message names the nearest
 * known one), DP_ERR_MEMORY. */
DP_API dp_result dp_source_from_shape(const dp_shape *shape, dp_source **out, dp_diag *diag);

#ifdef __cplusplus
}
#endif
#endif
