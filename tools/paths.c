/* The paths of a run's views: what the settings ask of them, the page that holds them, and one line
 * about them. */
#include "paths.h"
#include "files.h"
#include "output.h"
#include "progress.h"
#include "report.h"

#include <drypoint/io.h>

#include <stdio.h>
#include <string.h>

int paths_make(const tool_settings *s, const page_plan *plan, dp_context *context,
               dp_drawing **out) {
    dp_diag diag = {0};
    const dp_drawing_desc desc = {.join = page_length(plan, &s->join),
                                  .min_length = page_length(plan, &s->min_length),
                                  .tolerance = page_length(plan, &s->tolerance),
                                  .join_classes = s->join_classes,
                                  .keep_coincident = s->keep_coincident,
                                  .optimize = s->optimize};
    return dp_drawing_create(context, &desc, out, &diag) ? report_failure(NULL, &diag) : 0;
}

/* ---- files ---- */

static void fill_views(const page_plan *plan, const view_paths *paths, dp_view_on_page *views) {
    for (int k = 0; k < plan->view_count; k++) {
        const page_view *const v = &plan->views[k];
        views[k] = (dp_view_on_page){.drawing = paths[k].lines,
                                     .x = v->x * plan->mm_per_px,
                                     .y = v->y * plan->mm_per_px,
                                     .mm_per_px = plan->mm_per_px,
                                     .name = v->name,
                                     .ground = paths[k].ground};
    }
}

static int write_page(const tool_settings *s, const dp_page *page, const char *path, int format) {
    dp_diag diag = {0};
    progress_begin("writing", s->quiet);
    interrupt_hold();
    const dp_result result = dp_io_write_page(path, page, (dp_format)format, &diag);
    interrupt_release();
    progress_end();
    if (!result) return 0;
    report_failure(result == DP_ERR_IO ? NULL : path, &diag);
    return EXIT_FAILED;
}

int paths_write(const tool_settings *s, const page_plan *plan, const view_paths *paths) {
    dp_view_on_page views[SHEET_MOST];
    fill_views(plan, paths, views);
    const dp_color paper = s->style.paper;
    const dp_page page = {.width = plan->mm_width,
                          .height = plan->mm_height,
                          .paper = paper == DP_COLOR_NONE ? 0 : paper,
                          .views = views,
                          .view_count = (size_t)plan->view_count,
                          .texts = plan->texts,
                          .text_count = plan->text_count,
                          .rules = plan->rules,
                          .rule_count = plan->rule_count,
                          .title = s->title ? s->title : output_name(s->model)};
    int code = 0;
    for (uint32_t k = 0; k < s->file_count && !code; k++) {
        const int format = files_format(s, s->files[k]);
        if (format < FORMAT_PNG) code = write_page(s, &page, s->files[k], format);
    }
    if (!code && s->outputs[OUTPUT_SEGMENTS])
        code = write_page(s, &page, s->outputs[OUTPUT_SEGMENTS], DP_FORMAT_JSON);
    return code;
}

/* ---- what is told ---- */

static const char *spoken(const char *path) { return strcmp(path, "-") ? path : "standard output"; }

/* The first file of paths, and how many follow it. */
static const char *first_file(const tool_settings *s, int *more) {
    const char *first = s->outputs[OUTPUT_SEGMENTS];
    *more = first ? 0 : -1;
    for (uint32_t k = s->file_count; k-- > 0;)
        if (files_format(s, s->files[k]) < FORMAT_PNG) first = s->files[k], ++*more;
    return spoken(first);
}

static dp_drawing_info total(const page_plan *plan, const view_paths *paths) {
    dp_drawing_info sum = {0};
    for (int k = 0; k < plan->view_count; k++) {
        dp_drawing_info one;
        dp_drawing_info_of(paths[k].lines, &one);
        sum.paths += one.paths, sum.points += one.points, sum.length += one.length;
        sum.coincident += one.coincident, sum.joined += one.joined;
        sum.dropped += one.dropped, sum.dropped_length += one.dropped_length;
        sum.travel += one.travel, sum.travel_before += one.travel_before;
    }
    return sum;
}

typedef struct sentence {
    char text[512];
    size_t length;
} sentence;

static void add(sentence *to, const char *format, double value, const char *after) {
    const int n = snprintf(to->text + to->length, sizeof to->text - to->length, format, value);
    to->length += (size_t)n;
    to->length +=
        (size_t)snprintf(to->text + to->length, sizeof to->text - to->length, "%s", after);
}

/* What cleaning did; nothing of what it did not do. */
static void add_cleaning(sentence *to, const tool_settings *s, const page_plan *plan,
                         const dp_drawing_info *i) {
    const double whole = i->length + i->coincident + i->dropped_length;
    const float least = page_length(plan, &s->min_length);
    if (i->dropped) {
        add(to, "; %.2g %% dropped as shorter than ", 100 * i->dropped_length / whole, "");
        add(to, "%.3g px", least > 0 ? (double)least : 1, "");
    }
    if (i->coincident > 0)
        add(to, "; %.2g %% left out because it lay on other lines", 100 * i->coincident / whole,
            "");
    if (i->joined)
        add(to, "; %.0f", (double)i->joined, i->joined == 1 ? " gap closed" : " gaps closed");
}

void paths_tell(const tool_settings *s, const page_plan *plan, const view_paths *paths,
                const char *assumed) {
    int more;
    const char *const file = first_file(s, &more);
    const dp_drawing_info i = total(plan, paths);
    const double unit = plan->paged ? plan->mm_per_px : 1;
    const char *const name = plan->paged ? " mm" : " px";
    sentence to = {0};
    if (s->quiet && !s->stats) return;
    if (more) add(&to, " and %.0f more", more, "");
    add(&to, ": %.0f", (double)i.paths, i.paths == 1 ? " path" : " paths");
    add(&to, ", %.0f", i.length * unit, name);
    add_cleaning(&to, s, plan, &i);
    if (s->optimize) {
        add(&to, "; the pen travels %.0f", i.travel * unit, name);
        add(&to, " between paths instead of %.0f", i.travel_before * unit, name);
        if (i.travel_before > 0)
            add(&to, ", %.0f %% less", 100 * (1 - i.travel / i.travel_before), "");
    }
    note("%s%s%s%s", file, to.text, assumed ? "; " : "", assumed ? assumed : "");
    if (!i.paths) tell_empty(file);
    if (files_have(s, DP_FORMAT_DXF)) {
        const double mm = plan->mm_per_px;
        note("DXF: a unit is a millimetre; the page is %.4g x %.4g mm%s",
             plan->mm_width > 0 ? plan->mm_width : plan->width * mm,
             plan->mm_height > 0 ? plan->mm_height : plan->height * mm,
             s->scale.paper > 0 || s->sheet.count ? ""
                                                  : "; --scale 1:1 draws the model's own size");
    }
}

/* Have faces another colour than the paper, which vector files do not paint? */
static bool has_faces(const dp_style *style) {
    const dp_color white = DP_RGB(255, 255, 255);
    const dp_color surface = style->surface ? style->surface : white,
                   paper = style->paper ? style->paper : white;
    return surface != paper && surface != DP_COLOR_NONE;
}

static bool is_mixed(dp_color color) { return color && (color & 0xFF) && (color & 0xFF) != 0xFF; }

/* Has any line a colour with alpha? */
static bool has_alpha(const dp_style *style) {
    bool any = false;
    for (int k = 0; k < DP_LINE_COUNT; k++) {
        any |= is_mixed(style->line[k].color);
        for (int level = 0; level < DP_LEVELS; level++)
            any |= is_mixed(style->hidden.line[level][k].color);
    }
    return any;
}

void paths_warn(const tool_settings *s, const dp_style *style) {
    const bool textured = s->stroke || s->pattern || s->taper.value > 0 || s->jitter.value > 0 ||
                          s->overshoot.value > 0 || s->repeats > 1 || s->width_by_depth > 0 ||
                          s->width_by_light > 0;
    const dp_shading shading = style->shade.shading;
    const bool shaded = (shading != DP_SHADING_FLAT && shading != DP_SHADING_PAPER) ||
                        (style->edge_map.detector && !style->edge_map.hidden);
    if (s->quiet) return;
    if (style->ink == DP_INK_QUADS && style->edges != DP_EDGES_ADJACENCY)
        warn("with --ink quads there are no paths: leave it out for vector files");
    else if (style->lines == DP_NO_LINES && s->edges == EDGES_MAP)
        warn("an edge map is of pixels and has no paths: --edges both adds lines");
    else if (textured)
        warn("paths are plain: what --stroke, --pattern and their options do is seen in PNGs only");
    if (shaded && s->ground != GROUND_PNG)
        warn("vector files have no shaded surface: --ground png puts it under the lines");
    else if (has_faces(style) && s->ground != GROUND_PNG)
        warn("vector files have no faces, the paper shows through: --ground png puts them there");
    if (has_alpha(style) && (files_have(s, DP_FORMAT_EPS) || files_have(s, DP_FORMAT_DXF)))
        warn("%s has no transparency: colours with alpha are mixed with the paper's",
             files_have(s, DP_FORMAT_EPS) ? "EPS" : "DXF");
    if (s->has_mirror)
        warn("vector files have no lines of what a mirror shows: only PNGs have them");
}
