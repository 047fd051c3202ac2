/* One source of several, a scene: their batches one after the other.
 *
 * Batches go through as they are, but for their groups, which get numbers of their own: group 0 of
 * source k is group k, and every other one gets the next number when it is first read. A table
 * leads back from a number to the source and its group, for names and colours.
 *
 * Where all sources have records of one layout, so has the scene: records of one source after the
 * other, which is the order of its batches.
 *
 * Invariant: a (source, group) keeps its number while the scene lives, so that every reading has
 * the same ones. Numbers are used up at MOST; what comes later shares the last. */
#include "mesh/source.h"

#include "base/diag.h"
#include "base/vec.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

enum { MOST = 65536 /* dp_batch.groups has 16 bits */, NONE = -1 };

/* What a group of the scene is. */
typedef struct member {
    uint32_t part, group;
    char *name; /* made when it is first asked for */
} member;

/* One of the sources. */
typedef struct part {
    dp_source *source;
    char *name;       /* NULL: none */
    int32_t *numbers; /* [number_count] of its groups in the scene, or NONE */
    size_t number_count, numbers_cap;
    uint64_t first; /* number of its first record */
} part;

typedef struct scene {
    dp_allocator memory;
    part *parts; /* [count] */
    size_t count, at;
    member *members;  /* [member_count] */
    uint16_t *groups; /* of the batch */
    char *remark, *color_remark;
    size_t member_count, members_cap, groups_cap, remark_cap, color_remark_cap;
} scene;

/* ------- groups ------- */

static bool add_number(scene *s, uint32_t k, uint32_t group) {
    part *const p = &s->parts[k];
    const size_t before = p->number_count;
    if (!dp_reserve(&s->memory, &p->numbers, &p->numbers_cap, (size_t)group + 1,
                    sizeof *p->numbers))
        return false;
    for (size_t g = before; g <= group; g++) p->numbers[g] = NONE;
    if (group >= before) p->number_count = (size_t)group + 1;
    if (s->member_count < MOST) {
        if (!dp_reserve(&s->memory, &s->members, &s->members_cap, s->member_count + 1,
                        sizeof *s->members))
            return false;
        s->members[s->member_count++] = (member){.part = k, .group = group};
    }
    p->numbers[group] = (int32_t)s->member_count - 1;
    return true;
}

/* The number in the scene of a part's group, which has one from then on; NONE: memory is out. */
static int32_t number_of(scene *s, uint32_t k, uint32_t group) {
    const part *const p = &s->parts[k];
    if (group < p->number_count && p->numbers[group] != NONE) return p->numbers[group];
    return add_number(s, k, group) ? p->numbers[group] : NONE;
}

static bool number_groups(scene *s, uint32_t k, dp_batch *batch) {
    if (!batch->groups && number_of(s, k, 0) == 0) return true;
    if (!dp_reserve(&s->memory, &s->groups, &s->groups_cap, batch->polygon_count,
                    sizeof *s->groups))
        return false;
    for (size_t i = 0; i < batch->polygon_count; i++) {
        const int32_t number = number_of(s, k, batch->groups ? batch->groups[i] : 0);
        if (number == NONE) return false;
        s->groups[i] = (uint16_t)number;
    }
    batch->groups = s->groups;
    return true;
}

/* "NAME/GROUP", or one of them where there is no other. */
static const char *scene_group_name(void *user, uint32_t group) {
    scene *const s = user;
    if (group >= s->member_count) return NULL;
    member *const m = &s->members[group];
    const char *const whole = s->parts[m->part].name, *const own = dp_source_group_name(
                                                          s->parts[m->part].source, m->group);
    if (!whole || !own) return whole ? whole : own;
    if (!m->name) {
        const size_t size = strlen(whole) + strlen(own) + 2;
        m->name = dp_alloc(&s->memory, size);
        if (m->name) snprintf(m->name, size, "%s/%s", whole, own);
    }
    return m->name;
}

static uint32_t scene_group_color(void *user, uint32_t group) {
    const scene *const s = user;
    if (group >= s->member_count) return 0;
    const member *const m = &s->members[group];
    return dp_source_group_color(s->parts[m->part].source, m->group);
}

static uint32_t scene_part_of_group(const void *user, uint32_t group) {
    const scene *const s = user;
    return group < s->member_count ? s->members[group].part : 0;
}

/* ------- messages ------- */

/* Puts the part's name before a message, as much of it as half a message. */
static dp_result name_failure(const part *p, dp_result result, dp_diag *diag) {
    enum { SIZE = sizeof diag->message };
    char *const text = diag->message;
    const size_t length = p->name ? strlen(p->name) : 0, n = length < SIZE / 2 ? length : SIZE / 2;
    if (!p->name) return result;
    if (!*text) snprintf(text, SIZE, "%s", dp_result_name(result));
    memmove(text + n + 2, text, SIZE - n - 3);
    memcpy(text, p->name, n);
    memcpy(text + n, ": ", 2);
    text[SIZE - 1] = 0;
    return result;
}

/* Adds "NAME: TEXT" to a remark; a part without a name only its text. False: memory is out. */
static bool add_remark(const scene *s, const part *p, const char *text, char **to, size_t *cap) {
    const size_t before = *to ? strlen(*to) : 0, size = strlen(text) + 5;
    if (!dp_reserve(&s->memory, to, cap, before + size + (p->name ? strlen(p->name) : 0), 1))
        return false;
    snprintf(*to + before, *cap - before, "%s%s%s%s", before ? "; " : "", p->name ? p->name : "",
             p->name ? ": " : "", text);
    return true;
}

/* The remarks of all parts; NULL: there are none. */
static const char *gather_remarks(const scene *s, const char *(*remark_of)(const dp_source *),
                                  char **to, size_t *cap) {
    if (*to) **to = 0;
    for (size_t k = 0; k < s->count; k++) {
        const char *const text = remark_of(s->parts[k].source);
        if (text && !add_remark(s, &s->parts[k], text, to, cap)) break;
    }
    return *to && **to ? *to : NULL;
}

static const char *scene_remark(void *user) {
    scene *const s = user;
    return gather_remarks(s, dp_source_remark, &s->remark, &s->remark_cap);
}

static const char *scene_color_remark(void *user) {
    scene *const s = user;
    return gather_remarks(s, dp_source_color_remark, &s->color_remark, &s->color_remark_cap);
}

/* ------- reading ------- */

static dp_result scene_next(void *user, dp_batch *batch, dp_diag *diag) {
    scene *const s = user;
    for (; s->at < s->count; s->at++) {
        const dp_result result = dp_source_next(s->parts[s->at].source, batch, diag);
        if (result) return name_failure(&s->parts[s->at], result, diag);
        if (!batch->polygon_count) continue;
        batch->stable = false; /* its groups are not */
        if (!number_groups(s, (uint32_t)s->at, batch))
            return dp_fail(diag, DP_ERR_MEMORY, "out of memory for the groups of a scene");
        return DP_OK;
    }
    *batch = (dp_batch){0};
    return DP_OK;
}

static dp_result scene_rewind(void *user, dp_diag *diag) {
    scene *const s = user;
    s->at = 0;
    for (size_t k = 0; k < s->count; k++) {
        const dp_result result = dp_source_rewind(s->parts[k].source, diag);
        if (result) return name_failure(&s->parts[k], result, diag);
    }
    return DP_OK;
}

static dp_result scene_set_time(void *user, double time, dp_diag *diag) {
    scene *const s = user;
    s->at = 0;
    for (size_t k = 0; k < s->count; k++) {
        const dp_result result = dp_source_set_time(s->parts[k].source, time, diag);
        if (result) return name_failure(&s->parts[k], result, diag);
    }
    return DP_OK;
}

static double scene_duration(void *user) {
    const scene *const s = user;
    double longest = 0;
    for (size_t k = 0; k < s->count; k++)
        longest = dp_max(longest, dp_source_duration(s->parts[k].source));
    return longest;
}

static void scene_lend(void *user, dp_threads *threads) {
    const scene *const s = user;
    for (size_t k = 0; k < s->count; k++) dp_source_lend(s->parts[k].source, threads);
}

/* Records may begin in one part and end in another. */
static dp_result scene_records(void *user, uint64_t first, uint32_t count, uint8_t *to,
                               dp_diag *diag) {
    const scene *const s = user;
    size_t k = 0;
    while (k + 1 < s->count && s->parts[k + 1].first <= first) k++;
    for (; count; k++) {
        const part *const p = &s->parts[k];
        const dp_records *const r = &p->source->records;
        const uint64_t left = p->first + r->count - first;
        const uint32_t n = left < count ? (uint32_t)left : count;
        if (!n) continue;
        const dp_result result = r->read(r->user, first - p->first, n, to, diag);
        if (result) return name_failure(p, result, diag);
        first += n, count -= n, to += n * r->size;
    }
    return DP_OK;
}

/* ------- making ------- */

static void offer_records(scene *s, dp_source *source) {
    const dp_records *const like = &s->parts[0].source->records;
    uint64_t count = 0;
    for (size_t k = 0; k < s->count; k++) {
        const dp_records *const r = &s->parts[k].source->records;
        if (!r->read || r->size != like->size || r->corners != like->corners) return;
        s->parts[k].first = count;
        count += r->count;
    }
    source->records = *like;
    source->records.count = count;
    source->records.user = s;
    source->records.read = scene_records;
}

/* Frees all but the sources. */
static void release(scene *s) {
    const dp_allocator memory = s->memory;
    for (size_t k = 0; k < s->count; k++) {
        dp_free(&memory, s->parts[k].name);
        dp_free(&memory, s->parts[k].numbers);
    }
    for (size_t g = 0; g < s->member_count; g++) dp_free(&memory, s->members[g].name);
    dp_free(&memory, s->parts);
    dp_free(&memory, s->members);
    dp_free(&memory, s->groups);
    dp_free(&memory, s->remark);
    dp_free(&memory, s->color_remark);
    dp_free(&memory, s);
}

static void scene_destroy(void *user) {
    scene *const s = user;
    for (size_t k = 0; k < s->count; k++) dp_source_destroy(s->parts[k].source);
    release(s);
}

static bool fill_part(scene *s, uint32_t k, dp_source *source, const char *name) {
    part *const p = &s->parts[k];
    p->source = source;
    if (name && !(p->name = dp_alloc(&s->memory, strlen(name) + 1))) return false;
    if (name) memcpy(p->name, name, strlen(name) + 1);
    return add_number(s, k, 0);
}

static scene *make_scene(dp_source *const *sources, const char *const *names, size_t count,
                         const dp_allocator *memory) {
    scene *const s = dp_alloc_zeroed(memory, sizeof *s);
    if (!s) return NULL;
    s->memory = *memory;
    s->parts = dp_alloc_zeroed(memory, dp_times(count, sizeof *s->parts));
    if (s->parts) s->count = count;
    bool done = s->parts != NULL;
    for (uint32_t k = 0; done && k < count; k++)
        done = fill_part(s, k, sources[k], names ? names[k] : NULL);
    if (done) return s;
    release(s);
    return NULL;
}

static dp_result check(dp_source *const *sources, size_t count, dp_diag *diag) {
    if (!sources || !count)
        return dp_fail(diag, DP_ERR_ARGUMENT, "dp_source_join: no sources are given");
    if (count > MOST)
        return dp_fail(diag, DP_ERR_LIMIT, "a scene of %zu sources; %d are the most", count, MOST);
    for (size_t k = 0; k < count; k++) {
        if (!sources[k])
            return dp_fail(diag, DP_ERR_ARGUMENT, "dp_source_join: source %zu is NULL", k);
        for (size_t i = 0; i < k; i++)
            if (sources[i] == sources[k])
                return dp_fail(diag, DP_ERR_ARGUMENT,
                               "dp_source_join: sources %zu and %zu are the same", i, k);
    }
    return DP_OK;
}

dp_result dp_source_join(dp_source *const *sources, const char *const *names, size_t count,
                         const dp_allocator *allocator, dp_source **out, dp_diag *diag) {
    if (!out) return dp_fail(diag, DP_ERR_ARGUMENT, "dp_source_join: out is NULL");
    *out = NULL;
    dp_result result = check(sources, count, diag);
    if (result) return result;
    const dp_allocator memory = dp_allocator_resolve(allocator);
    bool rewindable = true, constant = true;
    for (size_t k = 0; k < count; k++) {
        rewindable &= dp_source_rewindable(sources[k]);
        constant &= sources[k]->constant;
    }
    scene *const s = make_scene(sources, names, count, &memory);
    if (!s) return dp_fail(diag, DP_ERR_MEMORY, "out of memory for a scene");
    const dp_source_callbacks callbacks = {.user = s,
                                           .next = scene_next,
                                           .rewind = rewindable ? scene_rewind : NULL,
                                           .destroy = scene_destroy,
                                           .group_name = scene_group_name,
                                           .group_color = scene_group_color,
                                           .remark = scene_remark,
                                           .color_remark = scene_color_remark,
                                           .set_time = scene_set_time,
                                           .duration = scene_duration};
    result = dp_source_from_callbacks(&callbacks, &memory, out, diag);
    if (result) return release(s), result;
    memcpy((*out)->callbacks.up, sources[0]->callbacks.up, sizeof sources[0]->callbacks.up);
    (*out)->callbacks.up_assumed = sources[0]->callbacks.up_assumed; /* the first one says */
    (*out)->constant = constant;
    (*out)->lend = scene_lend;
    (*out)->part_of_group = count > 1 ? scene_part_of_group : NULL;
    offer_records(s, *out);
    return DP_OK;
}
