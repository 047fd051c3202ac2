/* drypoint/section.h: models cut open by planes.
 *
 * A clip plane takes away what lies beyond it, on the side that its normal points to:
 *
 *                  taken away        ^ normal (0, 1, 0)
 *         - - - - - - - - - - - - - -|- - - - - - -  n·p = offset
 *              ######        ######                  section: what was cut through is filled
 *              ######        ######
 *              ####################                  what lies below is kept: n·p <= offset
 *
 *     dp_clip clip = {.planes = {{{0, 1, 0}, 0.5}}, .plane_count = 1};
 *     dp_source_clip(model, &clip, NULL, &opened, &diag);
 *
 * So the normal points to the eye that is to look into the model. Polygons are cut exactly; those that
 * no plane meets go through as they are. Where a closed surface was cut, a section's face closes it: its
 * outline is a line of class DP_LINE_SECTION, its hatching lines of DP_LINE_HATCHING (style.h), its
 * colour dp_style.section. Each group has faces of its own, and where parts touch both have an outline.
 * Not here: what is hidden or drawn as x-ray, and sections of models drawn smooth or streamed
 * (DP_ERR_UNSUPPORTED when they are drawn). */
#ifndef DRYPOINT_SECTION_H
#define DRYPOINT_SECTION_H

#include <drypoint/source.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { DP_CLIP_PLANES = 8 /* the most */ };

/* Keeps n·p <= offset, n being the normal's unit vector, p in world space. */
typedef struct dp_clip_plane {
    double normal[3]; /* any length above 0 */
    double offset;    /* world units along the unit normal */
} dp_clip_plane;

/* What a section's faces show. */
typedef enum dp_section_look {
    DP_SECTION_HATCHED = 0, /* parallel lines (ISO 128-50) */
    DP_SECTION_CROSSED,     /* two sets of them, at right angles */
    DP_SECTION_PLAIN,       /* their colour alone */
    DP_SECTION_OPEN         /* no faces: one looks into the hollow model; outlines only */
} dp_section_look;

/* Zero is the default: no plane, which changes nothing. */
typedef struct dp_clip {
    dp_clip_plane planes[DP_CLIP_PLANES];
    uint32_t plane_count; /* 0 to DP_CLIP_PLANES */
    dp_section_look look;
    /* Degrees from the horizontal of the section, counter-clockwise for who looks against the plane's
     * normal; what is up is the source's (dp_source_up). 0 means 45. Every second group has its
     * lines at right angles to that, further ones at other distances, so that parts are told apart; a
     * group has the same ones in all sections. */
    double hatch_angle;
    /* Between two lines, world units; 0 means `hatch_share`. Not less than 1/2000 of the diagonal. */
    double hatch_spacing;
    double hatch_share; /* of the diagonal of the kept part's box; 0 means 1/60; at most 1 */
} dp_clip;

/* Makes a source of what the planes leave of another. Whenever it is read, the inner source is read
 * and cut anew; section faces and their lines come in the last batch, in triangles about the first
 * one's origin. What lies on a plane is kept. Gaps in a cut outline are closed where they are small
 * against it (a tenth of what they join); what stays open is a line, and nothing is filled there.
 * Interiors are what outlines run around (winding number not zero).
 *
 * On success it owns `inner`, and the caller destroys only *out; on failure `inner` remains the
 * caller's. DP_ERR_ARGUMENT for a normal that is zero or not finite, too many planes, or numbers out
 * of range; DP_ERR_MEMORY. Reading it is DP_ERR_ARGUMENT, too, at the end of a model of which the
 * planes leave nothing; once its time was set it is empty then. Where they take nothing away,
 * dp_source_remark says so. */
DP_API dp_result dp_source_clip(dp_source *inner, const dp_clip *clip,
                                const dp_allocator *allocator, dp_source **out, dp_diag *diag);

#ifdef __cplusplus
}
#endif
#endif
