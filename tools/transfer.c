/* Sends a source through a pipe as a head, which is a plain struct because both ends are the same
 * program, its groups, and its arrays; the batch in the head tells which arrays follow, and how long
 * they are.
 *
 * Invariant: nothing that is received is trusted, as the sender may have overwritten anything: counts
 * and names are checked here, `firsts` by dp_source_next, indices by drawing.
 *
 * Not handled: sources of several batches, which those of whole files are not. */
#include "transfer.h"

#include "progress.h"

#include <errno.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

enum { ARRAYS = 9, REMARK = 256 };

typedef struct group {
    uint32_t color, name; /* name: byte in the text; UINT32_MAX: none */
} group;

/* What is sent first. Pointers in the batch only tell which arrays there are. */
typedef struct head {
    dp_diag diag; /* result DP_OK: a batch follows, then groups and their names */
    dp_batch batch;
    uint32_t group_count, text_size;
    double up[3]; /* 0: not said */
    char remark[REMARK], color_remark[REMARK];
} head;

/* An array of a batch: where its pointer is, and its size. */
typedef struct array {
    size_t at, bytes;
} array;

static void list_arrays(const dp_batch *b, array arrays[ARRAYS]) {
#define AT(member) offsetof(dp_batch, member)
    const size_t corners = b->corner_count * sizeof(uint32_t);
    const array list[ARRAYS] = {
        {AT(positions), b->vertex_count * b->position_stride},
        {AT(indices), corners},
        {AT(firsts), (b->polygon_count + 1) * sizeof(uint32_t)},
        {AT(groups), b->polygon_count * sizeof(uint16_t)},
        {AT(normals.values), b->normals.count * b->normals.stride},
        {AT(normals.indices), corners},
        {AT(texcoords.values), b->texcoords.count * b->texcoords.stride},
        {AT(texcoords.indices), corners},
        {AT(colors), b->vertex_count * sizeof(uint32_t)},
    };
#undef AT
    memcpy(arrays, list, sizeof list);
}

static void *array_of(const dp_batch *b, const array *a) {
    void *block;
    memcpy(&block, (const char *)b + a->at, sizeof block);
    return block;
}

/* Are the counts possible, and sizes free of overflow? */
static bool is_plausible(const head *h) {
    const dp_batch *const b = &h->batch;
    return b->positions && b->vertex_count <= UINT32_MAX && b->corner_count <= UINT32_MAX &&
           b->polygon_count <= UINT32_MAX && b->normals.count <= UINT32_MAX &&
           b->texcoords.count <= UINT32_MAX && b->position_stride == 3 * sizeof(float) &&
           b->normals.stride == 3 * sizeof(float) && b->texcoords.stride == 2 * sizeof(float);
}

/* ------- sending ------- */

static bool send_bytes(int to, const void *bytes, size_t count) {
    const char *p = bytes;
    while (count) {
        const ssize_t sent = write(to, p, count);
        if (sent < 0 && errno == EINTR) continue;
        if (sent <= 0) return false;
        p += sent;
        count -= (size_t)sent;
    }
    return true;
}

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
        sent = send_bytes(to, &one, sizeof one);
    }
    for (uint32_t g = 0; g < h->group_count && sent; g++) {
        const char *const name = dp_source_group_name(source, g);
        if (name) sent = send_bytes(to, name, strlen(name) + 1);
    }
    return sent;
}

static void copy_remark(char to[REMARK], const char *remark) {
    if (remark) snprintf(to, REMARK, "%s", remark);
}

bool transfer_send(int to, dp_source *source, dp_diag *diag) {
    array arrays[ARRAYS];
    head h = {.diag = *diag};
    if (!h.diag.result) h.diag.result = dp_source_next(source, &h.batch, &h.diag);
    if (h.diag.result) return send_bytes(to, &h, sizeof h);
    if (!dp_source_up(source, h.up)) memset(h.up, 0, sizeof h.up);
    copy_remark(h.remark, dp_source_remark(source));
    copy_remark(h.color_remark, dp_source_color_remark(source));
    count_groups(&h, source);
    bool sent = send_bytes(to, &h, sizeof h) && send_groups(to, &h, source);
    list_arrays(&h.batch, arrays);
    for (int k = 0; k < ARRAYS && sent; k++)
        if (array_of(&h.batch, &arrays[k]))
            sent = send_bytes(to, array_of(&h.batch, &arrays[k]), arrays[k].bytes);
    return sent;
}

/* ------- a source of what was received ------- */

typedef struct received {
    head h;
    group *groups;
    char *text;
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
    array arrays[ARRAYS];
    list_arrays(&r->h.batch, arrays);
    for (int k = 0; k < ARRAYS; k++) free(array_of(&r->h.batch, &arrays[k]));
    free(r->groups);
    free(r->text);
    free(r);
}

/* ------- receiving ------- */

typedef struct channel {
    int from;
    double deadline; /* s, of transfer_clock */
    bool late, full; /* the deadline is over; no memory is left */
} channel;

double transfer_clock(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Waits for bytes, and moves the progress bar. False after the deadline. */
static bool wait_for_bytes(channel *c) {
    struct pollfd ready = {.fd = c->from, .events = POLLIN};
    while (poll(&ready, 1, 100 /* ms */) <= 0) {
        progress_report(NULL, -1);
        c->late = transfer_clock() > c->deadline;
        if (c->late) return false;
    }
    return true;
}

static bool receive_bytes(channel *c, void *bytes, size_t count) {
    char *p = bytes;
    while (count) {
        if (!wait_for_bytes(c)) return false;
        const ssize_t got = read(c->from, p, count);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return false;
        p += got;
        count -= (size_t)got;
    }
    return true;
}

/* Receives an array of its own; NULL on failure. */
static void *receive_block(channel *c, size_t bytes) {
    void *const block = malloc(bytes + 1);
    if (block && receive_bytes(c, block, bytes)) return block;
    c->full = !block;
    free(block);
    return NULL;
}

static bool receive_arrays(channel *c, received *r) {
    const dp_batch sent = r->h.batch;
    array arrays[ARRAYS];
    list_arrays(&sent, arrays);
    for (int k = 0; k < ARRAYS; k++) memset((char *)&r->h.batch + arrays[k].at, 0, sizeof(void *));
    r->h.batch.edge_flags = NULL;
    r->groups = receive_block(c, r->h.group_count * sizeof *r->groups);
    r->text = r->groups ? receive_block(c, r->h.text_size) : NULL;
    if (!r->text) return false;
    r->text[r->h.text_size] = 0;
    for (int k = 0; k < ARRAYS; k++) {
        if (!array_of(&sent, &arrays[k])) continue;
        void *const block = receive_block(c, arrays[k].bytes);
        if (!block) return false;
        memcpy((char *)&r->h.batch + arrays[k].at, &block, sizeof block);
    }
    return true;
}

/* Receives the model; NULL if it does not come whole. With a result in the head, that is all. */
static received *receive_model(channel *c) {
    received *const r = calloc(1, sizeof *r);
    if (!r) return NULL;
    const bool whole = receive_bytes(c, &r->h, sizeof r->h);
    const bool sound = whole && is_plausible(&r->h);
    r->h.remark[REMARK - 1] = r->h.color_remark[REMARK - 1] = 0;
    r->h.diag.message[sizeof r->h.diag.message - 1] = 0;
    if (whole && r->h.diag.result) return r;
    if (!sound) r->h.batch = (dp_batch){0};
    if (sound && receive_arrays(c, r)) return r;
    received_destroy(r);
    return NULL;
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
    dp_result result = r->h.diag.result;
    if (result)
        *diag = r->h.diag, r->h.batch = (dp_batch){0};
    else
        result = dp_source_from_callbacks(&callbacks, NULL, out, diag);
    if (result) received_destroy(r);
    return result;
}

transfer_end transfer_receive(int from, double deadline, dp_source **out, dp_diag *diag) {
    channel c = {.from = from, .deadline = deadline};
    received *const r = receive_model(&c);
    if (!r) return c.late ? TRANSFER_LATE : c.full ? TRANSFER_FULL : TRANSFER_BROKEN;
    diag->result = make_source(r, out, diag);
    return TRANSFER_DONE;
}
