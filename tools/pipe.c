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

enum { FIRST_ROOM = 1 << 20 /* bytes of a block before more have come */ };

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

/* Makes room for one more in the list of blocks. */
static bool make_room(pipe_end *end) {
    if (end->block_count < end->block_room) return true;
    const size_t room = 2 * end->block_room + 64;
    void **const longer = realloc(end->blocks, room * sizeof *longer);
    end->full |= !longer;
    if (!longer) return false;
    end->blocks = longer;
    end->block_room = room;
    return true;
}

/* Makes a block longer, in its place of the list. False: no memory is left. */
static bool grow_block(pipe_end *end, void **block, size_t bytes) {
    void *const longer = realloc(*block, bytes + 1);
    if (longer) *block = longer;
    end->full |= !longer;
    return longer;
}

void *pipe_receive_block(pipe_end *end, size_t count, size_t size) {
    if (count && size >= PTRDIFF_MAX / count) {
        end->full = true;
        return NULL;
    }
    if (!make_room(end)) return NULL;
    void **const block = &end->blocks[end->block_count++];
    const size_t bytes = count * size;
    size_t got = 0, room = bytes < FIRST_ROOM ? bytes : FIRST_ROOM;
    *block = NULL;
    if (!grow_block(end, block, room)) return NULL;
    while (got < bytes) {
        if (got == room) room = bytes - room < room ? bytes : 2 * room;
        if (!grow_block(end, block, room) || !pipe_receive(end, (char *)*block + got, room - got))
            return NULL;
        got = room;
    }
    ((char *)*block)[bytes] = 0;
    return *block;
}

void pipe_free(pipe_end *end) {
    for (size_t k = 0; k < end->block_count; k++) free(end->blocks[k]);
    free(end->blocks);
    end->blocks = NULL;
    end->block_count = end->block_room = 0;
}
