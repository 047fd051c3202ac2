/* What is seen, as a command line of the program: models, options and camera. It is the viewer's only state of these:
 * keys and panel change its words, and what is drawn, saved and copied comes from parsing them as the program does. */
#ifndef VIEWER_CMDLINE_H
#define VIEWER_CMDLINE_H

#include "options.h"

typedef struct cmd_option {
    char *name;  /* without the dashes */
    char *value; /* NULL: it takes none */
} cmd_option;

typedef struct cmd_options {
    cmd_option *items; /* [count] */
    uint32_t count;
} cmd_options;

/* Zero is empty. */
typedef struct cmdline {
    char **models; /* [model_count] */
    uint32_t model_count;
    cmd_options options, camera; /* camera: where from and how, --up as given excepted */
    uint32_t width, height;      /* px */
    bool gl;
} cmdline;

/* Settings, and the words that they borrow. */
typedef struct parsed {
    tool_settings settings;
    char **words; /* [count] */
    int count;
} parsed;

/* Takes the words of a command line that options_parse has found sound, without its program and command. False: memory
 * is out. */
bool cmdline_read(cmdline *line, int count, char **words);
void cmdline_free(cmdline *line);
/* The list that an option is in; NULL: of a picture's size, say, which is none of the options. */
cmd_options *cmdline_list(cmdline *line, const char *name);
/* Names other models; copied. */
bool cmdline_models(cmdline *line, uint32_t count, const char *const *models);

/* Of the options: sets one in the place of all of its name, or takes it away (value NULL). A flag's value is "". */
void cmdline_set(cmd_options *options, const char *name, const char *value);
/* The last value; NULL: it is not there. */
const char *cmdline_get(const cmd_options *options, const char *name);
void cmdline_clear(cmd_options *options);
bool cmdline_copy(cmd_options *to, const cmd_options *from);

/* As `drypoint MODEL... -o OUTPUT` reads it; OUTPUT may be NULL. False: a message was said. Call parsed_free in any case. */
bool cmdline_parse(const cmdline *line, const char *output, parsed *out);
void parsed_free(parsed *p);
/* Moves one to another place, whose own are freed: settings point into themselves. */
void parsed_move(parsed *to, parsed *from);
/* The command line for a shell; the caller frees it. */
char *cmdline_text(const cmdline *line, const char *output);

#endif
