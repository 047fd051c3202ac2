/* What the options must say, and what they cannot say together. No option is ignored without a
 * message. */
#include "files.h"
#include "film.h"
#include "objects.h"
#include "options.h"
#include "report.h"

#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static bool check_section(const tool_settings *s) {
    if (s->section.count && s->smooth > 1)
        return wrong_usage(
            "--clip cuts polygons, and --smooth would draw another surface than was cut; "
            "leave one out");
    if (s->section.count && s->ink == INK_QUADS && s->edges != EDGES_ADJACENCY)
        return wrong_usage("--ink quads has no lines of sections; leave it out, or --clip");
    return true;
}

static bool check_camera(const tool_settings *s) {
    if (s->has_fov && s->has_ortho)
        return wrong_usage("--fov and --ortho exclude each other; leave one out");
    if (s->has_eye && (s->view || s->has_azimuth || s->has_elevation))
        return wrong_usage("--eye already says where from; leave out --view, --azimuth and "
                           "--elevation");
    return true;
}

/* Is the first word a command that is spelt wrong? What is a file is none. */
static bool check_command(const tool_settings *s) {
    struct stat status;
    char best[16];
    const char *const word = s->model_count ? s->models[0] : "";
    if (s->command != COMMAND_DRAW || !*word || strpbrk(word, "./:") || !stat(word, &status))
        return true;
    nearest_word("info|make|bench|view|help", word, best, sizeof best);
    if (spelling_distance(word, best) > 2) return true;
    return wrong_usage("%s: there is no such file or command; did you mean \"drypoint %s\"?", word,
                       best);
}

/* The last word may be the output, without its -o. */
static bool no_output(const tool_settings *s) {
    const char *const last = s->models[s->model_count - 1];
    if (access(last, F_OK) && files_format(s, last) != FORMAT_UNKNOWN)
        return wrong_usage("no output given; did you mean -o %s?", last);
    if (s->model_count > 1)
        return wrong_usage("no output given; add -o OUT.png for one scene of %u models, or "
                           "-o '%%s.png' for a drawing of each",
                           s->model_count);
    return wrong_usage("no output given; add -o OUT.png");
}

static bool check_present(const tool_settings *s) {
    const command_text *const text = &command_table[s->command];
    const char *const space = *text->name ? " " : "";
    if (!check_command(s)) return false;
    if (!s->model && s->command == COMMAND_VIEW) return true; /* an empty window */
    if (!s->model)
        return wrong_usage("no %s given; usage: drypoint %s%s%s",
                           s->command == COMMAND_MAKE ? "shape" : "model", text->name, space,
                           text->arguments);
    if (s->command == COMMAND_MAKE && !s->output)
        return wrong_usage("no output given; add -o OUT.ply");
    if (s->command == COMMAND_DRAW && !files_count(s) && !s->list) return no_output(s);
    if (files_standard(s) > 1)
        return wrong_usage("only one output can go to standard output; give the others files");
    return true;
}

/* What a scale says already: how large things are seen. */
static bool check_scale(const tool_settings *s) {
    const bool scaled = s->scale.paper > 0;
    if (s->unit && !scaled && !s->sheet.count)
        return wrong_usage(
            "--unit says what a scale is of; add --scale 1:10, say, or leave it out");
    if (!scaled) return true;
    if (s->has_fov)
        return wrong_usage("a picture in perspective has no scale: leave out --fov or --scale");
    if (s->ortho > 0)
        return wrong_usage("--scale and --ortho %g both say how large; leave one out, or give "
                           "--ortho 0",
                           s->ortho);
    if (s->zoom > 0) return wrong_usage("--scale and --zoom both say how large; leave one out");
    return true;
}

static bool check_page(const tool_settings *s) {
    const bool paged = s->page.width > 0 || s->sheet.count;
    if (paged && s->width)
        return wrong_usage(
            "the page already says how large: leave out --size, or give --page none; "
            "--dpi says how many pixels a PNG has");
    if (s->landscape && !paged) return wrong_usage("--landscape turns a page; add --page A4, say");
    if (s->landscape && s->page.turn == TURN_PORTRAIT)
        return wrong_usage("--landscape and --page %s-portrait exclude each other; leave one out",
                           s->page.name);
    if (s->has_margin && !paged && !(s->scale.paper > 0 && !s->width))
        return wrong_usage("--margin is of a page; add --page A4, say");
    return true;
}

static bool check_sheet(const tool_settings *s) {
    if (s->angle && !s->sheet.count)
        return wrong_usage("--angle says where the views of a sheet lie; add --sheet "
                           "front,top,right,iso, say");
    if (!s->sheet.count) return true;
    if (s->has_eye || s->has_target || s->view || s->has_azimuth || s->has_elevation)
        return wrong_usage("--sheet already says where from; leave out --eye, --target, --view, "
                           "--azimuth and --elevation");
    if (s->has_fov || s->ortho > 0 || s->zoom > 0)
        return wrong_usage("the views of a sheet have one scale; leave out --fov, --ortho and "
                           "--zoom, or give --scale");
    if (s->has_mirror) return wrong_usage("a sheet has no mirror; leave out --mirror");
    if (!s->hidden && (s->edges == EDGES_ADJACENCY || s->ink == INK_QUADS))
        return wrong_usage("a sheet draws hidden lines, and added polygons have none: add --hidden "
                           "none, or leave out --ink quads and --edges adjacency");
    if (s->page.width < 0) return wrong_usage("a sheet is a page; leave out --page none");
    for (int k = 0; k < OUTPUT_SEGMENTS; k++)
        if (s->outputs[k])
            return wrong_usage("-o %s=%s is of one view; leave it out, or leave out --sheet",
                               output_names[k], s->outputs[k]);
    return true;
}

static bool check_motion(const tool_settings *s) {
    if (s->morph && s->model_count > 1)
        return wrong_usage(
            "--morph blends one model with another, but %u are given; leave the others "
            "out",
            s->model_count);
    return true;
}

static bool check_xray(const tool_settings *s) {
    if (!xray_asked(s)) return true;
    if (s->edges == EDGES_ADJACENCY)
        return wrong_usage("an x-ray's lines are found in the tiles, without adjacency; leave out "
                           "--edges adjacency or xray");
    if (s->ink && s->ink - 1 == DP_INK_QUADS)
        return wrong_usage("an x-ray's lines are strokes; leave out --ink quads or xray");
    return true;
}

/* What a line's texture is, and where it lies. */
static bool check_pattern(const tool_settings *s) {
    if (s->pattern && option_given(s, "stroke"))
        return wrong_usage("--pattern and --stroke both say what lines look like; leave one out");
    if (s->pattern && s->edges == EDGES_ADJACENCY && s->ink != INK_STROKES)
        return wrong_usage("silhouettes by --edges adjacency have --stroke textures; give --stroke "
                           "%s instead of --pattern, or add --ink strokes",
                           s->pattern);
    if (s->pattern_length.unit && s->pattern_units > 0)
        return wrong_usage("--pattern-length and --pattern-units both say how long a repeat is; "
                           "leave one out");
    return true;
}

bool options_check(const tool_settings *s) {
    return check_present(s) && check_camera(s) && check_scale(s) && check_page(s) &&
           check_sheet(s) && check_motion(s) && film_check(s) && check_xray(s) &&
           check_pattern(s) && check_section(s);
}
