/* Sends and receives bytes through a pipe; and keeps what is received in a list of blocks, so that
 * giving up frees all. */
#include "pipe.h"

#include "progress.h"

#include <errno.h>
#include <poll.h>
#include <stdint.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

bool pipe_send(int to, const void *bytes, size_t count) {
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

double pipe_clock(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Waits for bytes, and moves the progress bar. False after the deadline. */
static bool wait_for_bytes(pipe_end *end) {
    struct pollfd ready = {.fd = end->from, .events = POLLIN};
    while (poll(&ready, 1, 100 /* ms */) <= 0) {
        progress_report(NULL, -1);
        end->late = pipe_clock() > end->deadline;
        if (end->late) return false;
    }
    return true;
}

bool pipe_receive(pipe_end *end, void *bytes, size_t count) {
    char *p = bytes;
    while (count) {
        if (!wait_for_bytes(end)) return false;
        const ssize_t got = read(end->from, p, count);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return false;
        p += got;
        count -= (size_t)got;
    }
    return true;
}

static bool make_room(pipe_end *end) {
    if (end->block_count < end->block_room) return true;
    const size_t room = 2 * end->block_room + 64;
    void **const longer = realloc(end->blocks, room * sizeof *longer);
    if (!longer) return false;
    end->blocks = longer;
    end->block_room = room;
    return true;
}

void *pipe_take_block(pipe_end *end, size_t count, size_t size) {
    const bool fits = !count || size < PTRDIFF_MAX / count;
    char *const block = fits && make_room(end) ? calloc(1, count * size + 1) : NULL;
    end->full |= !block;
    if (block) end->blocks[end->block_count++] = block;
    return block;
}

void *pipe_receive_block(pipe_end *end, size_t count, size_t size) {
    char *const block = pipe_take_block(end, count, size);
    return block && pipe_receive(end, block, count * size) ? block : NULL;
}

void pipe_free(pipe_end *end) {
    for (size_t k = 0; k < end->block_count; k++) free(end->blocks[k]);
    free(end->blocks);
    end->blocks = NULL;
    end->block_count = end->block_room = 0;
}
