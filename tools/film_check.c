/* What the options of films must say, and what they cannot say together. */
#include "film.h"
#include "film_pipe.h"
#include "files.h"
#include "output.h"
#include "report.h"

#include <string.h>

static const char *output_of(const tool_settings *s, int k) {
    return k < FILES_MOST ? s->files[k] : s->outputs[k - FILES_MOST];
}

enum { OUTPUTS = FILES_MOST + OUTPUT_COUNT };

static bool in_one_file(const tool_settings *s, int k) {
    return k < FILES_MOST && output_of(s, k) && files_is_film(s, output_of(s, k));
}

static bool has_film_output(const tool_settings *s) {
    for (int k = 0; k < OUTPUTS; k++)
        if (in_one_file(s, k) || (output_of(s, k) && output_is_sequence(output_of(s, k))))
            return true;
    return false;
}

bool film_wanted(const tool_settings *s) {
    if (s->command != COMMAND_DRAW) return false;
    return s->frames || s->has_turn || s->path || s->has_frame ||
           (s->has_time && s->time[0] != s->time[1]) || has_film_output(s);
}

void film_settle(tool_settings *s) { s->has_time |= film_wanted(s) && !s->has_turn && !s->path; }

/* ---- outputs ---- */

/* A picture's name in a film: a sequence would do, or a film's ending. */
static bool not_one_picture(const tool_settings *s, int k) {
    static const char *const endings[] = {"png", "svg"};
    const char *const path = output_of(s, k);
    char name[32] = "";
    if (k >= FILES_MOST) snprintf(name, sizeof name, "%s=", output_names[k - FILES_MOST]);
    if (!strcmp(path, "-"))
        return wrong_usage("a film has many pictures, and standard output takes one file: give "
                           "--format rgba, webm, gif, apng or mp4, or -o %sout-%%04d.%s",
                           name, endings[k >= FILES_MOST]);
    const int stem = output_stem(path);
    const bool picture = k < FILES_MOST && files_format(s, path) == FORMAT_PNG;
    return wrong_usage(
        "-o %s%s is one picture, and a film has many: name it -o %s%.*s-%%04d%s%s%.*s%s", name,
        path, name, stem, path, path + stem, picture ? ", or -o " : "", picture ? stem : 0, path,
        picture ? ".mp4 (.webm, .gif, .apng)" : "");
}

static bool check_outputs(const tool_settings *s) {
    for (int k = 0; k < OUTPUTS; k++) {
        const char *const path = output_of(s, k);
        if (!path) continue;
        const bool film = in_one_file(s, k);
        if (film && s->has_frame)
            return wrong_usage("-o %s is a film, and --frame draws one picture of it; name a .png, "
                               "or leave --frame out",
                               path);
        if (film && s->resume)
            return wrong_usage("-o %s is one file, of which no part stays: --resume is for "
                               "pictures, as in -o %.*s-%%04d.png",
                               path, output_stem(path), path);
        if (!film && !s->has_frame && !output_is_sequence(path)) return not_one_picture(s, k);
    }
    return true;
}

/* ---- cameras ---- */

static bool check_cameras(const tool_settings *s) {
    if (s->has_turn && s->path)
        return wrong_usage("--turn and --path both move the camera; leave one out");
    const char *const mover = s->has_turn ? "--turn" : s->path ? "--path" : NULL;
    if (mover && s->sheet.count)
        return wrong_usage("--sheet already says where from; leave out %s, or --sheet", mover);
    if (s->path && (s->has_eye || s->has_target || s->view || s->has_azimuth || s->has_elevation))
        return wrong_usage("--path already says where from; leave out --eye, --target, --view, "
                           "--azimuth and --elevation");
    if (s->path && (s->has_fov || s->has_ortho || s->zoom > 0 || s->scale.paper > 0))
        return wrong_usage("--path already says how much is seen; leave out --fov, --ortho, --zoom "
                           "and --scale");
    return true;
}

bool film_check(const tool_settings *s) {
    if (!film_wanted(s)) return true;
    if (s->has_frame && s->resume)
        return wrong_usage("--resume draws what is missing of all frames, and --frame one of them; "
                           "leave one out");
    return check_outputs(s) && check_cameras(s);
}
