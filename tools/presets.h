/* Looks that are options put together. */
#ifndef TOOL_PRESETS_H
#define TOOL_PRESETS_H

typedef struct preset {
    const char *name, *options; /* the second as on a command line, single spaces */
} preset;

/* NULL: there is none of that name. */
const preset *preset_find(const char *name);

#endif
