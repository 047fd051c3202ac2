/* Moves a model from one process to another, through a pipe. */
#ifndef TOOL_TRANSFER_H
#define TOOL_TRANSFER_H

#include <drypoint/source.h>

/* Sends a source of one batch, or, if diag->result says so, why there is none. False: nobody reads
 * any more. */
bool transfer_send(int to, dp_source *source, dp_diag *diag);

typedef enum transfer_end {
    TRANSFER_DONE,   /* diag->result tells whether *out is a source */
    TRANSFER_LATE,   /* the deadline came first */
    TRANSFER_FULL,   /* no memory is left */
    TRANSFER_BROKEN, /* the sender has sent nothing whole */
} transfer_end;

/* Receives what was sent, and moves the progress bar meanwhile. deadline: by pipe_clock (pipe.h). */
transfer_end transfer_receive(int from, double deadline, dp_source **out, dp_diag *diag);

#endif
