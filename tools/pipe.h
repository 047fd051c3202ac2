/* A pipe between two processes: bytes in, bytes out, until a deadline. */
#ifndef TOOL_PIPE_H
#define TOOL_PIPE_H

#include <stdbool.h>
#include <stddef.h>

/* False: nobody reads any more. */
bool pipe_send(int to, const void *bytes, size_t count);

/* The end that receives. What it has received in blocks is its own until pipe_free. */
typedef struct pipe_end {
    int from;
    double deadline; /* s, of pipe_clock */
    bool late, full; /* the deadline is over; no memory is left */
    void **blocks;   /* [block_count] */
    size_t block_count, block_room;
} pipe_end;

double pipe_clock(void); /* s */

/* Receives count bytes, and moves the progress bar meanwhile. False: they do not come whole. */
bool pipe_receive(pipe_end *end, void *bytes, size_t count);
/* Receives count items of a size as a block, with a 0 behind it, which takes at most about twice the
 * memory of what comes. NULL: they do not come whole. */
void *pipe_receive_block(pipe_end *end, size_t count, size_t size);
/* Frees all blocks. */
void pipe_free(pipe_end *end);

#endif
