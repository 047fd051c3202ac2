/* drypoint --completions bash|zsh|fish: scripts for shells, from the table of options, for drypoint and for drypoint-view,
 * which takes what drypoint view takes.
 *
 * What a value can be follows from an option's kind and from its argument as --help shows it: words
 * between bars, FILE, and lists (NAME,...), of which the last part is completed. */
#include "completions.h"

#include <ctype.h>
#include <string.h>

enum { SHELL_BASH = 1, SHELL_ZSH, SHELL_FISH, WORDS_BYTES = 2048 };

/* ---- what a value can be ---- */

static void add(char *words, const char *word, size_t length) {
    const size_t used = strlen(words);
    snprintf(words + used, WORDS_BYTES - used, "%s%.*s", used ? " " : "", (int)length, word);
}

/* Words are of small letters and digits; others stand for something. */
static bool is_literal(const char *word, size_t length) {
    for (size_t k = 0; k < length; k++)
        if (!islower((unsigned char)word[k]) && !isdigit((unsigned char)word[k]) && word[k] != '-')
            return false;
    return length > 0;
}

static void add_literals(char *words, const char *argument) {
    for (const char *at = argument;;) {
        const size_t length = strcspn(at, "|[]");
        if (is_literal(at, length)) add(words, at, length);
        if (!at[length]) return;
        at += length + 1;
    }
}

static bool takes_files(const option *o) {
    return o->kind == OPTION_OUTPUT || (o->argument && strstr(o->argument, "FILE"));
}

static bool is_list(const option *o) { return o->argument && strstr(o->argument, ",..."); }

static void value_words(const option *o, char words[WORDS_BYTES]) {
    static const char *const pages[] = {"A0", "A1",     "A2",    "A3",     "A4",
                                        "A5", "letter", "legal", "tabloid"};
    *words = 0;
    if (o->kind == OPTION_LINES)
        for (int k = 0; k < DP_LINE_COUNT; k++)
            add(words, dp_line_name((dp_line)k), strlen(dp_line_name((dp_line)k)));
    if (o->kind == OPTION_SHEET) add_literals(words, "front|back|left|right|top|bottom|iso");
    if (o->kind == OPTION_PAGE)
        for (size_t k = 0; k < sizeof pages / sizeof *pages; k++)
            add(words, pages[k], strlen(pages[k]));
    if (!strcmp(o->name, "stroke") || !strcmp(o->name, "pattern"))
        for (uint32_t k = 0; k < dp_texture_count(); k++)
            add(words, dp_texture_name(k), strlen(dp_texture_name(k)));
    if (o->kind == OPTION_OUTPUT)
        for (int k = 0; k < OUTPUT_COUNT; k++) {
            add(words, output_names[k], strlen(output_names[k]));
            strncat(words, "=", 2);
        }
    else if (o->argument)
        add_literals(words, o->argument);
}

static void shape_words(const char *before, char words[WORDS_BYTES]) {
    *words = 0;
    for (uint32_t k = 0; k < dp_shape_count(); k++) {
        char word[64];
        snprintf(word, sizeof word, "%s%s", before, dp_shape_name(k));
        add(words, word, strlen(word));
    }
}

static bool takes_value(const option *o) {
    return o->kind != OPTION_FLAG && o->kind != OPTION_QUESTION && o->kind != OPTION_STATS;
}

static bool is_shown(const option *o) { return o->group != GROUP_HIDDEN; }

/* ---- bash ---- */

/* Drawing comes last, as it takes every word. */
static void bash_commands(FILE *out) {
    fputs("    case $command in\n", out);
    for (int command = 1; command <= COMMAND_COUNT; command++) {
        const int k = command % COMMAND_COUNT;
        fprintf(out, "    %s) options='", k ? command_table[k].name : "*");
        bool first = true;
        for (const option *o = option_table; o < option_table + option_count; o++) {
            if (!is_shown(o) || !(o->commands >> k & 1)) continue;
            fprintf(out, "%s--%s", first ? "" : " ", o->name);
            first = false;
        }
        fputs("' ;;\n", out);
    }
    fputs("    esac\n", out);
}

/* Has no option before it this name? make has others than drawing, whose values are alike. */
static bool is_first_of_name(const option *o) {
    for (const option *other = option_table; other < o; other++)
        if (!strcmp(other->name, o->name)) return false;
    return true;
}

/* A pattern of bash that fits the option. */
static void bash_name(FILE *out, const option *o) {
    fprintf(out, "--%s", o->name);
    if (o->letter) fprintf(out, "|-%c", o->letter);
}

/* A line for each option whose value is completed, and one for all others with a value. */
static void bash_values(FILE *out) {
    char words[WORDS_BYTES];
    bool any = false;
    fputs("    case $option in\n", out);
    for (const option *o = option_table; o < option_table + option_count; o++) {
        value_words(o, words);
        if (!is_shown(o) || !takes_value(o) || !is_first_of_name(o)) continue;
        if (!*words && !takes_files(o)) continue;
        fputs("    ", out);
        bash_name(out, o);
        fprintf(out, ") value=1 words='%s'%s%s ;;\n", words, takes_files(o) ? " files=1" : "",
                is_list(o) ? " list=1" : "");
    }
    for (const option *o = option_table; o < option_table + option_count; o++) {
        value_words(o, words);
        if (!is_shown(o) || !takes_value(o) || !is_first_of_name(o)) continue;
        if (*words || takes_files(o)) continue;
        fputs(any ? "|" : "    ", out);
        bash_name(out, o);
        any = true;
    }
    fputs(") value=1 ;;\n    esac\n", out);
}

static const char bash_head[] =
    "# bash completion of drypoint, written by: drypoint --completions bash\n"
    "_drypoint() {\n"
    "    local IFS=$' \\t\\n' line cur option= value= words= files= list= before= command options\n"
    "    # The shell parts words at = and :, too; these are whole.\n"
    "    read -ra line <<<\"${COMP_LINE:0:COMP_POINT}\"\n"
    "    case ${COMP_LINE:0:COMP_POINT} in *[[:space:]]) line+=('') ;; esac\n"
    "    [ \"${line[0]##*/}\" != drypoint-view ] || line=(drypoint view \"${line[@]:1}\")\n"
    "    cur=${line[${#line[@]}-1]}\n"
    "    command=${line[1]-}\n"
    "    [ ${#line[@]} -gt 2 ] || command=\n";

static const char bash_middle[] =
    "    case $cur in\n"
    "    --*=*) option=${cur%%=*} before=$option= ;;\n"
    "    *) [ ${#line[@]} -lt 3 ] || option=${line[${#line[@]}-2]} ;;\n"
    "    esac\n";

static const char bash_tail[] =
    "    if [ -z \"$value\" ]; then\n"
    "        before=\n"
    "        case $cur in\n"
    "        -*) words=$options ;;\n"
    "        *)\n"
    "            case $command in\n"
    "            make) words=$shapes ;;\n"
    "            help) words=$topics ;;\n"
    "            *) words=$models files=1 ;;\n"
    "            esac\n"
    "            [ ${#line[@]} -gt 2 ] || words=\"$words $commands\"\n"
    "            [ \"$option\" != --help ] || words=$topics files= ;;\n"
    "        esac\n"
    "    fi\n"
    "    cur=${cur#\"$before\"}\n"
    "    if [ -n \"$files\" ]; then\n"
    "        case $cur in\n"
    "        *=*) before=$before${cur%%=*}= cur=${cur#*=} words= ;; # depth=FILE\n"
    "        esac\n"
    "    fi\n"
    "    if [ -n \"$list\" ]; then\n"
    "        case $cur in\n"
    "        *,*) before=$before${cur%,*}, cur=${cur##*,} ;;\n"
    "        esac\n"
    "    fi\n"
    "    words=${words// /$'\\n'}\n"
    "    IFS=$'\\n'\n"
    "    COMPREPLY=($(compgen -P \"$before\" -W \"$words\" -- \"$cur\"))\n"
    "    if [ -n \"$files\" ]; then\n"
    "        [ ${#COMPREPLY[@]} -gt 0 ] || compopt -o filenames 2>/dev/null\n"
    "        COMPREPLY+=($(compgen -P \"$before\" -f -- \"$cur\"))\n"
    "    fi\n"
    "    case ${COMPREPLY[0]-} in *=) compopt -o nospace 2>/dev/null ;; esac\n"
    "    # What the shell takes for words of their own is there already.\n"
    "    cur=$before$cur before=$cur\n"
    "    case $COMP_WORDBREAKS in *=*) before=${before##*=} ;; esac\n"
    "    case $COMP_WORDBREAKS in *:*) before=${before##*:} ;; esac\n"
    "    cur=${cur%\"$before\"}\n"
    "    [ ${#COMPREPLY[@]} -eq 0 ] || COMPREPLY=(\"${COMPREPLY[@]#\"$cur\"}\")\n"
    "}\n"
    "complete -F _drypoint drypoint drypoint-view\n";

static void write_bash(FILE *out) {
    char shapes[WORDS_BYTES], models[WORDS_BYTES], topics[WORDS_BYTES];
    shape_words("", shapes);
    shape_words("shape:", models);
    topic_words(topics, sizeof topics, " ");
    fputs(bash_head, out);
    fprintf(out, "    local shapes='%s'\n    local models='%s'\n    local topics='%s'\n", shapes,
            models, topics);
    fputs("    local commands='info make bench view help'\n", out);
    bash_commands(out);
    fputs(bash_middle, out);
    bash_values(out);
    fputs(bash_tail, out);
}

/* ---- help in one line ---- */

/* Where a help text first says less than all: at the end of a sentence, at a colon. */
static size_t short_length(const char *help) {
    size_t length = 0;
    while (help[length] &&
           !(strchr(".:;", help[length]) && (!help[length + 1] || help[length + 1] == ' ')))
        length++;
    return length;
}

/* The beginning of a help text, to stand between quotes ' as the shell has them; what `special`
 * has gets a backslash. */
static void put_short(FILE *out, const char *help, const char *quote, const char *special) {
    const size_t length = short_length(help);
    for (size_t k = 0; k < length; k++) {
        const char c = help[k];
        if (c == '\'')
            fputs(quote, out);
        else if (strchr(special, c))
            fprintf(out, "\\%c", c);
        else
            fputc(c, out);
    }
}

/* ---- zsh ---- */

static void zsh_option(FILE *out, const option *o) {
    char words[WORDS_BYTES];
    value_words(o, words);
    if (o->letter)
        fprintf(out, "            '*'{-%c,--%s}'[", o->letter, o->name);
    else
        fprintf(out, "            '*--%s%s[", o->name, takes_value(o) ? "=" : "");
    put_short(out, o->help, "'\\''", "[]:\\");
    fputc(']', out);
    if (takes_value(o)) fprintf(out, ":%s:", o->name);
    if (takes_value(o) && takes_files(o))
        fprintf(out, " _drypoint_files %s", words);
    else if (takes_value(o) && *words)
        fprintf(out, is_list(o) ? "_values -s , value %s" : "(%s)", words);
    fputs("'\n", out);
}

static void write_zsh(FILE *out) {
    char words[WORDS_BYTES];
    fputs("#compdef drypoint drypoint-view\n"
          "# zsh completion of drypoint, written by: drypoint --completions zsh\n"
          "_drypoint_models() {\n",
          out);
    shape_words("shape:", words);
    fprintf(out, "    compadd -- %s\n    _files\n}\n", words);
    fputs("_drypoint_files() { # words, NAME= before files, files\n"
          "    compset -P '*=' || compadd -S '' -- $@\n"
          "    _files\n"
          "}\n",
          out);
    fputs("_drypoint_first() {\n    compadd -- info make bench view help\n    _drypoint_models\n}\n"
          "_drypoint() {\n"
          "    local -a options\n"
          "    if [[ ${words[1]:t} == drypoint-view ]]; then\n"
          "        words=(drypoint view ${words[2,-1]})\n"
          "        (( CURRENT++ ))\n"
          "    fi\n"
          "    local command=$words[2]\n"
          "    case $command in\n"
          "    info|make|bench|view|help) [[ $CURRENT -gt 2 ]] || command= ;;\n"
          "    *) command= ;;\n"
          "    esac\n"
          "    if [[ -n $command ]]; then\n"
          "        shift words\n"
          "        (( CURRENT-- ))\n"
          "    fi\n"
          "    case $command in\n",
          out);
    for (int n = 1; n <= COMMAND_COUNT; n++) {
        const int k = n % COMMAND_COUNT;
        if (!k) {
            topic_words(words, sizeof words, " ");
            fprintf(out, "    help) compadd -- %s; return ;;\n", words);
        }
        fprintf(out, "    %s)\n        options=(\n", k ? command_table[k].name : "*");
        for (const option *o = option_table; o < option_table + option_count; o++)
            if (is_shown(o) && o->commands >> k & 1) zsh_option(out, o);
        if (k == COMMAND_MAKE) {
            shape_words("", words);
            fprintf(out, "            '1:shape:(%s)'\n", words);
        } else {
            fprintf(out, "%s            '*:model:_drypoint_models'\n",
                    k ? "" : "            '1:model:_drypoint_first'\n");
        }
        fputs("        ) ;;\n", out);
    }
    fputs("    esac\n"
          "    _arguments -s $options\n"
          "}\n"
          "_drypoint \"$@\"\n",
          out);
}

/* ---- fish ---- */

static void fish_option(FILE *out, const option *o) {
    char words[WORDS_BYTES];
    fputs("complete -c drypoint -n 'contains (__drypoint_command)", out);
    for (int k = 0; k < COMMAND_COUNT; k++)
        if (o->commands >> k & 1) fprintf(out, " %s", k ? command_table[k].name : "draw");
    fputc('\'', out);
    if (o->letter) fprintf(out, " -s %c", o->letter);
    fprintf(out, " -l %s", o->name);
    value_words(o, words);
    if (takes_value(o)) fputs(takes_files(o) ? " -r -F" : " -x", out);
    if (takes_value(o) && *words && is_list(o))
        fprintf(out, " -a '(__fish_append , %s)'", words);
    else if (takes_value(o) && *words)
        fprintf(out, " -a '%s'", words);
    fputs(" -d '", out);
    put_short(out, o->help, "\\'", "\\");
    fputs("'\n", out);
}

static void write_fish(FILE *out) {
    char words[WORDS_BYTES];
    fputs("# fish completion of drypoint, written by: drypoint --completions fish\n"
          "function __drypoint_command\n"
          "    set -l words (commandline -opc)\n"
          "    if set -q words[2]; and contains -- $words[2] info make bench view help\n"
          "        echo $words[2]\n"
          "    else\n"
          "        echo draw\n"
          "    end\n"
          "end\n",
          out);
    for (int k = 1; k < COMMAND_COUNT; k++) {
        fprintf(out, "complete -c drypoint -n __fish_is_first_token -a %s -d '",
                command_table[k].name);
        put_short(out, command_table[k].about, "\\'", "\\");
        fputs("'\n", out);
    }
    fputs("complete -c drypoint -n __fish_is_first_token -a help -d 'Tell more about a topic.'\n",
          out);
    shape_words("shape:", words);
    fprintf(
        out,
        "complete -c drypoint -n 'contains (__drypoint_command) draw info bench view' -a '%s' -d "
        "'Generated model'\n",
        words);
    shape_words("", words);
    fprintf(out, "complete -c drypoint -n 'contains (__drypoint_command) make' -f -a '%s'\n",
            words);
    topic_words(words, sizeof words, " ");
    fprintf(out, "complete -c drypoint -n 'contains (__drypoint_command) help' -f -a '%s'\n",
            words);
    fprintf(out, "complete -c drypoint -n '__fish_prev_arg_in -h --help' -f -a '%s'\n", words);
    for (const option *o = option_table; o < option_table + option_count; o++)
        if (is_shown(o)) fish_option(out, o);
    fputs("complete -c drypoint-view -w 'drypoint view'\n", out);
}

void completions_write(FILE *out, int shell) {
    if (shell == SHELL_BASH) write_bash(out);
    if (shell == SHELL_ZSH) write_zsh(out);
    if (shell == SHELL_FISH) write_fish(out);
}
