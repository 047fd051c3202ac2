/* Lines that lie on each other on the screen, drawn once, for strokes with gaps (once.c). */
#ifndef DP_VECTOR_ONCE_H
#define DP_VECTOR_ONCE_H

#include "base/pool.h"
#include "strokes/lines.h"

/* Makes `to` of those parts of `from` that lie on no other; sorts `from`. Scratch comes from the pool.
 * False when memory is out. */
bool dp_lines_once(const dp_frame *frame, dp_lines *from, dp_lines *to, dp_pool *pool);

#endif
