/* What the page is told, as JSON: what it can set, and what is set. Invariant: an answer stays until the next one. */
#define _GNU_SOURCE /* open_memstream */
#include "page.h"

#include "models.h"
#include "presets.h"
#include "report.h"
#include "sides.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static char *answer;

static FILE *begin(size_t *size) {
    free(answer);
    answer = NULL;
    return open_memstream(&answer, size);
}

static const char *end(FILE *out) {
    if (out) fclose(out);
    return answer ? answer : "null";
}

static void put_text(FILE *out, const char *name, const char *text) {
    fprintf(out, "\"%s\":", name);
    if (text)
        print_json_string(out, text);
    else
        fputs("null", out);
}

static void put_number(FILE *out, const char *name, double value) {
    if (isfinite(value))
        fprintf(out, "\"%s\":%.9g", name, value);
    else
        fprintf(out, "\"%s\":null", name);
}

static void put_truth(FILE *out, const char *name, bool value) {
    fprintf(out, "\"%s\":%s", name, value ? "true" : "false");
}

/* ------- what can be set ------- */

static const char *kind_of(const option *o) {
    switch (o->kind) {
    case OPTION_FLAG:
        return "flag";
    case OPTION_COUNT:
    case OPTION_COUNT64:
        return "count";
    case OPTION_NUMBER:
    case OPTION_INSIDE:
        return "number";
    case OPTION_WORD:
        return "word";
    case OPTION_COLOR:
        return "color";
    case OPTION_COLORS:
    case OPTION_HIDDEN_COLORS:
        return "colors";
    case OPTION_WIDTHS:
    case OPTION_HIDDEN_WIDTHS:
        return "widths";
    case OPTION_LENGTH:
        return "length";
    case OPTION_LINES:
        return "lines";
    case OPTION_DETAIL:
        return "detail";
    default:
        return "text";
    }
}

static void put_option(FILE *out, const option *o) {
    fputc('{', out);
    put_text(out, "name", o->name), fputc(',', out);
    put_text(out, "argument", o->argument), fputc(',', out);
    put_text(out, "kind", kind_of(o)), fputc(',', out);
    put_number(out, "group", o->group), fputc(',', out);
    put_text(out, "groupName", group_names[o->group]), fputc(',', out);
    put_number(out, "least", o->least), fputc(',', out);
    put_number(out, "most", o->most), fputc(',', out);
    put_text(out, "help", o->help);
    fputc('}', out);
}

static void put_options(FILE *out) {
    const char *comma = "";
    fputs("\"options\":[", out);
    for (const option *o = option_table; o < option_table + option_count; o++) {
        if (page_option(o->name) != o) continue;
        fputs(comma, out);
        put_option(out, o);
        comma = ",";
    }
    fputs("],", out);
}

static void put_presets(FILE *out) {
    const char *words = page_option("preset")->argument, *comma = "";
    fputs("\"presets\":[", out);
    while (*words) {
        char name[32];
        const int length = (int)strcspn(words, "|");
        snprintf(name, sizeof name, "%.*s", length, words);
        const preset *const p = preset_find(name);
        fprintf(out, "%s{", comma);
        put_text(out, "name", name), fputc(',', out);
        put_text(out, "options", p ? p->options : "");
        fputc('}', out);
        words += length + (words[length] == '|');
        comma = ",";
    }
    fputs("],", out);
}

static void put_pairs(FILE *out, const char *name, uint32_t count, const char *(*name_of)(uint32_t),
                      const char *(*about)(uint32_t)) {
    fprintf(out, "\"%s\":[", name);
    for (uint32_t k = 0; k < count; k++) {
        fputs(k ? ",{" : "{", out);
        put_text(out, "name", name_of(k)), fputc(',', out);
        put_text(out, "about", about(k));
        fputc('}', out);
    }
    fputs("],", out);
}

/* What the page can show and set; the same all the time. */
EMSCRIPTEN_KEEPALIVE const char *web_info(void) {
    size_t size;
    FILE *const out = begin(&size);
    if (!out) return end(NULL);
    fputc('{', out);
    put_options(out);
    put_presets(out);
    put_pairs(out, "shapes", dp_shape_count(), dp_shape_name, dp_shape_about);
    put_pairs(out, "textures", dp_texture_count(), dp_texture_name, dp_texture_about);
    fprintf(out, "\"version\":\"%d.%d.%d\",", DP_VERSION_MAJOR, DP_VERSION_MINOR, DP_VERSION_PATCH);
    put_number(out, "threads", the_page.threads), fputc(',', out);
#ifdef __wasm_simd128__
    put_truth(out, "simd", true);
#else
    put_truth(out, "simd", false);
#endif
    fputc('}', out);
    return end(out);
}

/* ------- what is set ------- */

static void put_words(FILE *out) {
    const cmd_options *const lists[] = {&the_page.line.options, &the_page.line.camera};
    const char *comma = "";
    fputs("\"words\":{", out);
    for (size_t k = 0; k < 2; k++)
        for (uint32_t i = 0; i < lists[k]->count; i++) {
            const cmd_option *const o = &lists[k]->items[i];
            fputs(comma, out);
            put_text(out, o->name, o->value ? o->value : "");
            comma = ",";
        }
    fputs("},", out);
}

static void put_color(FILE *out, const char *name, dp_color color) {
    if (color == DP_COLOR_NONE)
        fprintf(out, "\"%s\":\"none\"", name);
    else if ((color & 0xFF) == 0xFF || !color)
        fprintf(out, "\"%s\":\"#%06x\"", name, color >> 8);
    else
        fprintf(out, "\"%s\":\"#%08x\"", name, color);
}

static void put_line(FILE *out, const dp_style *style, int k) {
    const uint32_t lines = style->lines ? style->lines : DP_ALL_LINES;
    fprintf(out, "%s\"%s\":{", k ? "," : "", dp_line_name((dp_line)k));
    put_truth(out, "on", lines >> k & 1), fputc(',', out);
    put_number(out, "width", (double)style->line[k].width), fputc(',', out);
    put_color(out, "color", style->line[k].color);
    fputc('}', out);
}

/* The word of an option that has a number from 1; 0: `usual`. */
static void put_word(FILE *out, const char *name, int word, const char *usual) {
    const char *words = page_option(name)->argument;
    for (int k = 1; k < word; k++) words += strcspn(words, "|") + 1;
    if (word)
        fprintf(out, "\"%s\":\"%.*s\"", name, (int)strcspn(words, "|"), words);
    else
        put_text(out, name, usual);
}

/* Values as the last picture has them, presets and defaults included. */
static void put_effective(FILE *out) {
    const picture *const p = &the_page.picture;
    const tool_settings *const s = &p->line.settings;
    const char *const detail = cmdline_get(&the_page.line.options, "detail");
    fputs("\"effective\":{\"lines\":{", out);
    for (int k = 0; k < DP_LINE_COUNT; k++) put_line(out, &p->style, k);
    fputs("},", out);
    put_number(out, "ridgeAngle", s->ridge_angle > 0 ? s->ridge_angle : 150), fputc(',', out);
    put_number(out, "valleyAngle", s->valley_angle > 0 ? s->valley_angle : 210), fputc(',', out);
    put_truth(out, "orthographic", free_camera_is_orthographic(&the_page.camera, &the_page.line)),
        fputc(',', out);
    put_word(out, "style", s->shading, "flat"), fputc(',', out);
    put_word(out, "hidden", s->hidden, "none"), fputc(',', out);
    put_word(out, "preset", s->preset, NULL), fputc(',', out);
    put_word(out, "samples", s->samples, "4"), fputc(',', out);
    put_text(out, "stroke", s->stroke), fputc(',', out);
    put_text(out, "detail", detail ? detail : "auto"), fputc(',', out);
    put_color(out, "paper", s->style.paper ? s->style.paper : DP_RGB(255, 255, 255)),
        fputc(',', out);
    put_color(out, "surface", s->style.surface ? s->style.surface : DP_RGB(255, 255, 255)),
        fputc(',', out);
    put_number(out, "time", the_page.model.time), fputc(',', out);
    put_number(out, "duration", the_page.model.lasts), fputc(',', out);
    put_truth(out, "moves", the_page.model.moves);
    fputs("},", out);
}

static uint32_t count_groups(const dp_source *source) {
    enum { GROUPS = 65536 };
    uint32_t count = 0;
    for (uint32_t k = 0; k < GROUPS; k++) count += dp_source_group_name(source, k) != NULL;
    return count;
}

static void put_up(FILE *out, const tool_settings *s, const dp_source *source) {
    model_sides sides;
    char text[8] = "";
    sides_of(s, source, &sides);
    for (int k = 0; k < 3; k++)
        if (fabs(sides.up[k]) > 0.999)
            snprintf(text, sizeof text, "%s%c", sides.up[k] < 0 ? "-" : "", "xyz"[k]);
    put_text(out, "up", *text ? text : NULL), fputc(',', out);
    put_text(out, "upAssumed", sides_assumed(s, source)), fputc(',', out);
}

static const char *format_of(const char *model) {
    const char *const dot = strrchr(model, '.');
    return !strncmp(model, "shape:", 6) ? "shape" : dot ? dot + 1 : "";
}

static void put_model(FILE *out) {
    const tool_settings *const s = &the_page.picture.line.settings;
    const loaded *const m = &the_page.model;
    fputs("\"model\":{", out);
    put_text(out, "name", s->model), fputc(',', out);
    put_number(out, "polygons", (double)m->seen.extent.polygons), fputc(',', out);
    put_number(out, "vertices", (double)m->seen.extent.vertices), fputc(',', out);
    put_number(out, "groups", count_groups(m->source)), fputc(',', out);
    put_up(out, s, m->source);
    put_text(out, "remark", dp_source_remark(m->source)), fputc(',', out);
    put_text(out, "format", format_of(the_page.line.models[0])), fputc(',', out);
    fputs("\"size\":[", out);
    for (int k = 0; k < 3; k++)
        fprintf(out, "%s%.9g", k ? "," : "",
                m->seen.extent.exact_max[k] - m->seen.extent.exact_min[k]);
    fputs("]}", out);
}

/* The options and the camera alone, as words of a shell: what comes between model and size. */
static char *options_text(void) {
    char *nothing[1] = {NULL};
    cmdline plain = the_page.line;
    plain.models = nothing, plain.model_count = 0;
    char *const text = cmdline_text(&plain, NULL);
    char *const size = text ? strstr(text, " --size ") : NULL;
    if (!size) return text;
    *size = 0;
    const size_t program = strcspn(text, " ");
    memmove(text, text + program + (text[program] == ' '),
            strlen(text + program) + 1 - (text[program] == ' '));
    return text;
}

static void put_command(FILE *out) {
    char stem[STEM_BYTES], file[STEM_BYTES + 8];
    model_stem(the_page.line.model_count ? the_page.line.models[0] : "drawing", stem);
    snprintf(file, sizeof file, "%s.png", stem);
    char *const command = cmdline_text(&the_page.line, file), *const options = options_text();
    put_text(out, "command", command), fputc(',', out);
    put_text(out, "options", options), fputc(',', out);
    free(command);
    free(options);
}

/* All that can be set, as it is now. Effective values are those of the last picture. */
EMSCRIPTEN_KEEPALIVE const char *web_state(void) {
    size_t size;
    FILE *const out = begin(&size);
    if (!out) return end(NULL);
    fputc('{', out);
    put_command(out);
    put_words(out);
    if (the_page.picture.styled) put_effective(out);
    if (the_page.model.source && the_page.picture.styled)
        put_model(out);
    else
        fputs("\"model\":null", out);
    fputc('}', out);
    return end(out);
}
