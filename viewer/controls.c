/* What the panel shows: the settings that the picture was drawn with, and controls that change them. */
#include "viewer.h"

#include "load.h"
#include "messages.h"
#include "panel.h"

#include <stdio.h>
#include <string.h>

static const double seconds_shown = 6; /* of messages */

static const tool_settings *settings(const viewer *v) { return &v->picture.line.settings; }

/* ------- parts of the panel ------- */

static void model_part(viewer *v) {
    char text[400];
    const dp_extent *const e = &v->model.seen.extent;
    const char *const name = settings(v)->model;
    const char *const slash = name ? strrchr(name, '/') : NULL;
    if (!v->model.source) {
        panel_faint(v->job ? "reading ..." : "no model: drop a file on the window");
        return;
    }
    panel_text(slash ? slash + 1 : name ? name : "");
    snprintf(text, sizeof text, "%llu polygons, %.4g x %.4g x %.4g",
             (unsigned long long)e->polygons, e->exact_max[0] - e->exact_min[0],
             e->exact_max[1] - e->exact_min[1], e->exact_max[2] - e->exact_min[2]);
    panel_faint(text);
}

static void view_part(viewer *v) {
    static const struct {
        const char *label;
        int word;
    } views[] = {{"Front", VIEW_FRONT},  {"Right", VIEW_RIGHT}, {"Top", VIEW_TOP},
                 {"Iso", VIEW_ISO},      {"Back", VIEW_BACK},   {"Left", VIEW_LEFT},
                 {"Bottom", VIEW_BOTTOM}};
    bool orthographic = settings(v)->has_ortho;
    panel_line("View");
    for (size_t k = 0; k < sizeof views / sizeof *views; k++) {
        if (k && k != 4) panel_beside();
        if (panel_button(views[k].label)) act_view(v, views[k].word);
    }
    if (panel_button("Fit")) act_fit(v, 0);
    panel_beside();
    if (panel_check("Orthographic", &orthographic)) act_ortho(v, 0);
}

static void motion_part(viewer *v) {
    double time = v->model.time;
    if (!v->model.moves) return;
    panel_line("Motion");
    if (panel_button(v->playing ? "Stop" : "Play")) act_play(v, 0);
    panel_beside();
    if (panel_slider("##time", &time, 0, v->model.lasts > 0 ? v->model.lasts : 10, "%.2f s")) {
        v->playing = false;
        if (view_free_camera(v)) view_moved(v);
        view_seek(v, time);
    }
}

static void lines_part(viewer *v) {
    static const char *const labels[DP_LINE_COUNT] = {
        "silhouettes", "ridges", "valleys", "crossings", "borders", "sections", "hatching"};
    const uint32_t set = settings(v)->style.lines ? settings(v)->style.lines : DP_ALL_LINES;
    panel_line("Lines, and their widths in pixels");
    for (int k = 0; k < (settings(v)->section.count ? DP_LINE_COUNT : DP_LINE_SECTION); k++) {
        bool on = set >> k & 1;
        char name[40];
        double width = (double)v->picture.style.line[k].width;
        snprintf(name, sizeof name, "##width%d", k);
        if (panel_slider(name, &width, 0.5, 12, "%.1f")) view_set_width(v, k, width);
        panel_beside();
        if (panel_check(labels[k], &on)) act_class(v, k);
    }
}

static void angle(viewer *v, const char *label, const char *name, double now, double usual) {
    double value = now > 0 ? now : usual;
    char text[32];
    if (!panel_slider(label, &value, 1, 359, "%.0f degrees")) return;
    snprintf(text, sizeof text, "%.0f", value);
    view_set(v, name, text);
}

static void detail(viewer *v) {
    static const char words[] = "auto|exact|2|0.5";
    const char *const now = cmdline_get(&v->line.options, "detail");
    char word[32], shown[80];
    const int known = now ? word_index(words, now) : v->line.gl ? 2 : 1;
    int index = known ? known - 1 : 4;
    snprintf(shown, sizeof shown, "auto|exact|2: finer|0.5: coarser%s%s", known ? "" : "|",
             known ? "" : now);
    if (!panel_choice("detail", shown, &index) || index > 3) return;
    snprintf(word, sizeof word, "%s",
             index == 0   ? "auto"
             : index == 1 ? "exact"
             : index == 2 ? "2"
                          : "0.5");
    view_set(v, "detail", word);
}

/* A choice among an option's words; `now` is the word's number, from 1, or 0: `usual`. */
static void choice(viewer *v, const char *label, const char *name, int now, int usual) {
    const char *const words = view_words(name);
    char word[32];
    int index = (now ? now : usual) - 1;
    if (!panel_choice(label, words, &index)) return;
    const char *at = words;
    for (; index > 0; index--) at += strcspn(at, "|") + 1;
    snprintf(word, sizeof word, "%.*s", (int)strcspn(at, "|"), at);
    view_set(v, name, word);
}

static void finding_part(viewer *v) {
    const tool_settings *const s = settings(v);
    double xray = s->xray;
    char text[32];
    angle(v, "ridge angle", "ridge-angle", s->ridge_angle, 150);
    angle(v, "valley angle", "valley-angle", s->valley_angle, 210);
    detail(v);
    choice(v, "hidden lines", "hidden", s->hidden, HIDDEN_NONE);
    choice(v, "smooth", "smooth", s->smooth, 1);
    if (panel_slider("x-ray", &xray, 0, 1, xray > 0 && xray < 1 ? "%.2f" : "off")) {
        snprintf(text, sizeof text, "%.2g", xray);
        view_set(v, "xray", xray < 0.01 || xray > 0.99 ? NULL : text);
    }
}

static void look_part(viewer *v) {
    const tool_settings *const s = settings(v);
    const char *const now = cmdline_get(&v->line.options, "preset");
    char words[256], word[32];
    snprintf(words, sizeof words, "none|%s", view_words("preset"));
    int index = now ? word_index(words, now) - 1 : 0;
    panel_line("Look");
    if (panel_choice("preset", words, &index)) {
        const char *at = words;
        for (int k = index; k > 0; k--) at += strcspn(at, "|") + 1;
        snprintf(word, sizeof word, "%.*s", (int)strcspn(at, "|"), at);
        view_preset(v, index ? word : NULL);
    }
    choice(v, "surfaces", "style", s->shading, SHADING_FLAT);
    choice(v, "edge map", "edges", s->edges, 1);
}

static void file_part(viewer *v) {
    char text[160];
    panel_line(NULL);
    if (panel_button("Save PNG")) act_save_png(v, 0);
    panel_beside();
    if (panel_button("Save SVG")) act_save_svg(v, 0);
    panel_beside();
    if (panel_button("Copy command")) act_copy(v, 0);
    if (panel_button(v->line.gl ? "Draw by the processor" : "Draw by OpenGL")) act_backend(v, 0);
    panel_beside();
    if (panel_button("Reset")) act_reset(v, 0);
    panel_beside();
    if (panel_button("?")) act_help(v, 0);
    snprintf(text, sizeof text, "%u x %u: %.1f ms, %llu segments%s", v->picture.width,
             v->picture.height, v->picture.ms, (unsigned long long)v->picture.segments,
             v->quality ? ", for now" : "");
    panel_faint(text);
}

static void side_panel(viewer *v) {
    panel_side("Drypoint", 330);
    model_part(v);
    if (v->model.source) {
        view_part(v);
        motion_part(v);
        lines_part(v);
        finding_part(v);
        look_part(v);
        file_part(v);
    }
    panel_close();
}

/* ------- the other windows ------- */

static void help_box(viewer *v) {
    key_row row;
    if (!panel_box("Keys")) v->help = false;
    for (int k = 0; keys_row(k, &row); k++) panel_row(row.keys, row.about);
    panel_close();
}

static void reading_box(const viewer *v) {
    char text[400];
    const char *const name = v->reading.model_count ? v->reading.models[0] : "";
    const char *const slash = strrchr(name, '/');
    snprintf(text, sizeof text, "Reading %.300s%s", slash ? slash + 1 : name,
             v->reading.model_count > 1 ? " and others" : "");
    panel_note(true);
    panel_bar(load_fraction(), text);
    panel_close();
}

/* Those of the last seconds; while there is no model, all: they say why. */
static void message_box(const viewer *v) {
    message all[MESSAGES_KEPT];
    const int count = messages_copy(all);
    int first = count;
    while (first > 0 && first > count - 5 &&
           (!v->model.source || view_now() - all[first - 1].time < seconds_shown))
        first--;
    if (first == count) return;
    panel_note(false);
    for (int k = first; k < count; k++) panel_text(all[k].text);
    panel_close();
}

void controls_show(viewer *v) {
    panel_begin();
    if (v->panel) side_panel(v);
    if (v->help) help_box(v);
    if (v->job) reading_box(v);
    if (!v->job && !v->model.source) {
        panel_note(true);
        panel_text("Drop a model on the window.");
        panel_close();
    }
    message_box(v);
    panel_end();
}
