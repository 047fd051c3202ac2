/* The commands, and what they share. */
#ifndef TOOL_COMMANDS_H
#define TOOL_COMMANDS_H

#include "options.h"

/* Each returns the program's exit code. */
int command_draw(const tool_settings *s);
int command_info(const tool_settings *s);
int command_make(const tool_settings *s);
int command_bench(const tool_settings *s);

/* Opens a file, standard input ("-") or a generated model ("shape:NAME[:TRIANGLES]").
 * 0, or the exit code after a message. */
int open_model(const tool_settings *s, dp_source **out);
/* Its extent; an error when there is nothing to see. */
int measure_model(const tool_settings *s, dp_source *source, dp_extent *extent);

/* What the settings say, for a model of that extent. 0, or the exit code after a message. */
int make_camera(const tool_settings *s, const dp_extent *extent, dp_camera *camera);
dp_style make_style(const tool_settings *s);
/* The style's stroke; a texture is for the caller to destroy. 0, or the exit code after a
 * message. */
int make_stroke(const tool_settings *s, dp_style *style, dp_texture **texture);
/* One that strokes are asked for where lines have none. */
void warn_strokeless(const tool_settings *s, const dp_style *style);
/* Size and samples; no planes yet. */
dp_target make_target(const tool_settings *s);

/* Statistics of a frame. */
void print_stats_table(FILE *out, const dp_stats *stats);
void print_stats_json(FILE *out, const dp_stats *stats, const dp_target *target);
/* One warning that counts dropped polygons by cause; nothing when there are none. */
void warn_dropped(const dp_stats *stats);
/* One that lines may be missing; nothing when all edges were followed. */
void warn_lost(const dp_stats *stats);

#endif
