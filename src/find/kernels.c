/* The kernels of src/find at the width DP_LANES; compiled once for each width (CMakeLists.txt). */
#include "find/kernels.h"

#include "find/finder.h"
#include "core/precision.h"
#include "base/lanes.h"
#include "raster/kernels.h"

#include "core/ld3.inc"
#include "raster/hidden_boxes.inc"
#include "raster/polygon_words.inc"
#include "find/one_rings.inc"
#include "find/edges.inc"
#include "find/folds.inc"
#include "find/points.inc"
#include "find/meet.inc"
#include "find/look.inc"
#include "find/hide.inc"

const dp_find_kernels DP_KERNEL_TABLE(dp_find_kernels) = {
    .list_edges = list_edges,
    .flatten = flatten,
    .unmark_alone = unmark_alone,
    .folds = folds,
    .points = points,
    .show_backs = show_backs,
    .come_near = come_near,
    .meet = meet,
    .shapes = shapes,
    .look = look,
    .hide = hide,
    .list_hiders = list_hiders,
};
