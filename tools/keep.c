/* Reads a source whole into arrays, so that it can be read again: a pipe of STL can be read only
 * once, but fitting a camera and drawing take two readings.
 *
 * Invariant: `batch` describes all polygons so far; arrays grow by at least half. There are edge
 * flags only once a batch has some; earlier corners then count as flagged. Triangles alone are handed
 * out as such, so that the drawing is the file's, to the byte. */
#include "keep.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct kept {
    float (*positions)[3];
    uint32_t *indices, *firsts;
    uint8_t *flags;
    size_t positions_room, indices_room, firsts_room, flags_room;
    size_t vertices, corners, polygons;
    double origin[3]; /* of the first batch */
    double spacing;
    bool flagged, faceted, handed_out; /* faceted: not all are triangles */
    char remark[160];                  /* of the source, or "" */
} kept;

static bool reserve(void *block_address, size_t *room, size_t need, size_t size) {
    if (need <= *room) return true;
    const size_t grown = need + need / 2;
    void *block;
    memcpy(&block, block_address, sizeof block);
    block = realloc(block, grown * size);
    if (!block) return false;
    memcpy(block_address, &block, sizeof block);
    *room = grown;
    return true;
}

static bool make_room(kept *k, const dp_batch *b) {
    const size_t corners = k->corners + b->corner_count;
    return reserve(&k->positions, &k->positions_room, k->vertices + b->vertex_count,
                   sizeof *k->positions) &&
           reserve(&k->indices, &k->indices_room, corners, sizeof *k->indices) &&
           reserve(&k->flags, &k->flags_room, corners, sizeof *k->flags) &&
           reserve(&k->firsts, &k->firsts_room, k->polygons + b->polygon_count + 1,
                   sizeof *k->firsts);
}

static bool add(kept *k, const dp_batch *b) {
    if (!make_room(k, b)) return false;
    if (!k->polygons) memcpy(k->origin, b->origin, sizeof k->origin);
    if (b->spacing > k->spacing) k->spacing = b->spacing;
    for (size_t v = 0; v < b->vertex_count; v++) {
        float *const p = k->positions[k->vertices + v];
        memcpy(p, (const char *)b->positions + v * b->position_stride, sizeof *k->positions);
        for (int i = 0; i < 3; i++)
            if (b->origin[i] != k->origin[i])
                p[i] = (float)((double)p[i] + (b->origin[i] - k->origin[i]));
    }
    for (size_t c = 0; c < b->corner_count; c++) {
        const uint32_t v = b->indices ? b->indices[c] : (uint32_t)c;
        const bool there = v < b->vertex_count; /* a bad index must stay bad */
        k->indices[k->corners + c] = there ? (uint32_t)(k->vertices + v) : UINT32_MAX;
        k->flags[k->corners + c] = b->edge_flags ? b->edge_flags[c] : 1;
    }
    for (size_t i = 0; i <= b->polygon_count; i++)
        k->firsts[k->polygons + i] = (uint32_t)(k->corners + (b->firsts ? b->firsts[i] : 3 * i));
    for (size_t i = 0; i < b->polygon_count && b->firsts; i++)
        k->faceted |= b->firsts[i + 1] - b->firsts[i] != 3;
    k->flagged |= b->edge_flags != NULL;
    k->vertices += b->vertex_count;
    k->corners += b->corner_count;
    k->polygons += b->polygon_count;
    return true;
}

/* ---- as a source ---- */

static dp_result kept_next(void *user, dp_batch *batch, dp_diag *diag) {
    kept *const k = user;
    (void)diag;
    if (!k->handed_out)
        *batch = (dp_batch){.positions = (const float *)k->positions,
                            .vertex_count = k->vertices,
                            .indices = k->indices,
                            .corner_count = k->corners,
                            .firsts = k->faceted ? k->firsts : NULL,
                            .polygon_count = k->polygons,
                            .edge_flags = k->flagged ? k->flags : NULL,
                            .stable = true,
                            .origin = {k->origin[0], k->origin[1], k->origin[2]},
                            .spacing = k->spacing};
    k->handed_out = true;
    return DP_OK;
}

static dp_result kept_rewind(void *user, dp_diag *diag) {
    (void)diag;
    ((kept *)user)->handed_out = false;
    return DP_OK;
}

static void kept_destroy(void *user) {
    kept *const k = user;
    free(k->positions);
    free(k->indices);
    free(k->firsts);
    free(k->flags);
    free(k);
}

static const char *kept_remark(void *user) {
    const kept *const k = user;
    return *k->remark ? k->remark : NULL;
}

/* ---- reading ---- */

static dp_result refuse(dp_diag *diag, dp_result result, const char *message) {
    *diag = (dp_diag){.result = result};
    snprintf(diag->message, sizeof diag->message, "%s", message);
    return result;
}

static double bytes_of(const kept *k) {
    return (double)(k->vertices * sizeof *k->positions + k->corners * (sizeof *k->indices + 1) +
                    k->polygons * sizeof *k->firsts);
}

static dp_result read_all(kept *k, dp_source *source, double most, dp_diag *diag) {
    for (;;) {
        dp_batch batch;
        const dp_result result = dp_source_next(source, &batch, diag);
        if (result || !batch.polygon_count) return result;
        if (k->corners + batch.corner_count >= UINT32_MAX ||
            k->vertices + batch.vertex_count >= UINT32_MAX)
            return refuse(diag, DP_ERR_LIMIT,
                          "too large to be kept; give a file instead of a pipe");
        if (bytes_of(k) > most)
            return refuse(diag, DP_ERR_LIMIT,
                          "takes more memory than --memory says; give a file instead of a pipe, or "
                          "read it once, "
                          "with --passes 1, --eye and --target");
        if (!add(k, &batch))
            return refuse(diag, DP_ERR_MEMORY, "out of memory; give a file instead of a pipe");
    }
}

dp_result copy_source(dp_source *source, double most, dp_source **out, dp_diag *diag) {
    kept *const k = calloc(1, sizeof *k);
    if (!k) return refuse(diag, DP_ERR_MEMORY, "out of memory; give a file instead of a pipe");
    dp_source_callbacks callbacks = {.user = k,
                                     .next = kept_next,
                                     .rewind = kept_rewind,
                                     .destroy = kept_destroy,
                                     .remark = kept_remark};
    callbacks.up_assumed = !dp_source_up(source, callbacks.up);
    dp_result result = read_all(k, source, most, diag);
    const char *const remark = dp_source_remark(source);
    if (remark) snprintf(k->remark, sizeof k->remark, "%s", remark);
    if (!result) result = dp_source_from_callbacks(&callbacks, NULL, out, diag);
    if (result) kept_destroy(k);
    return result;
}

dp_result keep_source(dp_source **source, double most, dp_diag *diag) {
    dp_source *made = NULL;
    const dp_result result = copy_source(*source, most, &made, diag);
    if (result) return result;
    dp_source_destroy(*source);
    *source = made;
    return DP_OK;
}
