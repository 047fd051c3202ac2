/* Moves a scene (drypoint/scene.h) from one process to another, through a pipe. */
#ifndef TOOL_TRANSFER_SCENE_H
#define TOOL_TRANSFER_SCENE_H

#include "pipe.h"

#include <drypoint/scene.h>

/* False: nobody reads any more. */
bool transfer_send_scene(int to, const dp_scene_desc *desc);

/* Receives what was sent, and makes a source of it. False: it does not come whole; otherwise
 * diag->result tells whether *out is a source. All of it lies in blocks of `end` meanwhile. */
bool transfer_receive_scene(pipe_end *end, dp_source **out, dp_diag *diag);

#endif
