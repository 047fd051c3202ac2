/* Pulling an assembly apart: offsets from the centres of boxes.
 *
 *     part of each group: its source's number in a scene, or the start of its name
 *     sort groups by part: those of one part follow each other
 *     for each part: the box around its groups; offset = factor * (its centre - the assembly's)
 *
 * Invariant: offsets depend on the groups' names and boxes alone, not on their order. */
#include "mesh/parts.h"

#include "base/diag.h"
#include "base/sort.h"
#include "base/vec.h"

#include <drypoint/objects.h>

#include <string.h>

/* A group, and what its part is called: [name, name + length), or, without a name, a number. */
typedef struct member {
    const char *name; /* NULL: none */
    size_t length;
    uint32_t number, group;
} member;

static int by_part(const void *left, const void *right) {
    const member *const a = left, *const b = right;
    if (!a->name || !b->name) {
        if (a->name || b->name) return a->name ? 1 : -1;
        return (a->number > b->number) - (a->number < b->number);
    }
    const size_t shorter = a->length < b->length ? a->length : b->length;
    const int order = memcmp(a->name, b->name, shorter);
    return order ? order : (a->length > b->length) - (a->length < b->length);
}

/* ------- parts ------- */

/* Bytes that two names have in common, up to and with a /. */
static size_t common_folders(const char *a, const char *b, size_t most) {
    size_t common = 0;
    for (size_t i = 0; i < most && a[i] && a[i] == b[i]; i++)
        if (a[i] == '/') common = i + 1;
    return common;
}

/* Of each name, what stands between what all have in common and the next /. */
static void cut_names(member *members, size_t count) {
    size_t common = SIZE_MAX;
    const char *first = NULL;
    for (size_t i = 0; i < count; i++) {
        if (!members[i].name) continue;
        if (!first) first = members[i].name;
        common = common_folders(first, members[i].name, common);
    }
    for (size_t i = 0; i < count; i++) {
        if (!members[i].name) continue;
        members[i].name += common;
        members[i].length = strcspn(members[i].name, "/");
    }
}

/* The groups that have a place, and their parts; their number. */
static size_t list_members(const dp_source *source, const dp_group *groups, uint32_t count,
                           member *members) {
    size_t listed = 0;
    for (uint32_t g = 0; g < count; g++) {
        if (!(groups[g].min[0] <= groups[g].max[0])) continue;
        member *const m = &members[listed++];
        *m = (member){.number = g, .group = g};
        if (!dp_source_part(source, g, &m->number)) m->name = dp_source_group_name(source, g);
    }
    cut_names(members, listed);
    return listed;
}

/* ------- boxes ------- */

typedef struct box {
    double min[3], max[3];
} box;

static const box empty = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};

static box box_of(const dp_group *groups, const member *members, size_t count) {
    box b = empty;
    for (size_t i = 0; i < count; i++)
        for (int k = 0; k < 3; k++) {
            b.min[k] = dp_min(b.min[k], groups[members[i].group].min[k]);
            b.max[k] = dp_max(b.max[k], groups[members[i].group].max[k]);
        }
    return b;
}

/* Halves first: their sum cannot overflow. */
static dp_vec3 centre_of(const box *b) {
    return dp_v3(b->min[0] / 2 + b->max[0] / 2, b->min[1] / 2 + b->max[1] / 2,
                 b->min[2] / 2 + b->max[2] / 2);
}

/* The axis made a unit vector, however long it is; 0 stays 0. */
static dp_vec3 unit_of(const double axis[3]) {
    const double most = dp_max(fabs(axis[0]), dp_max(fabs(axis[1]), fabs(axis[2])));
    if (!(most > 0)) return dp_v3(0, 0, 0);
    return dp_unit(dp_v3(axis[0] / most, axis[1] / most, axis[2] / most));
}

static dp_vec3 offset_of(const dp_explosion *explosion, const box *part, dp_vec3 centre) {
    const dp_vec3 away = dp_sub(centre_of(part), centre), unit = unit_of(explosion->axis);
    if (!(dp_dot(unit, unit) > 0)) return dp_scale(away, explosion->factor);
    return dp_scale(unit, explosion->factor * dp_dot(away, unit));
}

static void move_parts(const dp_group *groups, const member *members, size_t count,
                       const dp_explosion *explosion, dp_placement *placements) {
    const box whole = box_of(groups, members, count);
    const dp_vec3 centre = centre_of(&whole);
    for (size_t first = 0, end; first < count; first = end) {
        for (end = first + 1; end < count && !by_part(&members[first], &members[end]); end++) {
        }
        const box part = box_of(groups, members + first, end - first);
        const dp_vec3 offset = offset_of(explosion, &part, centre);
        for (size_t i = first; i < end; i++) {
            double *const to = placements[members[i].group].offset;
            to[0] += offset.x, to[1] += offset.y, to[2] += offset.z;
        }
    }
}

dp_result dp_source_explode(const dp_source *source, const dp_group *groups, uint32_t count,
                            const dp_explosion *explosion, dp_placement *placements,
                            dp_diag *diag) {
    if (!source || !explosion || (count && (!groups || !placements)))
        return dp_fail(diag, DP_ERR_ARGUMENT, "dp_source_explode: an argument is NULL");
    const double *const axis = explosion->axis;
    if (!isfinite(explosion->factor) || !isfinite(axis[0]) || !isfinite(axis[1]) ||
        !isfinite(axis[2]))
        return dp_fail(diag, DP_ERR_ARGUMENT, "the explosion's factor or axis is not finite");
    if (!count) return DP_OK;
    const dp_allocator *const memory = dp_source_memory(source);
    member *const members = dp_alloc_array(memory, count, sizeof *members);
    if (!members) return dp_fail(diag, DP_ERR_MEMORY, "out of memory for %u groups", count);
    const size_t listed = list_members(source, groups, count, members);
    dp_sort(members, listed, sizeof *members, by_part);
    move_parts(groups, members, listed, explosion, placements);
    dp_free(memory, members);
    return DP_OK;
}
