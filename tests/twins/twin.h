/* Twins of a scene: other polygons, order, place or way to draw, the same to the eye. */
#ifndef DP_TEST_TWIN_H
#define DP_TEST_TWIN_H

#include "scene.h"

/* What is done to the polygons, in this order. */
enum {
    TWIN_CUT = 1,          /* some are cut in two, from edge to edge: T-junctions */
    TWIN_COLLINEAR = 2,    /* edges get corners in their middle */
    TWIN_FAN = 4,          /* triangles around one of their corners */
    TWIN_STAR = 8,         /* triangles around a point inside */
    TWIN_DOUBLE_ALL = 16,  /* each is there a second time, reversed */
    TWIN_DOUBLE_SOME = 32, /* some are */
    TWIN_REVERSE_ALL = 64, /* wound the other way */
    TWIN_REVERSE_SOME = 128,
    TWIN_SHUFFLE = 256 /* another order of parts and polygons, another first corner */
};

enum { TWIN_CORNERS = 256 }; /* a polygon has fewer than half of it before, fewer afterwards */

typedef struct twin_kind {
    const char *name;
    unsigned steps;
    soup_place place;
    bool streamed, table_off, adjacency; /* how it is drawn */
    bool
        exact_only; /* of most scenes float32 would move corners there: skipped without an origin */
} twin_kind;

extern const twin_kind twin_kinds[];
extern const size_t twin_kind_count;
/* NULL: there is none. */
const twin_kind *twin_kind_named(const char *name);

/* Fills *out, which must be empty. */
void twin_make(const scene *s, uint64_t seed, const twin_kind *kind, soup *out);

#endif
