/* Writes --help and the man page from the tables. */
#include "options.h"

#include <ctype.h>
#include <string.h>

enum { INDENT = 26, COLUMNS = 80 };

/* Prints `text` in lines that start at column INDENT, where the cursor already is. */
static void wrap(FILE *out, const char *text) {
    int column = INDENT;
    while (*text) {
        const int length = (int)strcspn(text, " ");
        const bool fits = column + 1 + length <= COLUMNS;
        if (column > INDENT && fits) column += fprintf(out, " ");
        if (column > INDENT && !fits) column = fprintf(out, "\n%*s", INDENT, "") - 1;
        column += fprintf(out, "%.*s", length, text);
        text += length;
        text += strspn(text, " ");
    }
    fputc('\n', out);
}

/* Prints an option and its words, in more lines where they are many; the column it ends in. */
static int help_head(FILE *out, const option *o) {
    const char letter[] = {'-', o->letter, ',', ' ', 0};
    int column = fprintf(out, "  %s--%s", o->letter ? letter : "", o->name);
    const char *at = o->argument ? o->argument : "";
    if (*at) column += fprintf(out, " ");
    while (*at) {
        int length = (int)strcspn(at, "|");
        length += at[length] == '|';
        if (column + length > COLUMNS) column = fprintf(out, "\n      ") - 1;
        column += fprintf(out, "%.*s", length, at);
        at += length;
    }
    return column;
}

static void help_option(FILE *out, const option *o) {
    const int column = help_head(out, o);
    if (column < INDENT)
        fprintf(out, "%*s", INDENT - column, "");
    else
        fprintf(out, "\n%*s", INDENT, "");
    wrap(out, o->help);
}

static bool shown(const option *o, tool_command command, option_group group) {
    return o->group == group && o->commands >> command & 1;
}

static void help_groups(FILE *out, tool_command command) {
    for (int group = 0; group < GROUP_HIDDEN; group++) {
        bool first = true;
        for (const option *o = option_table; o < option_table + option_count; o++) {
            if (!shown(o, command, (option_group)group)) continue;
            if (first) fprintf(out, "\n%s:\n", group_names[group]);
            first = false;
            help_option(out, o);
        }
    }
}

static void help_shapes(FILE *out) {
    fputs("\nShapes:\n", out);
    for (uint32_t k = 0; k < dp_shape_count(); k++)
        fprintf(out, "  %-13s %s\n", dp_shape_name(k), dp_shape_about(k));
}

static void help_examples(FILE *out, tool_command command) {
    fputs("\nExamples:\n", out);
    for (const char *const *e = command_table[command].examples; *e; e += 2)
        fprintf(out, "  %s\n      %s\n", e[0], e[1]);
}

static void usage_line(FILE *out, const char *before, const command_text *text) {
    fprintf(out, "%sdrypoint %s%s%s\n", before, text->name, *text->name ? " " : "",
            text->arguments);
}

void options_help(FILE *out, tool_command command) {
    usage_line(out, "Usage: ", &command_table[command]);
    for (int other = 1; command == COMMAND_DRAW && other < COMMAND_COUNT; other++)
        usage_line(out, "       ", &command_table[other]);
    fprintf(out, "\n%s\n", command_table[command].about);
    if (command != COMMAND_MAKE)
        fputs("MODEL is a file (STL, PLY, OBJ, OFF; glTF, FBX, 3MF, COLLADA and more through\n"
              "Assimp), - for standard input, or a generated model: shape:gear, or\n"
              "shape:terrain:1000000 with a number of triangles.\n",
              out);
    help_groups(out, command);
    if (command == COMMAND_MAKE) help_shapes(out);
    help_examples(out, command);
    if (command == COMMAND_DRAW)
        fputs("\n\"drypoint COMMAND --help\" tells more about info, make and bench.\n"
              "Exit codes: 0 done, 1 failed, 2 wrong usage, 130 interrupted.\n",
              out);
}

/* ---- man ---- */

/* Prints text with troff's special characters escaped. */
static void troff(FILE *out, const char *text) {
    for (; *text; text++) {
        if (*text == '-')
            fputs("\\-", out);
        else if (*text == '\\')
            fputs("\\e", out);
        else if (*text == '\'')
            fputs("\\(aq", out);
        else
            fputc(*text, out);
    }
}

static void man_heading(FILE *out, const char *macro, const char *text) {
    fprintf(out, "%s ", macro);
    for (; *text; text++) fputc(toupper((unsigned char)*text), out);
    fputc('\n', out);
}

static void man_option(FILE *out, const option *o) {
    fputs(".TP\n\\fB", out);
    if (o->letter) fprintf(out, "\\-%c\\fR, \\fB", o->letter);
    fputs("\\-\\-", out);
    troff(out, o->name);
    fputs("\\fR", out);
    if (o->argument) {
        fputs(" \\fI", out);
        troff(out, o->argument);
        fputs("\\fR", out);
    }
    fputc('\n', out);
    troff(out, o->help);
    fputc('\n', out);
}

static void man_options(FILE *out) {
    for (int group = 0; group < GROUP_HIDDEN; group++) {
        fprintf(out, ".SS %s\n", group_names[group]);
        for (const option *o = option_table; o < option_table + option_count; o++)
            if (o->group == (option_group)group) man_option(out, o);
    }
}

static void man_commands(FILE *out) {
    for (int k = 0; k < COMMAND_COUNT; k++) {
        fputs(".TP\n\\fBdrypoint ", out);
        fputs(command_table[k].name, out);
        fputs("\\fR ", out);
        troff(out, command_table[k].arguments);
        fputc('\n', out);
        troff(out, command_table[k].about);
        fputc('\n', out);
    }
}

static void man_shapes(FILE *out) {
    for (uint32_t k = 0; k < dp_shape_count(); k++) {
        fprintf(out, ".TP\n\\fB%s\\fR\n", dp_shape_name(k));
        troff(out, dp_shape_about(k));
        fputc('\n', out);
    }
}

static void man_examples(FILE *out) {
    for (int k = 0; k < COMMAND_COUNT; k++)
        for (const char *const *e = command_table[k].examples; *e; e += 2) {
            fputs(".TP\n", out);
            troff(out, e[0]);
            fputc('\n', out);
            troff(out, e[1]);
            fputc('\n', out);
        }
}

void options_man(FILE *out) {
    fprintf(out, ".TH DRYPOINT 1 \"\" \"drypoint %s\" \"User Commands\"\n", dp_version());
    fputs(".SH NAME\ndrypoint \\- turn polygons into line drawings\n", out);
    man_heading(out, ".SH", "synopsis");
    man_commands(out);
    fputs(".SH DESCRIPTION\nMODEL is a file (STL, PLY, OBJ, OFF; glTF, FBX, 3MF, COLLADA and more "
          "through Assimp), \\- for standard input, or a generated model: shape:gear, or "
          "shape:terrain:1000000 with a number of triangles.\n",
          out);
    man_heading(out, ".SH", "options");
    man_options(out);
    man_heading(out, ".SH", "shapes");
    man_shapes(out);
    man_heading(out, ".SH", "examples");
    man_examples(out);
    fputs(".SH EXIT STATUS\n0: done. 1: failed; one line on standard error says where and why. "
          "2: wrong usage. 130: interrupted; an old output file is left as it was.\n",
          out);
}
