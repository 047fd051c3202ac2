/* Generated models by name: finds the builder, then by bisection the fineness that comes nearest to
 * the number of triangles asked for, and makes a source of the sheets.
 *
 * Invariant: a builder's number of triangles grows with `fine`. */
#include <drypoint/shapes.h>

#include "base/diag.h"
#include "mesh/models.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct entry {
    const char *name;
    const char *about;
    dp_builder *build;
    uint32_t fine; /* default, if no number of triangles is given */
} entry;

static const entry entries[] = {
    {"cube", "twelve ridges of 90 degrees", dp_build_cube, 1},
    {"tetrahedron", "four faces, six ridges of 70.5 degrees", dp_build_tetrahedron, 1},
    {"sphere", "nothing but a silhouette; a subdivided icosahedron", dp_build_sphere, 16},
    {"torus", "silhouettes that end in cusps, no creases", dp_build_torus, 40},
    {"cylinder", "two round ridges and straight silhouettes", dp_build_cylinder, 16},
    {"gear", "a toothed wheel with hub, web and six holes: ridges and valleys", dp_build_gear, 2},
    {"bolt", "a hexagonal head, a shank and a real helical thread", dp_build_bolt, 8},
    {"bracket", "a bearing bracket with a fillet and three holes", dp_build_bracket, 16},
    {"stairs", "ten steps: ridges and valleys in turn, all of 90 degrees", dp_build_stairs, 1},
    {"boxes", "two boxes that cross without sharing a vertex: intersections", dp_build_boxes, 1},
    {"flag", "a cloth on its pole, to be waved", dp_build_flag, 32},
    {"torso", "a smooth body from hip to neck, to breathe", dp_build_torso, 24},
    {"terrain", "an open sheet of hills with a border; the seed changes it", dp_build_terrain, 256},
};
enum { ENTRIES = sizeof entries / sizeof *entries };

uint32_t dp_shape_count(void) { return ENTRIES; }

const char *dp_shape_name(uint32_t index) { return index < ENTRIES ? entries[index].name : NULL; }

const char *dp_shape_about(uint32_t index) { return index < ENTRIES ? entries[index].about : NULL; }

/* Levenshtein distance of two names, which are short. */
static uint32_t edit_distance(const char *a, const char *b) {
    enum { LONGEST = 32 };
    uint32_t row[LONGEST + 1];
    const size_t n = strlen(b);
    if (n > LONGEST) return UINT32_MAX;
    for (uint32_t k = 0; k <= n; k++) row[k] = k;
    for (uint32_t i = 1; *a; a++, i++) {
        uint32_t diagonal = row[0];
        row[0] = i;
        for (size_t k = 1; k <= n; k++) {
            uint32_t best = diagonal + (*a != b[k - 1]);
            if (row[k] + 1 < best) best = row[k] + 1;
            if (row[k - 1] + 1 < best) best = row[k - 1] + 1;
            diagonal = row[k];
            row[k] = best;
        }
    }
    return row[n];
}

static const char *nearest_name(const char *name) {
    const entry *best = entries;
    for (const entry *e = entries; e < entries + ENTRIES; e++)
        if (edit_distance(name, e->name) < edit_distance(name, best->name)) best = e;
    return best->name;
}

static dp_result refuse_name(const char *name, dp_diag *diag) {
    char names[200] = "";
    const char *const near = nearest_name(name);
    if (2 * edit_distance(name, near) <= strlen(near))
        return dp_fail(diag, DP_ERR_ARGUMENT, "no shape is called \"%.64s\"; did you mean \"%s\"?",
                       name, near);
    for (size_t i = 0, n = 0; i < ENTRIES; i++)
        n += (size_t)snprintf(names + n, sizeof names - n, "%s%s", i ? ", " : "", entries[i].name);
    return dp_fail(diag, DP_ERR_ARGUMENT, "no shape is called \"%.64s\"; there are %s", name,
                   names);
}

static const entry *find(const char *name) {
    for (const entry *e = entries; e < entries + ENTRIES; e++)
        if (!strcmp(name, e->name)) return e;
    return NULL;
}

static uint64_t build(dp_model *model, const entry *e, uint32_t fine, uint32_t seed) {
    memset(model, 0, sizeof *model);
    model->fine = fine;
    model->seed = seed;
    e->build(model);
    return dp_model_triangles(model);
}

/* Builds the model with the fineness that comes nearest. */
static void build_nearest(dp_model *model, const entry *e, uint64_t triangles, uint32_t seed) {
    uint32_t low = 1, high = 2;
    while (high < 1u << 24 && build(model, e, high, seed) < triangles) high *= 2;
    while (high - low > 1) {
        const uint32_t middle = low + (high - low) / 2;
        if (build(model, e, middle, seed) <= triangles)
            low = middle;
        else
            high = middle;
    }
    const uint64_t above = build(model, e, high, seed), below = build(model, e, low, seed);
    if (triangles > below && above >= triangles && above - triangles < triangles - below)
        build(model, e, high, seed);
}

static const uint64_t MOST_TRIANGLES = 100000000000u; /* counts of cells stay well in 32 bits */

static dp_result check(const dp_shape *shape, const entry **found, dp_diag *diag) {
    if (!shape || !shape->name)
        return dp_fail(diag, DP_ERR_ARGUMENT, "dp_source_from_shape: shape or its name is NULL");
    *found = find(shape->name);
    if (!*found) return refuse_name(shape->name, diag);
    if (!(shape->size >= 0) || shape->size > 1e30)
        return dp_fail(diag, DP_ERR_ARGUMENT, "a shape's size must lie between 0 and 1e30");
    if (shape->triangles > MOST_TRIANGLES)
        return dp_fail(diag, DP_ERR_LIMIT, "a shape has at most %llu triangles",
                       (unsigned long long)MOST_TRIANGLES);
    return DP_OK;
}

dp_result dp_source_from_shape(const dp_shape *shape, dp_source **out, dp_diag *diag) {
    if (!out) return dp_fail(diag, DP_ERR_ARGUMENT, "dp_source_from_shape: out is NULL");
    *out = NULL;
    const entry *e = NULL;
    const dp_result wrong = check(shape, &e, diag);
    if (wrong) return wrong;
    const dp_allocator memory = dp_allocator_resolve(shape->allocator);
    dp_model *const model = dp_alloc(&memory, sizeof *model);
    if (!model) return dp_fail(diag, DP_ERR_MEMORY, "out of memory for a generated model");
    if (shape->triangles)
        build_nearest(model, e, shape->triangles, shape->seed);
    else
        build(model, e, e->fine, shape->seed);
    const double size = shape->size > 0 ? shape->size : 2;
    const dp_result result = dp_model_source(model, size / model->extent, &memory, out, diag);
    dp_free(&memory, model);
    return result;
}
