/* Writes the man page from the tables. */
#include "options.h"

#include <ctype.h>

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

static void man_example(FILE *out, const char *command, const char *about) {
    fputs(".TP\n", out);
    troff(out, command);
    fputc('\n', out);
    troff(out, about);
    fputc('\n', out);
}

static void man_examples(FILE *out) {
    for (int k = 0; k < COMMAND_COUNT; k++)
        for (const char *const *e = command_table[k].examples; *e; e += 2)
            man_example(out, e[0], e[1]);
    for (size_t k = 0; k < option_example_count; k++)
        man_example(out, option_examples[k].command, option_examples[k].about);
}

static void man_models(FILE *out) {
    for (const char *const *text = models_text; *text; text++) {
        troff(out, *text);
        fputs("\n.PP\n", out);
    }
}

void options_man(FILE *out) {
    fprintf(out, ".TH DRYPOINT 1 \"\" \"drypoint %s\" \"User Commands\"\n", dp_version());
    fputs(".SH NAME\ndrypoint \\- turn polygons into line drawings\n", out);
    man_heading(out, ".SH", "synopsis");
    man_commands(out);
    man_heading(out, ".SH", "description");
    man_models(out);
    man_heading(out, ".SH", "options");
    man_options(out);
    man_heading(out, ".SH", "shapes");
    man_shapes(out);
    man_heading(out, ".SH", "examples");
    man_examples(out);
    fputs(".SH EXIT STATUS\n0: done. 1: failed; one line on standard error says where and why. "
          "2: wrong usage. 130 (SIGINT), 143 (SIGTERM), 129 (SIGHUP): interrupted; an old output "
          "file is left as it was.\n",
          out);
}
