/* drypoint/objects.h: a model's groups as objects: what each holds, which are shown, where they stand.
 *
 *     dp_group groups[16];
 *     dp_placement places[16] = {{0}};
 *     uint32_t count;
 *     dp_source_groups(source, groups, 16, &count, &diag);
 *     places[2].hidden = true;
 *     dp_source_explode(source, groups, count, &(dp_explosion){.factor = 1}, places, &diag);
 *     dp_source_arrange(source, places, count, NULL, &arranged, &diag);
 *
 * Names and colours of groups: dp_source_group_name, dp_source_group_color. A style for each:
 * dp_draw_grouped (draw.h). Polygons without groups are all of group 0, however many pieces they are. */
#ifndef DRYPOINT_OBJECTS_H
#define DRYPOINT_OBJECTS_H

#include <drypoint/source.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What a group holds. */
typedef struct dp_group {
    uint64_t polygons;     /* all of it */
    double min[3], max[3]; /* world space; of the finite corners that its polygons use. Where there
                              are none, min is INFINITY and max -INFINITY */
} dp_group;

/* Reads a source as dp_source_extent does, and fills in groups[0, most); what belongs to groups from
 * `most` on is not told. *count becomes 1 + the highest number of a group that has polygons; more than
 * `most` where there are more. Names and colours of all groups are known then. DP_ERR_ARGUMENT; errors
 * of the source. */
DP_API dp_result dp_source_groups(dp_source *source, dp_group *groups, uint32_t most,
                                  uint32_t *count, dp_diag *diag);

/* Where a group stands. Zero: where it is in the model. */
typedef struct dp_placement {
    bool hidden;      /* it is left out, as if its polygons were not there */
    double offset[3]; /* world units by which it is moved */
} dp_placement;

/* Makes a source of another, some of whose groups are left out or moved: placements[g] (copied) says
 * how group g stands; groups from `count` on stay as they are. Groups keep their numbers, names and
 * colours; batches their origins, and with them the precision of their positions. A batch of which
 * nothing changes is handed on as it is, stable ones too; others come as changed copies, batch by
 * batch, in memory that is kept from reading to reading. Polygons are counted without those left out
 * (dp_segment.polygon).
 *
 * On success the new source owns `source`, and the caller destroys only *out; on failure it remains the
 * caller's. DP_ERR_ARGUMENT where an offset is not finite; DP_ERR_LIMIT for more than 65536
 * placements, DP_ERR_MEMORY. */
DP_API dp_result dp_source_arrange(dp_source *source, const dp_placement *placements,
                                   uint32_t count, const dp_allocator *allocator, dp_source **out,
                                   dp_diag *diag);

/* How an assembly is pulled apart. */
typedef struct dp_explosion {
    double factor;  /* of the distances from the assembly's centre: 0 moves nothing, 1 doubles them,
                       -1 would bring all parts to the centre; finite */
    double axis[3]; /* any length: parts move along this direction alone; 0: in all directions */
} dp_explosion;

/* Adds to placements[g].offset what moves group g away from the assembly's centre, as illustrators do to
 * show what it consists of: `factor` times the way from there to the centre of the part that the group
 * belongs to. Both are centres of bounding boxes along the axes, of all groups, hidden ones too, so
 * that parts stand where they did when others are left out.
 *
 * Parts are the sources of a scene (dp_source_join), else what the groups' names tell: groups are one
 * part whose names begin alike, up to the first / behind what all names have in common ("bolt/steel" and
 * "bolt/brass"; "car/wheel/rim" and "car/wheel/tyre" beside "car/door"). A group without a name is a part.
 *
 * groups, count: from dp_source_groups of the same source. DP_ERR_ARGUMENT, DP_ERR_MEMORY. */
DP_API dp_result dp_source_explode(const dp_source *source, const dp_group *groups, uint32_t count,
                                   const dp_explosion *explosion, dp_placement *placements,
                                   dp_diag *diag);

#ifdef __cplusplus
}
#endif
#endif
