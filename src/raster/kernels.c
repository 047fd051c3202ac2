/* The kernels of src/raster at the width DP_LANES; compiled once for each width
 * (CMakeLists.txt). */
#include "raster/kernels.h"

#include "base/lanes.h"
#include "raster/tile.h"
#include "raster/xray.h"

#include "core/keys.inc"
#include "core/ld3.inc"
#include "core/to_screen.inc"
#include "raster/fetch.inc"
#include "raster/transform.inc"
#include "raster/place.inc"
#include "raster/raster.inc"
#include "raster/hidden_boxes.inc"
#include "raster/cull.inc"
#include "raster/assemble.inc"
#include "raster/normals.inc"
#include "raster/polygon_words.inc"
#include "raster/cross.inc"
#include "raster/layer.inc"

const dp_raster_kernels DP_KERNEL_TABLE(dp_raster_kernels) = {
    .transform = transform,
    .place = place,
    .part = part,
    .assemble = assemble,
    .cull = cull,
    .see = see,
    .raster = raster,
    .normals = normals,
    .cross = cross,
    .layer = layer,
};
