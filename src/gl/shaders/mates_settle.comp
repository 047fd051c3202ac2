// Where more than two half-edges have an edge, all of them learn it: whoever came first.
#define COMPUTE 64
#include "mates.glsl"

void main() {
    uint t = dp_item();
    if (t >= picture.counts.y) return;
    for (uint k = 0u; k < 3u; k++) {
        uint mate = mates[3u * t + k];
        if (is_mate(mate) && mates[mate_of(mate)] == MATE_MANY) mates[3u * t + k] = MATE_MANY;
    }
}
