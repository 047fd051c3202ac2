/* Presets: named sets of options. */
#ifndef TOOL_PRESETS_H
#define TOOL_PRESETS_H

typedef struct preset {
    const char *name, *options; /* the second as on a command line, single spaces */
} preset;

/* The preset of that name, or NULL. */
const preset *preset_find(const char *name);

#endif
