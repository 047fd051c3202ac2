/* Polygons without order: what scenes and their twins are made of, in double precision. Running out
 * of memory aborts: this is for tests. */
#ifndef DP_TEST_SOUP_H
#define DP_TEST_SOUP_H

#include "accuracy/vec.h"

#include <drypoint/drypoint.h>

typedef struct soup_polygon {
    uint32_t first, count; /* of points */
    uint32_t part;
} soup_polygon;

typedef struct soup {
    v3 *points;
    soup_polygon *polygons;
    size_t point_count, point_room, polygon_count, polygon_room;
} soup;

void soup_add(soup *s, const v3 *points, uint32_t count, uint32_t part);
void soup_free(soup *s);

/* Small reproducible random numbers, by splitmix64. */
typedef struct dice {
    uint64_t state;
} dice;
uint64_t dice_next(dice *d);
uint32_t dice_below(dice *d, uint32_t count);            /* [0, count) */
double dice_between(dice *d, double least, double most); /* [least, most) */
bool dice_chance(dice *d, double share);

/* Which corners of equal position are one vertex. */
typedef enum soup_sharing {
    SOUP_BY_PART = 0, /* those of one part */
    SOUP_NONE,        /* none */
    SOUP_ALL          /* all, also those that are equal up to rounding */
} soup_sharing;

/* Where a soup lies when it is drawn: p * scale + offset. */
typedef struct soup_place {
    double scale;
    v3 offset;
    soup_sharing sharing;
    bool origin; /* the offset is handed over in double, beside positions without it */
} soup_place;

/* Can batches say where their origin is? */
#if DP_TEST_HAS_ORIGIN
enum { SOUP_HAS_ORIGIN = 1 };
#else
enum { SOUP_HAS_ORIGIN = 0 };
#endif

/* As the library takes it. */
typedef struct soup_arrays {
    float *positions;
    uint32_t *indices, *firsts;
    dp_batch batch;
} soup_arrays;

void soup_arrays_make(const soup *s, const soup_place *place, soup_arrays *arrays);
void soup_arrays_free(soup_arrays *arrays);
/* False: the file cannot be written. */
bool soup_arrays_write(const soup_arrays *arrays, const soup_place *place, const char *path);

#endif
