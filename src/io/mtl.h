/* Wavefront material libraries (.mtl): the colours of an OBJ's materials. */
#ifndef DP_IO_MTL_H
#define DP_IO_MTL_H

#include "io/groups.h"
#include "io/stream.h"

/* Materials by name, defined or only used. */
typedef struct dp_materials {
    dp_groups names;
    uint32_t *colors; /* by number, 0xRRGGBBAA, 0: none */
    size_t color_count, color_capacity;
    bool textured; /* some have textures */
} dp_materials;

enum { DP_MATERIAL_NAME = 256 }; /* bytes of a name that count, with the 0 behind it */

void dp_materials_init(dp_materials *materials, const dp_allocator *allocator);
void dp_materials_destroy(dp_materials *materials);
/* The number of a name, a new one if it is new. False when memory is out. */
bool dp_materials_find(dp_materials *materials, const char *name, uint16_t *number);
uint32_t dp_materials_color(const dp_materials *materials, uint16_t number);

/* Reads a library to its end; ignores what is not needed. False when memory is out. */
bool dp_read_mtl(dp_stream *stream, dp_materials *materials);

/* Reads the libraries that a `mtllib` line of `model` names (beside.h): one name with spaces, or
 * several names. The first one that cannot be read leaves a sentence in `remark`, unless the model
 * can have no other files. False when memory is out. */
bool dp_open_mtl(const dp_stream *model, const char *names, dp_materials *materials, char *remark,
                 size_t size);

#endif
