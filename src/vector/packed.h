/* Bytes packed as PostScript reads them: runs, as printable text (packed.c). */
#ifndef DP_VECTOR_PACKED_H
#define DP_VECTOR_PACKED_H

#include "vector/out.h"

typedef struct dp_packed {
    dp_out *out;
    uint8_t literal[128], repeated;
    int literals, repeats;
    uint32_t four; /* bytes that are to become five characters */
    int fours, column;
} dp_packed;

void dp_packed_put(dp_packed *packed, uint8_t byte);
void dp_packed_end(dp_packed *packed);

#endif
