/* Rays and boxes against triangles: a bounding volume hierarchy in double precision. */
#ifndef DP_TEST_RAYS_H
#define DP_TEST_RAYS_H

#include "vec.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define RAYS_NOBODY UINT32_MAX

typedef struct rays_triangle {
    v3 corner[3];
    uint32_t owner; /* the polygon it is a part of */
} rays_triangle;

typedef struct rays rays;

/* Copies the triangles. Running out of memory aborts. */
rays *rays_create(const rays_triangle *triangles, size_t count);
void rays_destroy(rays *set);

/* Distance along a unit direction to the first triangle met in (near, far), or INFINITY. The
 * triangles of two owners do not count. Either side of a triangle stops a ray. */
double rays_nearest(const rays *set, v3 from, v3 direction, double near, double far, uint32_t skip0,
                    uint32_t skip1);
/* The same, content with any triangle. */
bool rays_blocked(const rays *set, v3 from, v3 direction, double near, double far, uint32_t skip0,
                  uint32_t skip1);

/* Visits every triangle whose box meets the box. False from visit stops. */
void rays_overlaps(const rays *set, v3 min, v3 max,
                   bool (*visit)(void *user, const rays_triangle *triangle), void *user);

#endif
