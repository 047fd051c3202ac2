/* The program: parses the command line and calls a command. */
#include "commands.h"
#include "completions.h"
#include "models.h"
#include "progress.h"
#include "report.h"

#include <errno.h>
#include <string.h>

static int answer(const tool_settings *s) {
    if (s->question == QUESTION_HELP && !options_help(stdout, s->command, s->topic))
        return EXIT_USAGE;
    if (s->question == QUESTION_MAN) options_man(stdout);
    if (s->question == QUESTION_COMPLETIONS) completions_write(stdout, s->completions);
    if (s->question == QUESTION_VERSION) printf("drypoint %s\n", dp_version());
    return 0;
}

int main(int argc, char **argv) {
    static int (*const commands[COMMAND_COUNT])(const tool_settings *) = {
        [COMMAND_DRAW] = command_draw,
        [COMMAND_INFO] = command_info,
        [COMMAND_MAKE] = command_make,
        [COMMAND_BENCH] = command_bench,
    };
    tool_settings settings;
    dp_diag diag;
    if (dp_version_check(&diag)) return report_failure(NULL, &diag);
    const bool sound = options_parse(argc, argv, &settings);
    const bool views = sound && !settings.question && settings.command == COMMAND_VIEW;
    interrupt_install();
    int code = sound ? 0 : EXIT_USAGE;
    if (sound && settings.question)
        code = answer(&settings);
    else if (views)
        code = view_run(argv + 2);
    else if (sound)
        code = commands[settings.command](&settings);
    models_free(&settings);
    option_lists_free(&settings);
    if (!fflush(stdout) && !ferror(stdout)) return code;
    wrong_usage("cannot write standard output: %s", strerror(errno));
    return code ? code : EXIT_FAILED;
}
