/* Moves the arrays of a batch through a pipe. */
#ifndef TOOL_TRANSFER_BATCH_H
#define TOOL_TRANSFER_BATCH_H

#include "pipe.h"

#include <drypoint/source.h>

/* Sends a batch's arrays but for edge flags, one after the other. The batch itself is to be sent before:
 * its pointers tell which arrays there are. False: nobody reads any more. */
bool transfer_send_batch(int to, const dp_batch *batch);

/* A batch before it is sent: strides of 0 become tight. */
void transfer_settle_batch(dp_batch *batch);

/* Receives the arrays of a batch that came from the other process, into blocks of `end`. False: they do
 * not come whole, or cannot be right; the batch is empty then. */
bool transfer_receive_batch(pipe_end *end, dp_batch *batch);

#endif
