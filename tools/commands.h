/* The commands, and what they share. */
#ifndef TOOL_COMMANDS_H
#define TOOL_COMMANDS_H

#include "options.h"

/* Each returns the program's exit code. */
int command_draw(const tool_settings *s);
int command_info(const tool_settings *s);
int command_make(const tool_settings *s);
int command_bench(const tool_settings *s);
/* Runs the viewer, a program of its own, with the words after "drypoint view", before which there is room for one more.
 * Returns only if that cannot be. */
int view_run(char **words);

/* Draws all models as one scene. */
int draw_scene(const tool_settings *s);

/* Opens all models as one scene: files, standard input ("-") or generated ones
 * ("shape:NAME[:TRIANGLES]"). 0, or the exit code after a message. */
int open_model(const tool_settings *s, dp_source **out);
/* Opens a model's file, or standard input. */
dp_result open_file(const tool_settings *s, const char *model, dp_source **out, dp_diag *diag);
/* Reports a failure of the open model; the exit code. */
int report_model(const tool_settings *s, const dp_diag *diag);
/* Warns of something about this run's model, which is named if others come before or after. */
void warn_of_model(const tool_settings *s, const char *text);
/* What is known of a model when it has been read. */
typedef struct measured {
    dp_extent extent; /* of the model, and of a mirror beside it */
    dp_extent beside; /* of that mirror; min and max all 0: there is none */
    dp_camera fitted; /* to what is drawn, for a picture of this */
    double aspect;    /* width / height; 0: it is not fitted yet */
} measured;

/* Reads the model once. 0, or the exit code after a message, also when there is nothing to see. */
int measure_model(const tool_settings *s, dp_source *source, measured *model);
/* Warns if the model lies so far from 0 that its float32 coordinates no longer tell its shape. */
void warn_coarse(const tool_settings *s, const dp_extent *extent);

/* The camera of the settings, for a picture of that width / height. Reads the model again unless it
 * was measured for that. 0, or the exit code after a message. */
int make_camera(const tool_settings *s, dp_source *source, const measured *model, double aspect,
                dp_camera *camera);
/* The width / height of which a camera is asked first, and whether it is one that is fitted. */
double first_aspect(const tool_settings *s);
bool is_camera_fitted(const tool_settings *s);
/* Fits a camera to what is drawn of the model; *extent, unless NULL, becomes its extent. */
dp_result fit_camera(const tool_settings *s, dp_source *source, const dp_extent *beside,
                     double aspect, dp_camera *camera, dp_extent *extent, dp_diag *diag);
/* All but the lines' widths, which the page says (page.h). */
dp_style make_style(const tool_settings *s);
/* Fills style->stroke; the caller destroys *texture. 0, or the exit code after a message. */
struct page_plan;
int make_stroke(const tool_settings *s, const struct page_plan *plan, dp_style *style,
                dp_texture **texture);
/* The target's size and samples; no planes yet. */
dp_target make_target(const tool_settings *s);

/* Prints the statistics of a frame. */
void print_stats_table(FILE *out, const tool_settings *s, const dp_stats *stats);
void print_stats_json(FILE *out, const tool_settings *s, const dp_stats *stats,
                      const dp_target *target);
/* Warns of dropped polygons, counted by cause, if it matters: of bad ones, or of many without area. */
void warn_dropped(const tool_settings *s, const dp_stats *stats);
/* Warns that lines may be missing, if not all edges were followed. */
void warn_lost(const tool_settings *s, const dp_stats *stats);
/* Says of a file that no line is in it. */
void tell_empty(const char *file);

#endif
