/* The files that a run writes. */
#ifndef TOOL_FILES_H
#define TOOL_FILES_H

#include "options.h"

/* How a drawing is written: a dp_format, FORMAT_PNG, or a film in one file. */
enum {
    FORMAT_PNG = DP_FORMAT_COUNT,
    FORMAT_RGBA, /* the frames' pixels */
    FORMAT_MP4,
    FORMAT_WEBM,
    FORMAT_GIF,
    FORMAT_APNG,
    FORMAT_UNKNOWN
};

/* The format of -o FILE: by its ending; of what has none, by --format. FORMAT_UNKNOWN: another
 * ending. */
int files_format(const tool_settings *s, const char *path);
/* How many outputs there are, and how many of them are standard output. */
int files_count(const tool_settings *s);
int files_standard(const tool_settings *s);
/* Are drawings written as pixels, and as paths? */
bool files_have_pixels(const tool_settings *s);
bool files_have_paths(const tool_settings *s);
/* Is that one a film in one file? */
bool files_is_film(const tool_settings *s, const char *path);
/* Is one of them written so? */
bool files_have(const tool_settings *s, int format);

/* Is an output no folder? A message if it is, with a name that would do. */
bool files_no_folder(const tool_settings *s, const char *path, const char *ending);

/* Can every output be written, each to a file of its own that is not the model? 0, or the exit code
 * after a message. */
int files_check(const tool_settings *s);

#endif
