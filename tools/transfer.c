/* Sends a source through a pipe as a head, which is a plain struct because both ends are the same
 * program, and then its batch's groups and arrays (transfer_batch.c), or its scene
 * (transfer_scene.c).
 *
 * Invariant: nothing that is received is trusted, as the sender may have overwritten anything: counts
 * and names are checked here, `firsts` by dp_source_next, indices by drawing.
 *
 * Not handled: sources of several batches, which those of whole files are not. */
#include "transfer.h"

#include "pipe.h"
#include "transfer_batch.h"
#include "transfer_scene.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { REMARK = 256 };

typedef struct group {
    uint32_t color, name; /* name: byte in the text; UINT32_MAX: none */
} group;

/* What is sent first. Pointers in the batch only tell which arrays there are. */
typedef struct head {
    dp_diag diag;      /* result DP_OK: a scene follows, or groups, their names, and a batch */
    uint32_t is_scene; /* then all else is 0 */
    uint32_t group_count, text_size;
    dp_batch batch;
    double up[3]; /* 0: not said */
    char remark[REMARK], color_remark[REMARK];
} head;

/* ------- sending ------- */

/* Counts the batch's groups, and the bytes of their names. */
static void count_groups(head *h, const dp_source *source) {
    h->group_count = 1;
    for (size_t i = 0; i < h->batch.polygon_count && h->batch.groups; i++)
        if (h->batch.groups[i] >= h->group_count) h->group_count = h->batch.groups[i] + 1u;
    for (uint32_t g = 0; g < h->group_count; g++) {
        const char *const name = dp_source_group_name(source, g);
        if (name) h->text_size += (uint32_t)strlen(name) + 1;
    }
}

/* Sends each group's colour and name, then the names one after the other. */
static bool send_groups(int to, const head *h, const dp_source *source) {
    uint32_t at = 0;
    bool sent = true;
    for (uint32_t g = 0; g < h->group_count && sent; g++) {
        const char *const name = dp_source_group_name(source, g);
        const group one = {dp_source_group_color(source, g), name ? at : UINT32_MAX};
        if (name) at += (uint32_t)strlen(name) + 1;
        sent = pipe_send(to, &one, sizeof one);
    }
    for (uint32_t g = 0; g < h->group_count && sent; g++) {
        const char *const name = dp_source_group_name(source, g);
        if (name) sent = pipe_send(to, name, strlen(name) + 1);
    }
    return sent;
}

static void copy_remark(char to[REMARK], const char *remark) {
    if (remark) snprintf(to, REMARK, "%s", remark);
}

static bool send_scene(int to, head *h, const dp_scene_desc *desc) {
    h->is_scene = true;
    return pipe_send(to, h, sizeof *h) && transfer_send_scene(to, desc);
}

bool transfer_send(int to, dp_source *source, dp_diag *diag) {
    head h = {.diag = *diag};
    const dp_scene_desc *const scene = h.diag.result ? NULL : dp_scene_of(source);
    if (scene) return send_scene(to, &h, scene);
    if (!h.diag.result) h.diag.result = dp_source_next(source, &h.batch, &h.diag);
    if (h.diag.result) return pipe_send(to, &h, sizeof h);
    if (!dp_source_up(source, h.up)) memset(h.up, 0, sizeof h.up);
    copy_remark(h.remark, dp_source_remark(source));
    copy_remark(h.color_remark, dp_source_color_remark(source));
    count_groups(&h, source);
    transfer_settle_batch(&h.batch);
    return pipe_send(to, &h, sizeof h) && send_groups(to, &h, source) &&
           transfer_send_batch(to, &h.batch);
}

/* ------- a source of what was received ------- */

typedef struct received {
    head h;
    group *groups;
    char *text;
    pipe_end end; /* whose blocks hold the arrays */
    bool handed_out;
} received;

static dp_result received_next(void *user, dp_batch *batch, dp_diag *diag) {
    received *const r = user;
    (void)diag;
    if (!r->handed_out) *batch = r->h.batch;
    r->handed_out = true;
    return DP_OK;
}

static dp_result received_rewind(void *user, dp_diag *diag) {
    (void)diag;
    ((received *)user)->handed_out = false;
    return DP_OK;
}

static const char *received_name(void *user, uint32_t number) {
    const received *const r = user;
    if (number >= r->h.group_count || r->groups[number].name >= r->h.text_size) return NULL;
    return r->text + r->groups[number].name;
}

static uint32_t received_color(void *user, uint32_t number) {
    const received *const r = user;
    return number < r->h.group_count ? r->groups[number].color : 0;
}

static const char *received_remark(void *user) {
    const received *const r = user;
    return *r->h.remark ? r->h.remark : NULL;
}

static const char *received_color_remark(void *user) {
    const received *const r = user;
    return *r->h.color_remark ? r->h.color_remark : NULL;
}

static void received_destroy(void *user) {
    received *const r = user;
    pipe_free(&r->end);
    free(r);
}

/* ------- receiving ------- */

static bool receive_groups(received *r) {
    r->groups = pipe_receive_block(&r->end, r->h.group_count, sizeof *r->groups);
    r->text = r->groups ? pipe_receive_block(&r->end, r->h.text_size, 1) : NULL;
    return r->text;
}

/* Receives the head. False: it does not come whole. */
static bool receive_head(received *r) {
    const bool whole = pipe_receive(&r->end, &r->h, sizeof r->h);
    r->h.remark[REMARK - 1] = r->h.color_remark[REMARK - 1] = 0;
    r->h.diag.message[sizeof r->h.diag.message - 1] = 0;
    return whole;
}

static dp_result make_source(received *r, dp_source **out, dp_diag *diag) {
    const dp_source_callbacks callbacks = {.user = r,
                                           .next = received_next,
                                           .rewind = received_rewind,
                                           .destroy = received_destroy,
                                           .group_name = received_name,
                                           .group_color = received_color,
                                           .remark = received_remark,
                                           .color_remark = received_color_remark,
                                           .up = {r->h.up[0], r->h.up[1], r->h.up[2]}};
    const dp_result result = dp_source_from_callbacks(&callbacks, NULL, out, diag);
    if (result) received_destroy(r);
    return result;
}

static transfer_end give_up(received *r) {
    const pipe_end end = r->end;
    received_destroy(r);
    return end.late ? TRANSFER_LATE : end.full ? TRANSFER_FULL : TRANSFER_BROKEN;
}

/* A scene becomes a source of its own, and what was received is not needed any more. */
static transfer_end receive_scene(received *r, dp_source **out, dp_diag *diag) {
    if (!transfer_receive_scene(&r->end, out, diag)) return give_up(r);
    received_destroy(r);
    return TRANSFER_DONE;
}

transfer_end transfer_receive(int from, double deadline, dp_source **out, dp_diag *diag) {
    received *const r = calloc(1, sizeof *r);
    if (!r) return TRANSFER_FULL;
    r->end = (pipe_end){.from = from, .deadline = deadline};
    if (!receive_head(r)) return give_up(r);
    if (r->h.diag.result) {
        *diag = r->h.diag;
        received_destroy(r);
        return TRANSFER_DONE;
    }
    if (r->h.is_scene) return receive_scene(r, out, diag);
    if (!receive_groups(r) || !transfer_receive_batch(&r->end, &r->h.batch)) return give_up(r);
    diag->result = make_source(r, out, diag);
    return TRANSFER_DONE;
}
