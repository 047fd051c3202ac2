/* The order in which a pen draws the paths. */
#include "vector/clean.h"

bool dp_order_paths(dp_drawing *d, bool optimize) {
    (void)d;
    (void)optimize;
    return true;
}
