/* What a film shows, frame after frame, as one source: a camera that is fitted to it shows all
 * frames whole, and stands still while they go by.
 *
 * Of a long film some frames are looked at, evenly spaced: what a motion reaches between two of them
 * lies within the fit's margin of 4 % unless it is very quick. */
#include "film_seen.h"
#include "report.h"

#include <stdlib.h>
#include <string.h>

enum { LOOKS = 48, LOOKS_AT_MUCH = 8, MUCH = 2000000 /* polygons */ };

typedef struct seen {
    dp_source *source;
    const film_plan *plan;
    uint32_t looks, at;
    bool turned;
    double rotation[3][3];
    float *positions; /* of a turned batch, [room][3] */
    size_t room;
    const dp_extent *beside; /* a mirror's box, that turns with the model; or NULL */
    bool beside_due;         /* it comes next */
    float corners[8][3];     /* of it */
} seen;

static uint32_t frame_of(const seen *w) {
    const uint64_t last = w->plan->count - 1;
    return w->looks > 1 ? (uint32_t)(w->at * last / (w->looks - 1)) : 0;
}

static dp_result begin_look(seen *w, uint32_t at, dp_diag *diag) {
    w->at = at;
    w->beside_due = w->beside != NULL;
    if (w->turned) film_turn_back(w->plan, frame_of(w), w->rotation);
    const dp_result result = dp_source_set_time(w->source, film_time(w->plan, frame_of(w)), diag);
    return result ? result : dp_source_rewind(w->source, diag);
}

/* Turns a batch's positions, in memory of our own. */
static bool turn_batch(seen *w, dp_batch *b) {
    if (b->vertex_count > w->room) {
        float *const more = realloc(w->positions, b->vertex_count * 3 * sizeof *more);
        if (!more) return false;
        w->positions = more, w->room = b->vertex_count;
    }
    const double *const c = w->plan->centre;
    for (size_t v = 0; v < b->vertex_count; v++) {
        float from[3];
        double q[3];
        memcpy(from, (const char *)b->positions + v * b->position_stride, sizeof from);
        for (int i = 0; i < 3; i++) q[i] = b->origin[i] + (double)from[i] - c[i];
        for (int i = 0; i < 3; i++) {
            const double *const r = w->rotation[i];
            const double p = c[i] + r[0] * q[0] + r[1] * q[1] + r[2] * q[2];
            w->positions[3 * v + i] = (float)(p - b->origin[i]);
        }
    }
    b->positions = w->positions;
    b->position_stride = 3 * sizeof(float);
    b->stable = false;
    return true;
}

/* The box as six faces. */
static void hand_out_box(seen *w, dp_batch *b) {
    static const uint32_t faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                         {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    static const uint32_t firsts[7] = {0, 4, 8, 12, 16, 20, 24};
    const dp_extent *const e = w->beside;
    for (int i = 0; i < 8; i++)
        for (int k = 0; k < 3; k++)
            w->corners[i][k] =
                (float)((i >> k & 1 ? e->exact_max[k] : e->exact_min[k]) - w->plan->centre[k]);
    *b = (dp_batch){.positions = w->corners[0],
                    .position_stride = sizeof w->corners[0],
                    .vertex_count = 8,
                    .indices = faces[0],
                    .corner_count = 24,
                    .firsts = firsts,
                    .polygon_count = 6};
    memcpy(b->origin, w->plan->centre, sizeof b->origin);
}

/* What comes next of the model, or of its mirror, at the look's time. */
static dp_result next_of_look(seen *w, dp_batch *batch, dp_diag *diag) {
    const dp_result result = w->beside_due ? DP_OK : dp_source_next(w->source, batch, diag);
    if (w->beside_due) hand_out_box(w, batch);
    w->beside_due = false;
    return result;
}

static dp_result seen_next(void *user, dp_batch *batch, dp_diag *diag) {
    seen *const w = user;
    for (;;) {
        dp_result result = next_of_look(w, batch, diag);
        if (!result && !batch->polygon_count && w->at + 1 < w->looks) {
            result = begin_look(w, w->at + 1, diag);
            if (!result) continue;
        }
        if (result || !batch->polygon_count || !w->turned) return result;
        batch->normals = batch->texcoords = (dp_attribute){0};
        if (turn_batch(w, batch)) return DP_OK;
        *diag =
            (dp_diag){.result = DP_ERR_MEMORY, .message = "out of memory for what a film shows"};
        return DP_ERR_MEMORY;
    }
}

static dp_result seen_rewind(void *user, dp_diag *diag) { return begin_look(user, 0, diag); }

static void seen_destroy(void *user) {
    seen *const w = user;
    free(w->positions);
    free(w);
}

/* How many frames are looked at. */
static dp_result count_looks(seen *w, uint64_t *polygons, dp_diag *diag) {
    dp_extent extent;
    const dp_result result = dp_source_extent(w->source, &extent, diag);
    const uint32_t most = extent.polygons > MUCH ? LOOKS_AT_MUCH : LOOKS;
    w->looks = w->plan->count < most ? w->plan->count : most;
    if (polygons) *polygons = extent.polygons;
    return result;
}

int film_seen_make(const film_plan *plan, dp_source *source, bool turned, const dp_extent *beside,
                   dp_source **out, uint64_t *polygons) {
    dp_diag diag = {0};
    seen *const w = calloc(1, sizeof *w);
    *out = NULL;
    if (!w) return wrong_usage("out of memory for a film"), EXIT_FAILED;
    *w = (seen){.source = source, .plan = plan, .turned = turned, .beside = beside};
    dp_source_callbacks callbacks = {
        .user = w, .next = seen_next, .rewind = seen_rewind, .destroy = seen_destroy};
    callbacks.up_assumed = !dp_source_up(source, callbacks.up);
    dp_result result = count_looks(w, polygons, &diag);
    if (!result) result = begin_look(w, 0, &diag);
    if (!result) result = dp_source_from_callbacks(&callbacks, NULL, out, &diag);
    if (!result) return 0;
    free(w);
    return report_failure(NULL, &diag), EXIT_FAILED;
}
