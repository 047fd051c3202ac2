/* Writes --help from the tables: a first screen, and topics. */
#include "options.h"
#include "report.h"

#include <string.h>

enum { INDENT = 26, COLUMNS = 80 };

/* Prints words of `text` in lines that start at column `indent`, where the cursor already is. */
static void wrap(FILE *out, int indent, const char *text) {
    int column = indent;
    while (*text) {
        const int length = (int)strcspn(text, " ");
        const bool fits = column + 1 + length <= COLUMNS;
        if (column > indent && fits) column += fprintf(out, " ");
        if (column > indent && !fits) column = fprintf(out, "\n%*s", indent, "") - 1;
        column += fprintf(out, "%.*s", length, text);
        text += length;
        text += strspn(text, " ");
    }
    fputc('\n', out);
}

/* The same, where a line begins. */
static void wrap_from(FILE *out, int indent, const char *text) {
    fprintf(out, "%*s", indent, "");
    wrap(out, indent, text);
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
    wrap(out, INDENT, o->help);
}

static bool shown(const option *o, tool_command command, option_group group) {
    return o->group == group && o->commands >> command & 1;
}

static bool has_options(option_group group, tool_command command) {
    for (const option *o = option_table; o < option_table + option_count; o++)
        if (shown(o, command, group)) return true;
    return false;
}

static void help_group(FILE *out, tool_command command, option_group group) {
    fprintf(out, "%s:\n", group_names[group]);
    for (const option *o = option_table; o < option_table + option_count; o++)
        if (shown(o, command, group)) help_option(out, o);
}

static void help_group_examples(FILE *out, option_group group) {
    fputs("\nExamples:\n", out);
    for (const option_example *e = option_examples; e < option_examples + option_example_count; e++)
        if (e->group == group) fprintf(out, "  %s\n      %s\n", e->command, e->about);
}

static void help_groups(FILE *out, tool_command command) {
    for (int group = 0; group < GROUP_HIDDEN; group++) {
        if (!has_options((option_group)group, command)) continue;
        fputc('\n', out);
        help_group(out, command, (option_group)group);
    }
}

static void help_shapes(FILE *out) {
    fputs("Shapes:\n", out);
    for (uint32_t k = 0; k < dp_shape_count(); k++)
        fprintf(out, "  %-13s %s\n", dp_shape_name(k), dp_shape_about(k));
}

static void help_examples(FILE *out, tool_command command) {
    fputs("Examples:\n", out);
    for (const char *const *e = command_table[command].examples; *e; e += 2)
        fprintf(out, "  %s\n      %s\n", e[0], e[1]);
}

static void usage_line(FILE *out, const char *before, const command_text *text) {
    fprintf(out, "%sdrypoint %s%s%s\n", before, text->name, *text->name ? " " : "",
            text->arguments);
}

/* What MODEL can be; scenes come last, of which info and make know nothing. */
static void help_models(FILE *out, tool_command command) {
    const bool scenes = command != COMMAND_INFO && command != COMMAND_MAKE;
    for (const char *const *text = models_text; *text; text++)
        if (scenes || text[1]) wrap_from(out, 0, *text);
}

/* All about a command. */
static void help_command(FILE *out, tool_command command) {
    usage_line(out, "Usage: ", &command_table[command]);
    for (int other = 1; command == COMMAND_DRAW && other < COMMAND_COUNT; other++)
        usage_line(out, "       ", &command_table[other]);
    fprintf(out, "\n%s\n", command_table[command].about);
    if (command != COMMAND_MAKE) help_models(out, command);
    help_groups(out, command);
    fputc('\n', out);
    if (command == COMMAND_MAKE) help_shapes(out), fputc('\n', out);
    help_examples(out, command);
    if (command == COMMAND_DRAW)
        fputs("\n\"drypoint COMMAND --help\" tells more about info, make, bench and view.\n"
              "Exit codes: 0 done, 1 failed, 2 wrong usage, 130 interrupted.\n",
              out);
}

/* ---- topics ---- */

static void text_of_shapes(FILE *out, tool_command command) {
    (void)command;
    help_shapes(out);
}
static void text_of_topics(FILE *out, tool_command command) {
    char text[600];
    (void)command;
    fputs("Topics of \"drypoint --help TOPIC\":\n", out);
    topic_words(text, sizeof text, ", ");
    wrap_from(out, 2, text);
}

/* Topics that are neither a group of options nor a command. */
static const struct {
    const char *word;
    void (*print)(FILE *out, tool_command command);
} texts[] = {{"models", help_models},
             {"shapes", text_of_shapes},
             {"examples", help_examples},
             {"topics", text_of_topics},
             {"all", help_command}};
enum { TEXTS = sizeof texts / sizeof *texts };

static void add_word(char *text, size_t size, const char *between, const char *word) {
    const size_t length = strlen(text);
    snprintf(text + length, size - length, "%s%s", length ? between : "", word);
}

void topic_words(char *text, size_t size, const char *between) {
    *text = 0;
    for (int group = 0; group < GROUP_HIDDEN; group++)
        if (group_topics[group] && has_options((option_group)group, COMMAND_DRAW))
            add_word(text, size, between, group_topics[group]);
    for (int command = 1; command < COMMAND_COUNT; command++)
        add_word(text, size, between, command_table[command].name);
    for (int k = 0; k < TEXTS; k++) add_word(text, size, between, texts[k].word);
}

/* Is it the word, or that but for a final s? */
static bool is_topic(const char *word, const char *topic) {
    const size_t n = strlen(word), m = strlen(topic), least = n < m ? n : m;
    if (n == m) return !strcmp(word, topic);
    return !strncmp(word, topic, least) && n + m == 2 * least + 1 &&
           (n > m ? word : topic)[least] == 's';
}

static const option *named_option(const char *name, unsigned commands) {
    for (const option *o = option_table; o < option_table + option_count; o++)
        if (o->commands & commands && o->group != GROUP_HIDDEN &&
            (!strcmp(o->name, name) || (o->letter == *name && *name && !name[1])))
            return o;
    return NULL;
}

/* The option that is called like a topic and belongs to another one: --path is not of paths. */
static void help_namesake(FILE *out, tool_command command, const char *topic, option_group group) {
    const option *const o = named_option(topic, 1u << command);
    if (!o || o->group == group) return;
    fputs("\nThe option of that name:\n", out);
    help_option(out, o);
}

static bool unknown_topic(const char *topic) {
    char words[600], best[32];
    topic_words(words, sizeof words, "|");
    nearest_word(words, topic, best, sizeof best);
    if (is_slip(topic, best))
        return wrong_usage("--help: \"%s\" is no topic; did you mean %s?", topic, best);
    for (const option *o = option_table; o < option_table + option_count; o++)
        if (o->group != GROUP_HIDDEN && spelling_distance(topic, o->name) <= 1)
            return wrong_usage("--help: \"%s\" is no topic; did you mean --help %s?", topic,
                               o->name);
    return wrong_usage("--help: \"%s\" is neither a topic nor an option; \"drypoint --help\" lists "
                       "topics",
                       topic);
}

static bool help_topic(FILE *out, tool_command command, const char *topic) {
    for (int k = 0; k < TEXTS; k++)
        if (is_topic(topic, texts[k].word)) return texts[k].print(out, command), true;
    for (int other = 1; other < COMMAND_COUNT; other++)
        if (!strcmp(topic, command_table[other].name))
            return help_command(out, (tool_command)other), true;
    for (int group = 0; group < GROUP_HIDDEN; group++)
        if (group_topics[group] && is_topic(topic, group_topics[group]) &&
            has_options((option_group)group, command)) {
            help_group(out, command, (option_group)group);
            if (command == COMMAND_DRAW) help_group_examples(out, (option_group)group);
            help_namesake(out, command, topic, (option_group)group);
            return true;
        }
    const char *const name = topic + strspn(topic, "-");
    const option *o = named_option(name, 1u << command);
    if (!o) o = named_option(name, ~0u);
    return o ? help_option(out, o), true : unknown_topic(topic);
}

/* What fits on a screen of 24 lines. */
static void first_screen(FILE *out) {
    char topics[600], text[800];
    topic_words(topics, sizeof topics, ", ");
    snprintf(text, sizeof text, "%s, or the name of an option.", topics);
    usage_line(out, "Usage: ", &command_table[COMMAND_DRAW]);
    fputs("       drypoint info|make|bench|view ...\n\n", out);
    fprintf(out, "%s\n", command_table[COMMAND_DRAW].about);
    wrap_from(out, 0, models_text[0]);
    fputs("\n"
          "  drypoint part.stl -o part.png                           a drawing\n"
          "  drypoint part.stl -o part.svg --hidden dashed           paths, hidden ones too\n"
          "  drypoint part.stl -o part.png --preset technical        a look\n"
          "  drypoint part.stl -o part.png --clip 1,0,0 --xray 0.4   cut open, see-through\n"
          "  drypoint part.stl --sheet front,top,iso -o part.pdf     views on a page\n"
          "  drypoint gear.stl shaft.obj -o two.png --explode 1      a scene, pulled apart\n"
          "  drypoint part.stl --turn 360 -o part.mp4                a film\n"
          "  drypoint 'parts/*.stl' -o '%s.png'                      a drawing for each\n"
          "\n\"drypoint --help TOPIC\" tells more. Topics:\n",
          out);
    wrap_from(out, 2, text);
}

bool options_help(FILE *out, tool_command command, const char *topic) {
    if (topic) return help_topic(out, command, topic);
    if (command == COMMAND_DRAW)
        first_screen(out);
    else
        help_command(out, command);
    return true;
}
