/* The header of a PLY file: the layout of the rest. */
#ifndef DP_IO_PLY_H
#define DP_IO_PLY_H

#include "base/memory.h"
#include "io/stream.h"

typedef enum dp_ply_encoding { DP_PLY_ASCII, DP_PLY_LITTLE, DP_PLY_BIG } dp_ply_encoding;

typedef enum dp_ply_type {
    DP_PLY_INT8,
    DP_PLY_UINT8,
    DP_PLY_INT16,
    DP_PLY_UINT16,
    DP_PLY_INT32,
    DP_PLY_UINT32,
    DP_PLY_FLOAT32,
    DP_PLY_FLOAT64
} dp_ply_type;

typedef enum dp_ply_role {
    DP_PLY_SKIP, /* nothing that we need */
    DP_PLY_X,
    DP_PLY_Y,
    DP_PLY_Z,
    DP_PLY_NX,
    DP_PLY_NY,
    DP_PLY_NZ,
    DP_PLY_S, /* texture coordinates: s, t; u, v; texture_u, texture_v */
    DP_PLY_T,
    DP_PLY_RED,
    DP_PLY_GREEN,
    DP_PLY_BLUE,
    DP_PLY_POLYGON, /* a list of vertex numbers */
    DP_PLY_STRIP    /* a list of vertex numbers, strips with -1 between them */
} dp_ply_role;

typedef enum dp_ply_kind { DP_PLY_OTHER, DP_PLY_VERTEX, DP_PLY_FACE, DP_PLY_TRISTRIPS } dp_ply_kind;

typedef struct dp_ply_property {
    dp_ply_role role;
    dp_ply_type type;  /* of the value, or of a list's items */
    dp_ply_type count; /* of a list's length */
    bool list;
} dp_ply_property;

typedef struct dp_ply_element {
    dp_ply_kind kind;
    uint64_t count;           /* as announced: not to be trusted */
    size_t first, properties; /* in dp_ply_header.properties */
    unsigned roles;           /* set of the properties' roles, 1u << role */
} dp_ply_element;

typedef struct dp_ply_header {
    dp_allocator allocator;
    dp_ply_encoding encoding;
    dp_ply_element *elements;
    size_t element_count, element_capacity;
    dp_ply_property *properties;
    size_t property_count, property_capacity;
    bool textured; /* a comment names a picture */
} dp_ply_header;

/* Reads the header, up to the first byte after it. The caller destroys `header` in any case. */
dp_result dp_ply_read_header(dp_stream *stream, dp_ply_header *header, dp_diag *diag);
void dp_ply_destroy_header(dp_ply_header *header);

/* "vertex", "face", … for messages. */
const char *dp_ply_kind_name(dp_ply_kind kind);

#endif
