/* What the files of a streamed drawing share. */
#ifndef DP_STREAM_DRAW_H
#define DP_STREAM_DRAW_H

#include "core/fold.h"
#include "stream/input.h"
#include "stream/pending.h"
#include "stream/stream.h"

/* A chunk's output. */
typedef struct dp_chunk_output {
    /* Triangles that may cover samples (or wanted pixels). */
    float (*corners)[9]; /* [DP_CHUNK] */
    uint32_t *numbers;   /* [DP_CHUNK] in the stream */
    uint32_t covering;   /* how many */
    uint32_t first;      /* their place in the stream's list */

    /* Pending triangles, or (second reading) intersection candidates. */
    size_t pending_first;         /* their place in stream->pending */
    dp_pending_triangle *pending; /* [DP_CHUNK] */
    uint32_t pending_count;
    uint32_t *pixels; /* [DP_CHUNK] of the intersection candidates: where they are counted */
    size_t corners_cap, numbers_cap, pending_cap, pixels_cap;
    dp_result result;
    dp_diag diag;
} dp_chunk_output;

/* False when memory is out; then too it is to be freed (readings.c). */
bool dp_chunk_output_init(dp_chunk_output *output, const dp_allocator *memory);
void dp_chunk_output_free(dp_chunk_output *output, const dp_allocator *memory);
uint64_t dp_chunk_output_bytes(const dp_chunk_output *output);

/* Edges that are thought to be lines (fans.c). Zero is empty. */
typedef struct dp_fan dp_fan;
typedef struct dp_fan_table {
    dp_fan *fans;
    uint32_t *slots;  /* [slot_count] 1 + fan, 0: free */
    uint64_t *filter; /* [filter_bits / 64] the bits of their edges' keys are set (chunk.h) */
    size_t fans_cap, slots_cap, filter_cap;
    uint32_t count, slot_count, filter_bits;
} dp_fan_table;

void dp_fan_table_free(dp_fan_table *table, const dp_allocator *memory);
uint64_t dp_fan_table_bytes(const dp_fan_table *table);

/* A triangle of the second reading that has a candidate's edge. */
typedef struct dp_partner {
    uint32_t fan, number;
    float corner[3]; /* not on the edge */
    float triangle[9];
} dp_partner;

/* Scratch of one worker. */
typedef struct dp_stream_worker {
    dp_chunk *chunk;
    uint8_t *buffer; /* of a chunk's records */
    size_t buffer_cap;
    dp_pending_triangle *intersecting; /* one pass: triangles that cross others */
    size_t intersecting_cap, intersecting_count;
    dp_partner *partners; /* of the current part */
    size_t partners_cap, partner_count;
    float *depth; /* of a tile's samples, while others may read those of the picture */
    size_t depth_cap;
    uint32_t (*owners)[2]; /* of a tile's candidates */
    size_t owners_cap;
    dp_stats stats;
    bool failed;
} dp_stream_worker;

/* As dp_chunk_output_… (readings.c). */
bool dp_stream_worker_init(dp_stream_worker *worker, const dp_input *input,
                           const dp_allocator *memory);
void dp_stream_worker_free(dp_stream_worker *worker, const dp_allocator *memory);
uint64_t dp_stream_worker_bytes(const dp_stream_worker *worker);

/* A tile's lines while the source is read again. */
typedef struct dp_tile_lines {
    dp_candidate *candidates; /* one block of memory with the probes */
    dp_probes probes;
    uint32_t candidate_count, probe_count;
    size_t size; /* bytes of the block; 0: it is another's */
} dp_tile_lines;

/* Room for so many, in one block of memory; false when that is out (tiles.c). */
bool dp_tile_lines_make(dp_tile_lines *lines, uint32_t candidates, uint32_t probes,
                        const dp_allocator *memory);
void dp_tile_lines_free(dp_tile_lines *lines, const dp_allocator *memory);
/* Puts the tile's own there, as candidates and probes from those numbers on. */
void dp_tile_lines_put(const dp_tile_lines *from, dp_tile_lines *to, uint32_t candidate,
                       uint32_t probe);

struct dp_stream_draw {
    dp_frame *frame; /* the next four as in dp_stream_setup */
    dp_finder *finders;
    dp_bin_worker *bin_workers;
    dp_stats *stats;
    dp_stream_setup setup;
    uint32_t worker_count;
    const dp_allocator *memory;
    dp_input input;
    dp_chunk_view view;
    dp_stream_worker *workers; /* [worker_count] */
    size_t workers_cap;

    dp_chunk_output *outputs; /* [chunks] of the part at hand */
    size_t outputs_cap;
    uint32_t chunks;
    float (*corners)[9]; /* triangles to be drawn next; [part] */
    uint32_t *numbers;   /* theirs */
    size_t corners_cap, numbers_cap;
    uint32_t covering; /* how many */

    dp_pending pending;
    size_t joined;    /* pending triangles whose edges have met; others came with the last part */
    float *positions; /* of frame->polygons, and so the next three */
    uint8_t *edge_flags;
    uint32_t *polygon_numbers, *source_polygons;
    size_t positions_cap, flags_cap, polygon_numbers_cap, source_cap;
    uint32_t mesh_count; /* polygons: what is kept, then the intersection candidates */

    dp_pending_triangle *intersecting; /* the intersection candidates; numbers ascend */
    size_t intersecting_cap, intersecting_count, intersecting_limit;
    uint64_t *away; /* [tile][tile_samples / 64] a bit per sample: it shows a back face */
    uint64_t (*candidate_pixels)[2][DP_TILE]; /* by tile, as in dp_finder */
    uint64_t *flagged;                        /* dp_chunk_view */
    uint8_t *intersecting_counts; /* [tile][DP_TILE][DP_TILE] triangles of the intersection
                                     candidates that begin in a pixel */
    size_t away_cap, candidate_pixels_cap, flagged_cap, intersecting_counts_cap;
    dp_fan_table fans;

    float *farthest; /* dp_chunk_view */
    uint64_t *wanted;
    dp_tile_lines *lines; /* by tile */
    size_t farthest_cap, wanted_cap, lines_cap;
    uint64_t triangles; /* in the stream */
    bool read_again;
    bool thinned;        /* too many lines: some were left out */
    bool waited_in_vain; /* waiting edges were given up */
    double done;         /* share of the work, for progress */
};

/* What a reading is for. */
typedef enum dp_reading {
    DP_READ_FACES = 0, /* faces are drawn and edges meet */
    DP_READ_EDGES,     /* edges of another share meet (pending.h) */
    DP_READ_HIDERS     /* triangles hide sample points */
} dp_reading;

/* One reading, from the start of the source (readings.c). Progress goes from `from` to `to`. Only
 * the first reading counts in the setup's statistics. */
dp_result dp_stream_read(dp_stream_draw *stream, dp_reading reading, double from, double to,
                         dp_diag *diag);

/* Draw the list, as faces or as what hides sample points, and empty it (tiles.c). False when memory
 * is out. */
bool dp_stream_draw_faces(dp_stream_draw *stream);
bool dp_stream_hide_probes(dp_stream_draw *stream);

/* After the first reading: the target's surface, and the lines of the pending triangles. If there
 * is no second reading, depth samples hide the lines' sample points (samples.c). */
bool dp_stream_find_lines(dp_stream_draw *stream);
void dp_stream_hide_by_samples(dp_finder *worker);
/* Appends triangles to frame->polygons; false when memory is out. */
bool dp_stream_add_polygons(dp_stream_draw *stream, const dp_pending_triangle *triangles,
                            size_t count);

/* Intersections (crossings.c): after a list is drawn in a tile; after the first reading; at the
 * end. False when memory is out. */
void dp_stream_note_candidate_pixels(dp_stream_draw *stream, dp_finder *worker,
                                     dp_stream_worker *own);
bool dp_stream_choose_flagged(dp_stream_draw *stream);
bool dp_stream_find_crossings(dp_stream_draw *stream);

/* Edges of more than two triangles (fans.c).
 *     make_fans      makes the table of candidates' edges
 *     look_for_fans  looks there for a triangle's edge from a to b; c is its third corner
 *     join_fans      takes in what was found in a part
 *     settle_fans    decides about a tile's lines */
bool dp_stream_make_fans(dp_stream_draw *stream);
void dp_stream_look_for_fans(const dp_stream_draw *stream, const float *a, const float *b,
                             const float *c, const float *triangle, uint32_t number,
                             dp_stream_worker *own);
/* May an edge be in the table? False is sure. */
static inline bool dp_stream_may_be_fan(const dp_stream_draw *stream, uint32_t edge_key) {
    const uint32_t bit = edge_key & (stream->fans.filter_bits - 1);
    return stream->fans.filter[bit / 64] >> bit % 64 & 1;
}
bool dp_stream_join_fans(dp_stream_draw *stream);
void dp_stream_settle_fans(const dp_stream_draw *stream, dp_tile_lines *lines);

/* From now on the tile draws into depth of the worker's own, whatever that holds, and not into the
 * picture's (tiles.c). False when memory is out. */
bool dp_stream_draw_apart(const dp_stream_draw *stream, dp_finder *worker, dp_stream_worker *own);

/* place_polygons transforms and bins frame->polygons; for_tiles runs a task over all tiles
 * (tiles.c). False when memory is out. */
bool dp_stream_place_polygons(dp_stream_draw *stream);
bool dp_stream_for_tiles(dp_stream_draw *stream, dp_task *task);

/* At the end: collects the visible pieces in the finders. False when memory is out. */
bool dp_stream_collect(dp_stream_draw *stream);

#endif
