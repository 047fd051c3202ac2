/* Vertex morphing: the vertices of one model on their way to those of another, of one topology. */
#include "base/diag.h"
#include "base/vec.h"
#include "mesh/batch.h"
#include "mesh/moved.h"

typedef struct morpher {
    dp_allocator memory;
    dp_morph given;
    double blend; /* at the time that is set */
    double time;  /* s */
} morpher;

static void blend_run(void *user, const dp_vertex_run *run, const dp_batch *other,
                      size_t first_of_batch) {
    const morpher *const m = user;
    const char *from = (const char *)run->positions;
    const char *to = (const char *)other->positions + first_of_batch * other->position_stride;
    double shift[3]; /* of the other's positions, to the first's origin */
    dp_batch_shift(other, run->origin, shift);
    for (size_t i = 0; i < run->count; i++, from += run->stride, to += other->position_stride) {
        const float *const a = (const float *)(const void *)from;
        const float *const b = (const float *)(const void *)to;
        for (int k = 0; k < 3; k++)
            run->moved[i][k] =
                (float)((1 - m->blend) * (double)a[k] + m->blend * ((double)b[k] + shift[k]));
    }
}

static void find_blend(morpher *m) {
    const dp_morph *const g = &m->given;
    m->blend = g->blend;
    if (g->seconds > 0) m->blend = dp_max(dp_min(g->blend + m->time / g->seconds, 1), 0);
}

static dp_result morph_set_time(void *user, double time, dp_diag *diag) {
    morpher *const m = user;
    (void)diag;
    m->time = time;
    find_blend(m);
    return DP_OK;
}

static double morph_duration(void *user) {
    const dp_morph *const g = &((const morpher *)user)->given;
    return g->seconds * dp_max(1 - dp_max(g->blend, 0), 0);
}

static void morph_destroy(void *user) {
    morpher *const m = user;
    const dp_allocator memory = m->memory;
    dp_free(&memory, m);
}

/* ------- are they of one topology? ------- */

static dp_result refuse(dp_diag *diag, const char *what, size_t a, size_t b) {
    return dp_fail(
        diag, DP_ERR_FORMAT,
        "two models can be blended only vertex by vertex: the first has %zu %s, the second "
        "%zu; export both from one mesh",
        a, what, b);
}

static uint32_t corner_vertex(const dp_batch *batch, size_t corner) {
    return batch->indices ? batch->indices[corner] : (uint32_t)corner;
}

static dp_result compare_corners(const dp_batch *a, const dp_batch *b, uint64_t polygons,
                                 dp_diag *diag) {
    for (size_t i = 0; i < a->polygon_count; i++) {
        const size_t first = a->firsts ? a->firsts[i] : 3 * i;
        const size_t last = a->firsts ? a->firsts[i + 1] : first + 3;
        const size_t other = b->firsts ? b->firsts[i] : 3 * i;
        bool same = (b->firsts ? b->firsts[i + 1] : other + 3) - other == last - first;
        for (size_t c = first; same && c < last; c++)
            same = corner_vertex(a, c) == corner_vertex(b, other + (c - first));
        if (!same)
            return dp_fail(
                diag, DP_ERR_FORMAT,
                "two models can be blended only vertex by vertex: the corners of polygon "
                "%llu are not the same vertices in both; export both from one mesh",
                (unsigned long long)(polygons + i + 1));
    }
    return DP_OK;
}

static dp_result compare_batches(const dp_batch *a, const dp_batch *b, uint64_t polygons,
                                 dp_diag *diag) {
    if (a->polygon_count != b->polygon_count)
        return refuse(diag, "polygons", (size_t)polygons + a->polygon_count,
                      (size_t)polygons + b->polygon_count);
    if (a->vertex_count != b->vertex_count)
        return refuse(diag, "vertices", a->vertex_count, b->vertex_count);
    return compare_corners(a, b, polygons, diag);
}

static dp_result compare(dp_source *a, dp_source *b, dp_diag *diag) {
    dp_batch of_a, of_b;
    uint64_t polygons = 0;
    do {
        dp_result result = dp_source_next(a, &of_a, diag);
        if (!result) result = dp_source_next(b, &of_b, diag);
        if (!result) result = compare_batches(&of_a, &of_b, polygons, diag);
        if (result) return result;
        polygons += of_a.polygon_count;
    } while (of_a.polygon_count);
    return DP_OK;
}

static dp_result rewind_both(dp_source *a, dp_source *b, dp_diag *diag) {
    const dp_result result = dp_source_rewind(a, diag);
    return result ? result : dp_source_rewind(b, diag);
}

/* ------- making ------- */

static dp_result check_morph(const dp_morph *morph, dp_diag *diag) {
    static const double most = 1000;
    if (!(fabs(morph->blend) <= most))
        return dp_fail(diag, DP_ERR_ARGUMENT, "a blend of %g; it must lie within %g of 0",
                       morph->blend, most);
    if (!(morph->seconds >= 0) || !isfinite(morph->seconds))
        return dp_fail(diag, DP_ERR_ARGUMENT,
                       "a morph of %g seconds; give a number from 0 on that is finite",
                       morph->seconds);
    return DP_OK;
}

dp_result dp_source_morph(dp_source *a, dp_source *b, const dp_morph *morph,
                          const dp_allocator *allocator, dp_source **out, dp_diag *diag) {
    static const dp_morph none = {0};
    if (!out) return dp_fail(diag, DP_ERR_ARGUMENT, "dp_source_morph: out is NULL");
    *out = NULL;
    if (!a || !b || a == b)
        return dp_fail(diag, DP_ERR_ARGUMENT, "dp_source_morph: a source is NULL, or both are one");
    dp_result result = check_morph(morph ? morph : &none, diag);
    if (!result) result = rewind_both(a, b, diag);
    if (!result) result = compare(a, b, diag);
    if (!result) result = rewind_both(a, b, diag);
    if (result) return result;
    const dp_allocator memory = dp_allocator_resolve(allocator);
    morpher *const m = dp_alloc_zeroed(&memory, sizeof *m);
    if (!m) return dp_fail(diag, DP_ERR_MEMORY, "out of memory for a morphed model");
    *m = (morpher){.memory = memory, .given = morph ? *morph : none};
    find_blend(m);
    const dp_moved_desc desc = {.inner = a,
                                .partner = b,
                                .move = blend_run,
                                .user = m,
                                .set_time = morph_set_time,
                                .duration = morph_duration,
                                .destroy = morph_destroy};
    result = dp_source_moved(&desc, &memory, out, diag);
    if (result) morph_destroy(m);
    return result;
}

dp_result dp_morph_set(dp_source *source, const dp_morph *morph, dp_diag *diag) {
    morpher *const m = dp_moved_user(source, blend_run);
    if (!m || !morph)
        return dp_fail(
            diag, DP_ERR_ARGUMENT,
            "dp_morph_set: the source was not made by dp_source_morph, or morph is NULL");
    const dp_result result = check_morph(morph, diag);
    if (result) return result;
    m->given = *morph;
    find_blend(m);
    return DP_OK;
}
