/* drypoint/deform.h: meshes whose vertices move: waving flags, breathing chests, vertex morphing.
 *
 * A deformed source hands out another's polygons with their vertices elsewhere: where an
 * application's function puts them (the vertex shader of Raskar 2001, 1.2), or one of the library's
 * own. Lines are found anew in each picture, and follow:
 *
 *     const dp_deform flag = {.kind = DP_DEFORM_WAVE, .amplitude = 0.1};
 *     dp_source_deform(cloth, &flag, NULL, &source, &diag);
 *     for (int frame = 0; frame < 50; frame++) {
 *         dp_source_set_time(source, frame / 25.0, &diag);
 *         dp_draw(context, source, &camera, &style, &target, &diag);
 *     }
 *
 * Nothing is kept from frame to frame but arrays of the same size. A source of one stable batch is
 * deformed as a whole, with the context's threads, and drawn where it lies then; others are deformed
 * batch by batch. Vertices move, nothing else does: polygons keep their corners, groups, colours and
 * texture coordinates. Vertices at one position stay at one position, but a vertex that only touches
 * another polygon's edge may leave it. Where polygons themselves are others from frame to frame, give
 * a source of your own with dp_source_callbacks.set_time. */
#ifndef DRYPOINT_DEFORM_H
#define DRYPOINT_DEFORM_H

#include <drypoint/source.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Some of a source's vertices, to be moved. */
typedef struct dp_vertex_run {
    double time;            /* s, as in dp_source_set_time */
    const double *origin;   /* [3] world space = origin + position, before and after */
    uint64_t first;         /* number of the first vertex; they are counted through all batches */
    size_t count;           /* at least 1 */
    const float *positions; /* x, y, z of vertex i at (const char *)positions + i * stride */
    size_t stride;          /* bytes */
    float (*moved)[3];      /* [count] to be written: the new positions */
    float (*normals)[3];    /* [count] to be written, any length, 0: none; NULL unless
                               dp_deform.normals */
} dp_vertex_run;

/* Moves the vertices of a run. Called from several threads at once, with runs of any length, in any
 * order, and again for each reading of the source: what it writes must depend only on the run and on
 * `user`. A vertex that is not finite is allowed: its polygons are dropped and counted (dp_stats). */
typedef void dp_vertex_function(void *user, const dp_vertex_run *run);

typedef enum dp_deform_kind {
    DP_DEFORM_WAVE =
        0,             /* a flag: waves run along `axis`, from its low end, which is fixed, and move
                           the vertices sideways, along `across` */
    DP_DEFORM_BREATHE, /* a chest: swells away from a line along `axis`, and sinks */
    DP_DEFORM_TWIST    /* turned around a line along `axis`, from its low end on */
} dp_deform_kind;

/* How a source is deformed. 0 is a default throughout; shares are of the model's extent along `axis`,
 * which is measured once, when the source is made. u below runs from 0 at the model's low end of the
 * axis to 1 at the high end, t is the time, s. */
typedef struct dp_deform {
    dp_vertex_function *vertices; /* the application's own; then only `user` and `normals` count.
                                     NULL: `kind` */
    void *user;
    bool normals; /* `vertices` writes normals, which then are the corners'. Otherwise the polygons
                     have none, and shading makes them from the moved positions: those of the model
                     would be wrong */

    dp_deform_kind kind;
    /* wave: how far to either side, a share, at most 10; 0: 0.08. v = u (2 - u) times that is reached,
     * so that the fixed end (u = 0) stays: p + across * v * amplitude * sin(2 pi (w / length - speed t)),
     * w = u + slant * (how far p is beside the box's centre, along across x axis, such a share)
     * breathe: by what share it swells, -1 to 10; 0: 0.08. A vertex is 1 + amplitude * bump *
     * sin(2 pi speed t) times as far from the line through the box's centre; bump = (1 - h^2)^2 where
     * h = (u - at) / length is within -1 and 1
     * twist: by what angle at the high end, degrees, at most 36000; 0: 90. The angle is amplitude *
     * min(u / length, 1) * cos(2 pi speed t), right-handed around the line through the box's centre */
    double amplitude;
    double length; /* a share, 0.001 to 1000. Of a wave: from crest to crest; 0: 0.6. breathe: how
                         far the swelling reaches to either side; 0: 0.5. twist: over what it grows;
                         0: 1 */
    double speed; /* 1/s, within 1e6 of 0. wave: waves that pass; below 0 they run towards the fixed
                         end; 0: 1. breathe: breaths; 0: 0.25. twist: swings; 0: it stands */
    double axis[3];   /* a direction, any length; 0: along the box's longest side */
    double across[3]; /* of waves: which way they move, any length; 0: along the shortest side other
                         than the axis */
    double
        slant; /* of waves: by how much crests lean, as a tangent, -10 to 10; 0: they are upright */
    double at; /* breathe: where it swells most, u, -100 to 100; 0: 0.5 */
} dp_deform;

/* Makes a source of another one's polygons with moved vertices; `deform` is copied. Its time is set by
 * dp_source_set_time, and is passed on to `source` first. On success it owns `source`, and the caller
 * destroys only *out; on failure `source` remains the caller's. One of the library's own functions
 * reads the source once, to measure it. DP_ERR_ARGUMENT for a number out of range (the message says
 * which), DP_ERR_UNSUPPORTED where a source that must be measured can be read only once,
 * DP_ERR_MEMORY; errors of the source. */
DP_API dp_result dp_source_deform(dp_source *source, const dp_deform *deform,
                                  const dp_allocator *allocator, dp_source **out, dp_diag *diag);

/* How a source is deformed, with all defaults filled in and directions of length 1; borrowed. NULL
 * for any other source. */
DP_API const dp_deform *dp_deform_of(const dp_source *source);

/* Vertex morphing. */
typedef struct dp_morph {
    double blend;   /* 0: the first model, 1: the second; beyond, their difference is exaggerated.
                       Within 1000 of 0 */
    double seconds; /* how long the first takes to become the second: blend + time / seconds, kept
                       between 0 and 1, is the blend then, and dp_source_duration the rest of it. 0:
                       the blend is `blend` at any time */
} dp_morph;

/* Makes a source of the first source's polygons, whose vertices lie between those of two sources:
 * (1 - blend) a + blend b, in double precision; NULL for `morph` means a blend of 0. Both must have
 * the same number of batches, vertices and polygons, and the same corners, in the same order; what
 * else polygons have is the first one's, but normals, which shading makes anew. On success *out owns
 * both sources, on failure they remain the caller's. The time is passed on to both.
 * DP_ERR_FORMAT where they are of different topology (the message says how they differ);
 * DP_ERR_ARGUMENT, DP_ERR_MEMORY; DP_ERR_UNSUPPORTED where one can be read only once; errors of the
 * sources. */
DP_API dp_result dp_source_morph(dp_source *a, dp_source *b, const dp_morph *morph,
                                 const dp_allocator *allocator, dp_source **out, dp_diag *diag);

/* Changes what a source made by dp_source_morph was made with, from the next reading on.
 * DP_ERR_ARGUMENT for a number out of range, or any other source. */
DP_API dp_result dp_morph_set(dp_source *source, const dp_morph *morph, dp_diag *diag);

#ifdef __cplusplus
}
#endif
#endif
