/* Reads a model in a child process. Assimp has readers of some forty formats, and broken files crash
 * some of them, or keep them busy or allocating for ever.
 *
 *     child    limits its memory and time, dp_io_open, sends a head, then the batch's arrays
 *     parent   receives them into arrays of its own until the deadline, then waits for the child
 *
 * Both are the same program, so that the head is a plain struct and the batch in it tells which
 * arrays follow, and how long they are. Invariant: nothing that is received is trusted beyond its
 * length: dp_source_next checks `firsts`, drawing checks indices, here the names are checked.
 *
 * fork is safe because no thread has been started: models are opened before contexts are made.
 *
 * Not handled: sources of several batches, which Assimp's are not. */
#include "apart.h"

#include "progress.h"

#include <drypoint/io.h>

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

enum { ARRAYS = 9, REMARK = 256 };

typedef struct group {
    uint32_t color, name; /* name: byte in the text; UINT32_MAX: none */
} group;

/* What is sent first. Pointers in the batch only tell which arrays there are. */
typedef struct head {
    dp_diag diag; /* result DP_OK: a batch follows, then groups and their names */
    dp_batch batch;
    uint32_t group_count, text_size;
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

/* ------- the child ------- */

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

static void send_model(const char *path, int to) {
    array arrays[ARRAYS];
    head h = {.group_count = 0};
    dp_source *source = NULL;
    dp_result result = dp_io_open(path, NULL, &source, &h.diag);
    if (!result) result = dp_source_next(source, &h.batch, &h.diag);
    h.diag.result = result;
    if (result) {
        send_bytes(to, &h, sizeof h);
        return;
    }
    copy_remark(h.remark, dp_source_remark(source));
    copy_remark(h.color_remark, dp_source_color_remark(source));
    count_groups(&h, source);
    bool sent = send_bytes(to, &h, sizeof h) && send_groups(to, &h, source);
    list_arrays(&h.batch, arrays);
    for (int k = 0; k < ARRAYS && sent; k++)
        if (array_of(&h.batch, &arrays[k]))
            sent = send_bytes(to, array_of(&h.batch, &arrays[k]), arrays[k].bytes);
}

/* Sanitizers reserve more address space than any limit allows, and their reports must be seen. */
#if defined __SANITIZE_ADDRESS__ || defined __SANITIZE_THREAD__
#define SANITIZED 1
#elif defined __has_feature
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) ||                         \
    __has_feature(memory_sanitizer)
#define SANITIZED 1
#endif
#endif
#ifndef SANITIZED
#define SANITIZED 0
#endif

static void limit(int resource, double most) {
    struct rlimit now;
    if (getrlimit(resource, &now)) return;
    if (now.rlim_max == RLIM_INFINITY || most < (double)now.rlim_max)
        now.rlim_cur = now.rlim_max = (rlim_t)most;
    setrlimit(resource, &now);
}

/* Memory: far more than any sound file of this size takes, and no more than the machine has. Text in
 * an archive (3MF) takes about 100 times its size; the 8 GB are for scenes whose arrays are in other
 * files (glTF). */
static void limit_child(double bytes, double seconds) {
    const double machine = (double)sysconf(_SC_PHYS_PAGES) * (double)sysconf(_SC_PAGESIZE);
    const double most = 8.0 * (1 << 30) + 100 * bytes;
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_CPU, 2 * seconds + 1); /* should the parent be gone */
    if (SANITIZED) return;
    limit(RLIMIT_AS, machine > 0 && machine < most ? machine : most);
    const int nowhere = open("/dev/null", O_WRONLY); /* what Assimp and the C library print */
    if (nowhere < 0) return;
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
}

/* ------- the parent: a source of what was received ------- */

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

/* ------- the parent: receiving ------- */

typedef struct channel {
    int from;
    double deadline; /* s, of the monotonic clock */
    bool late, full; /* the deadline is over; no memory is left */
} channel;

static double now(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Waits for bytes, and moves the progress bar. False after the deadline. */
static bool wait_for_bytes(channel *c) {
    struct pollfd ready = {.fd = c->from, .events = POLLIN};
    while (poll(&ready, 1, 100 /* ms */) <= 0) {
        progress_report(NULL, -1);
        c->late = now() > c->deadline;
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
    if (whole && r->h.diag.result) return r;
    if (!whole) r->h.batch = (dp_batch){0};
    r->h.remark[REMARK - 1] = r->h.color_remark[REMARK - 1] = 0;
    if (whole && receive_arrays(c, r)) return r;
    received_destroy(r);
    return NULL;
}

/* ------- both ------- */

static dp_result fail(dp_diag *diag, const char *path, const char *what) {
    const char *const slash = strrchr(path, '/'), *const dot = strrchr(slash ? slash : path, '.');
    *diag = (dp_diag){.result = DP_ERR_FORMAT};
    snprintf(diag->message, sizeof diag->message, "Assimp's reader of %.20s files %s",
             dot ? dot : "such", what);
    return DP_ERR_FORMAT;
}

/* Says why the child has sent nothing whole. */
static dp_result fail_by_status(dp_diag *diag, const char *path, int status) {
    char text[120];
    if (!WIFSIGNALED(status))
        return fail(diag, path, "gave up on it: export it again, or as STL, PLY, OBJ or OFF");
    snprintf(text, sizeof text, "crashed on it (%s): export it again, or as STL, PLY, OBJ or OFF",
             strsignal(WTERMSIG(status)));
    return fail(diag, path, text);
}

static dp_result fail_late(dp_diag *diag, const char *path, double seconds) {
    char text[120];
    snprintf(text, sizeof text,
             "was not done after %g s: give it more with --read-time, or convert the file",
             seconds);
    return fail(diag, path, text);
}

static dp_result make_source(received *r, dp_source **out, dp_diag *diag) {
    const dp_source_callbacks callbacks = {.user = r,
                                           .next = received_next,
                                           .rewind = received_rewind,
                                           .destroy = received_destroy,
                                           .group_name = received_name,
                                           .group_color = received_color,
                                           .remark = received_remark,
                                           .color_remark = received_color_remark};
    dp_result result = r->h.diag.result;
    if (result)
        *diag = r->h.diag, r->h.batch = (dp_batch){0};
    else
        result = dp_source_from_callbacks(&callbacks, NULL, out, diag);
    if (result) received_destroy(r);
    return result;
}

static void run_child(const char *path, int to, pid_t parent, double bytes, double seconds) {
#ifdef __linux__
    prctl(PR_SET_PDEATHSIG, SIGKILL); /* whatever ends the parent */
#endif
    if (getppid() != parent) _exit(1);
    limit_child(bytes, seconds);
    send_model(path, to);
    _exit(0);
}

dp_result open_apart(const char *path, double seconds, dp_source **out, dp_diag *diag) {
    struct stat file;
    int ends[2];
    const double bytes = stat(path, &file) ? 0 : (double)file.st_size;
    const pid_t parent = getpid();
    if (!(seconds > 0)) seconds = 60 + (double)(size_t)(bytes / 1e6);
    if (pipe(ends)) return dp_io_open(path, NULL, out, diag);
    const pid_t child = fork();
    if (child == 0) {
        close(ends[0]);
        run_child(path, ends[1], parent, bytes, seconds);
    }
    close(ends[1]);
    if (child < 0) {
        close(ends[0]);
        return dp_io_open(path, NULL, out, diag);
    }
    interrupt_also(child);
    channel c = {.from = ends[0], .deadline = now() + seconds};
    received *const r = receive_model(&c);
    close(ends[0]);
    if (!r) kill(child, SIGKILL);
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    interrupt_also(0);
    if (r) return make_source(r, out, diag);
    if (c.late) return fail_late(diag, path, seconds);
    if (!c.full) return fail_by_status(diag, path, status);
    *diag = (dp_diag){.result = DP_ERR_MEMORY, .message = "out of memory for the model"};
    return DP_ERR_MEMORY;
}
