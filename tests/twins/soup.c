/* Polygons without order, and how they come into the library's arrays. */
#include "soup.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void *grown(void *block, size_t *room, size_t need, size_t size) {
    if (need <= *room) return block;
    *room = need > 2 * *room ? need + 64 : 2 * *room;
    block = realloc(block, *room * size);
    if (block == NULL) abort();
    return block;
}

void soup_add(soup *s, const v3 *points, uint32_t count, uint32_t part) {
    s->points = grown(s->points, &s->point_room, s->point_count + count, sizeof *s->points);
    s->polygons = grown(s->polygons, &s->polygon_room, s->polygon_count + 1, sizeof *s->polygons);
    s->polygons[s->polygon_count++] =
        (soup_polygon){.first = (uint32_t)s->point_count, .count = count, .part = part};
    memcpy(s->points + s->point_count, points, count * sizeof *points);
    s->point_count += count;
}

void soup_free(soup *s) {
    free(s->points);
    free(s->polygons);
    *s = (soup){0};
}

uint64_t dice_next(dice *d) {
    uint64_t z = d->state += UINT64_C(0x9E3779B97F4A7C15);
    z = (z ^ z >> 30) * UINT64_C(0xBF58476D1CE4E5B9);
    z = (z ^ z >> 27) * UINT64_C(0x94D049BB133111EB);
    return z ^ z >> 31;
}

uint32_t dice_below(dice *d, uint32_t count) { return (uint32_t)((dice_next(d) >> 32) % count); }

double dice_between(dice *d, double least, double most) {
    return least + (most - least) * (double)(dice_next(d) >> 11) * 0x1p-53;
}

bool dice_chance(dice *d, double share) { return dice_between(d, 0, 1) < share; }

/* The same vertex, as far as `sharing` goes? */
static bool same_point(v3 a, v3 b, soup_sharing sharing) {
    const double slack = sharing == SOUP_ALL ? 1e-9 : 0;
    return fabs(a.x - b.x) <= slack && fabs(a.y - b.y) <= slack && fabs(a.z - b.z) <= slack;
}

/* vertices[] are point numbers; returns the place of the one that point p, of `part`, is. */
static uint32_t vertex_of(const soup *s, const uint32_t *parts, uint32_t *vertices, size_t *count,
                          uint32_t p, soup_sharing sharing) {
    for (size_t i = 0; i < *count && sharing != SOUP_NONE; i++) {
        const uint32_t q = vertices[i];
        if (sharing == SOUP_BY_PART && parts[q] != parts[p]) continue;
        if (same_point(s->points[p], s->points[q], sharing)) return (uint32_t)i;
    }
    vertices[*count] = p;
    return (uint32_t)(*count)++;
}

static void place_point(float *out, v3 p, const soup_place *place) {
    const v3 offset = place->origin ? (v3){0, 0, 0} : place->offset;
    const v3 at = v3_add(v3_mul(p, place->scale), offset);
    out[0] = (float)at.x, out[1] = (float)at.y, out[2] = (float)at.z;
}

void soup_arrays_make(const soup *s, const soup_place *place, soup_arrays *arrays) {
    uint32_t *parts = calloc(s->point_count + 1, sizeof *parts);
    uint32_t *vertices = calloc(s->point_count + 1, sizeof *vertices);
    size_t vertex_count = 0, corner = 0;
    *arrays = (soup_arrays){.positions = calloc(3 * s->point_count + 3, sizeof(float)),
                            .indices = calloc(s->point_count + 1, sizeof(uint32_t)),
                            .firsts = calloc(s->polygon_count + 1, sizeof(uint32_t))};
    if (parts == NULL || vertices == NULL || arrays->positions == NULL || arrays->indices == NULL ||
        arrays->firsts == NULL)
        abort();
    for (size_t i = 0; i < s->polygon_count; i++) {
        const soup_polygon *const polygon = &s->polygons[i];
        arrays->firsts[i] = (uint32_t)corner;
        for (uint32_t k = 0; k < polygon->count; k++) {
            const uint32_t p = polygon->first + k;
            parts[p] = polygon->part;
            arrays->indices[corner++] =
                vertex_of(s, parts, vertices, &vertex_count, p, place->sharing);
        }
    }
    arrays->firsts[s->polygon_count] = (uint32_t)corner;
    for (size_t i = 0; i < vertex_count; i++)
        place_point(arrays->positions + 3 * i, s->points[vertices[i]], place);
    free(parts);
    free(vertices);
    arrays->batch = (dp_batch){.positions = arrays->positions,
                               .vertex_count = vertex_count,
                               .indices = arrays->indices,
                               .corner_count = corner,
                               .firsts = arrays->firsts,
                               .polygon_count = s->polygon_count,
                               .stable = true};
#if DP_TEST_HAS_ORIGIN
    if (place->origin) {
        arrays->batch.origin[0] = place->offset.x;
        arrays->batch.origin[1] = place->offset.y;
        arrays->batch.origin[2] = place->offset.z;
    }
#endif
}

void soup_arrays_free(soup_arrays *arrays) {
    free(arrays->positions);
    free(arrays->indices);
    free(arrays->firsts);
    *arrays = (soup_arrays){0};
}

bool soup_arrays_write(const soup_arrays *arrays, const soup_place *place, const char *path) {
    const v3 origin = place->origin ? place->offset : (v3){0, 0, 0};
    FILE *const file = fopen(path, "w");
    if (file == NULL) return false;
    for (size_t i = 0; i < arrays->batch.vertex_count; i++) {
        const float *const p = arrays->positions + 3 * i;
        fprintf(file, "v %.17g %.17g %.17g\n", (double)p[0] + origin.x, (double)p[1] + origin.y,
                (double)p[2] + origin.z);
    }
    for (size_t i = 0; i < arrays->batch.polygon_count; i++) {
        fputs("f", file);
        for (uint32_t c = arrays->firsts[i]; c < arrays->firsts[i + 1]; c++)
            fprintf(file, " %u", arrays->indices[c] + 1);
        fputs("\n", file);
    }
    return fclose(file) == 0;
}
