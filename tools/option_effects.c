/* Says once which of the options that the user gave change nothing beside the others. Presets' own
 * options are no one's mistake and are never told of.
 *
 * The rules are data: what must be so for some options to count, and what to say if it is not. An
 * option is told of by the first rule that it breaks. */
#include "files.h"
#include "film.h"
#include "objects.h"
#include "options.h"
#include "report.h"

#include <stdio.h>
#include <string.h>

/* ---- what a run draws ---- */

static bool by_adjacency(const tool_settings *s) { return s->edges == EDGES_ADJACENCY; }
static bool has_quads(const tool_settings *s) {
    return s->ink ? s->ink == INK_QUADS : by_adjacency(s);
}
static bool has_quads_alone(const tool_settings *s) { return has_quads(s) && !by_adjacency(s); }
static bool has_table(const tool_settings *s) { return !has_quads(s) && !by_adjacency(s); }

static bool finds_lines(const tool_settings *s) {
    return s->edges != EDGES_MAP && s->edges != EDGES_NONE;
}
static bool has_lines(const tool_settings *s) { return s->style.lines != DP_NO_LINES; }
static bool has_class(const tool_settings *s, unsigned set) {
    return !s->style.lines || s->style.lines & set;
}
static bool has_ridges(const tool_settings *s) {
    /* with quads a border is a ridge */
    return has_class(s, has_quads(s) ? DP_RIDGE | DP_BORDER : DP_RIDGE);
}
static bool has_valleys(const tool_settings *s) { return has_class(s, DP_VALLEY); }
static bool has_outlines_or_creases(const tool_settings *s) {
    return has_class(s, DP_SIL_RIDGE_VALLEY);
}

static bool has_hidden(const tool_settings *s) {
    return s->hidden ? s->hidden != HIDDEN_NONE : s->sheet.count > 0;
}
static bool tells_levels(const tool_settings *s) { return !xray_asked(s); }
static bool has_title(const tool_settings *s) { return s->sheet.count || files_have_paths(s); }
static bool has_ground(const tool_settings *s) {
    return files_have(s, DP_FORMAT_SVG) || files_have(s, DP_FORMAT_PDF) ||
           files_have(s, DP_FORMAT_EPS);
}

static bool has_smooth(const tool_settings *s) { return s->smooth > 1; /* 1: off */ }
static bool has_pens(const tool_settings *s) { return !has_quads_alone(s); }
static bool has_texture(const tool_settings *s) { return s->stroke || s->pattern; }
static bool has_stroke(const tool_settings *s) { return s->stroke && !s->pattern; }
static bool has_pattern(const tool_settings *s) { return s->pattern != NULL; }
static bool has_line_light(const tool_settings *s) { return s->line_light > 1; /* 1: off */ }
static bool mixes_light(const tool_settings *s) { return s->line_light != 4; /* gooch */ }
static bool is_polar(const tool_settings *s) {
    return s->stroke_u ? s->stroke_u == STROKE_POLAR : has_quads(s);
}
static bool has_errors(const tool_settings *s) {
    /* dashes and ornaments are all alike, and so are a PNG's strokes */
    const char *const name = s->pattern ? s->pattern : s->stroke;
    return (name && word_index("pencil|brush|charcoal|ink", name)) || s->jitter.value > 0 ||
           s->repeats > 1;
}

static bool has_pens_or_pattern(const tool_settings *s) { return has_pens(s) || s->pattern; }
static bool has_natural_length(const tool_settings *s) {
    return !s->pattern_length.unit && !(s->pattern_units > 0);
}

static bool is_paper(const tool_settings *s) { return s->shading == SHADING_PAPER; }
static bool is_shaded(const tool_settings *s) { return s->shading > SHADING_FLAT; }
static bool is_lit(const tool_settings *s) { return is_shaded(s) || has_line_light(s); }
static bool has_color(const tool_settings *s) { return !is_paper(s); }
static bool is_gooch(const tool_settings *s) { return s->shading == SHADING_GOOCH; }
static bool is_toon(const tool_settings *s) { return s->shading == SHADING_TOON; }
static bool is_pencil(const tool_settings *s) { return s->shading == SHADING_PENCIL; }
static bool is_hatched(const tool_settings *s) {
    return s->shading == SHADING_HATCH || s->shading == SHADING_HALFTONE;
}
static bool has_surface(const tool_settings *s) { return !is_gooch(s) || !s->gooch_plain; }
static bool has_strokes(const tool_settings *s) { return is_hatched(s) || is_pencil(s); }
static bool has_powers(const tool_settings *s) { return !s->pencil_tones; }
static bool has_highlight(const tool_settings *s) {
    return s->shading >= SHADING_LAMBERT && s->shading <= SHADING_TOON;
}

static bool is_exploded(const tool_settings *s) { return s->explode > 0; }
static bool is_listing(const tool_settings *s) { return s->list; }
static bool has_section(const tool_settings *s) { return s->section.count; }
static bool has_hatching(const tool_settings *s) { return s->section.look <= 2; }
static bool has_faces(const tool_settings *s) { return s->section.look != 4; }
static bool has_mirror(const tool_settings *s) { return s->has_mirror; }
static bool has_tint(const tool_settings *s) {
    return s->mirror_tint_share > 0 || !s->has_mirror_tint_share;
}

static bool draws_map(const tool_settings *s) {
    return s->edges ? s->edges == EDGES_MAP || s->edges == EDGES_BOTH : s->edge_map > 0;
}
static bool makes_map(const tool_settings *s) { return draws_map(s) || s->wants_edge_map; }
static bool is_c1(const tool_settings *s) { return s->edge_map == EDGE_MAP_C1; }
static bool is_scaled(const tool_settings *s) { return s->edge_measure != MEASURE_PAPER; }
static bool has_normals(const tool_settings *s) {
    return is_shaded(s) || makes_map(s) || s->outputs[PLANE_NORMALS] || has_smooth(s);
}

static bool has_morph(const tool_settings *s) { return s->morph != NULL; }
/* Only breathing begins at rest. */
static bool is_deformed(const tool_settings *s) {
    return s->command == COMMAND_BENCH || s->deform.kind != DP_DEFORM_BREATHE ||
           (s->has_time && (s->time[0] != 0 || film_wanted(s)));
}

static bool is_terrain(const tool_settings *s) { return !strcmp(s->model, "terrain"); }

/* ---- the rules ---- */

typedef struct rule {
    const char *options; /* names */
    bool (*works)(const tool_settings *s);
    const char *otherwise;
} rule;

#define STROKES "stroke|taper|jitter|overshoot|repeats|width-by-depth|width-by-light"

#define PATTERNS "pattern|pattern-length|pattern-units|pattern-space|line-light|lit-color"

static const rule drawing_rules[] = {
    {STROKES "|stroke-u|stroke-k|stroke-scale|seed|" PATTERNS, finds_lines,
     "an edge map is of pixels and has no strokes; --edges both draws lines with them as well"},
    {"lines|width|color|ridge-angle|valley-angle|detail|hidden|levels|hidden-smooth|hidden-width|"
     "hidden-color|ink|method|between|edge-table",
     finds_lines, "--edges map and none draw no such lines; --edges both adds them"},
    {STROKES "|stroke-u|stroke-k|stroke-scale|seed|" PATTERNS
             "|width|color|ridge-angle|valley-angle|detail|hidden|"
             "levels|hidden-smooth|hidden-width|hidden-color|ink|method|between|edge-table",
     has_lines, "no lines are drawn; leave out --lines none"},
    {"detail", has_pens, "with --ink quads the added polygons are the lines; leave it out"},
    {"detail", has_outlines_or_creases,
     "borders and intersections are all drawn; add others to --lines"},
    {"smooth-what", has_smooth, "nothing is smoothed; add --smooth auto"},
    {"ridge-angle", has_ridges, "no ridges are drawn; add them to --lines"},
    {"valley-angle", has_valleys, "no valleys are drawn; add them to --lines"},
    {"levels|hidden-smooth|hidden-width|hidden-color", has_hidden,
     "hidden lines are not drawn; add --hidden dashed"},
    {"levels", tells_levels, "an x-ray's lines have as many levels as --xray-layers; leave it out"},
    {"xray-layers", xray_asked, "surfaces are opaque; add --xray 0.5, say"},

    {"join|min-length|tolerance|join-classes|keep-coincident|optimize|ground", files_have_paths,
     "no vector file is written; add -o drawing.svg, say"},
    {"ground", has_ground, "only SVG, PDF and EPS files have one; add -o drawing.svg, say"},
    {"title", has_title,
     "a picture has no title; add --sheet front,top,right,iso, say, or write an "
     "SVG or PDF"},

    {STROKES "|stroke-u|stroke-k", has_pens,
     "with --ink quads lines are plain; leave it out for strokes, or add --edges adjacency"},
    {"stroke-scale|seed", has_pens_or_pattern,
     "with --ink quads lines are plain; leave it out for strokes, or add --edges adjacency"},
    {"stroke-u|stroke-k", has_stroke, "lines have no such texture; add --stroke pencil, say"},
    {"stroke-scale", has_texture, "lines have no texture; add --stroke pencil, say"},
    {"pattern-length|pattern-units|pattern-space", has_pattern,
     "lines have no pattern; add --pattern rope, say"},
    {"stroke-scale", has_natural_length, "the pattern's length says it; leave one out"},
    {"lit-color", has_line_light, "no light falls on lines; add --line-light lambert, say"},
    {"lit-color", mixes_light, "--line-light gooch is from cool to warm; leave one out"},
    {"stroke-k", is_polar, "textures lie along the lines; add --stroke-u polar"},
    {"seed", has_errors,
     "strokes have no errors of the hand; add --stroke pencil or --jitter 1, say"},

    {"light", is_lit, "surfaces are not shaded; add --style lambert, say"},
    {"normals|crease-angle", has_normals, "surfaces are not shaded; add --style lambert, say"},
    {"surface|model-colors", has_color, "with --style paper surfaces have the paper's colour"},
    {"surface", has_surface, "--gooch-plain leaves the surface's colour out"},
    {"highlight", has_highlight, "only --style lambert, gooch and toon have highlights"},
    {"gooch-plain", is_gooch, "it is of Gooch shading; add --style gooch"},
    {"shade-texture|cartoon-map", is_toon, "it is of cartoon shading; add --style toon"},
    {"strokes|hatch-scale|hatch-color", has_strokes,
     "it is of hatching; add --style hatch, halftone or pencil"},
    {"hatch-space", is_hatched, "it is of hatching; add --style hatch or halftone"},
    {"pencil-s|pencil-o|pencil-tones|pencil-turns", is_pencil,
     "it is of pencil shading; add --style pencil"},
    {"pencil-s|pencil-o", has_powers, "--pencil-tones stands for it; leave one out"},
    {"section|section-angle|section-spacing|section-color", has_section,
     "nothing is cut open; add --clip 0,0,1, say"},
    {"section-angle|section-spacing", has_hatching,
     "faces have no lines; leave out --section plain or open"},
    {"section-angle|section-spacing", finds_lines,
     "--edges map and none draw no such lines; --edges both adds them"},
    {"section-color", has_faces, "there are no faces; leave out --section open"},
    {"mirror-size|mirror-fade|mirror-tint|mirror-tint-share", has_mirror,
     "there is no mirror; add --mirror 0,1,0, say"},
    {"mirror-tint", has_tint, "--mirror-tint-share is 0; leave it out, or give more"},

    {"edge-map|c1-passes|edge-measure|precision|edge-radius|edge-sides|edge-groups|inner-angle|"
     "inner-softness|profile-depth|profile-softness|inner-color|profile-color|enhance",
     makes_map, "there is no edge map; add --edges both, or --edges map"},
    {"inner-color|profile-color", draws_map, "the edge map is not drawn; add --edges both"},
    {"c1-passes", is_c1, "it is of the C1 operator; add --edge-map c1"},
    {"edge-sides|inner-angle|inner-softness|profile-softness", is_scaled,
     "--edge-measure paper has no thresholds and both sides; leave it out"},

    {"blend", has_morph, "there is nothing to blend with; add --morph MODEL"},
    {"deform", is_deformed, "at time 0 what breathes is at rest; add --time 1, say"},
    {"fps|resume|jobs", film_wanted, "a picture has one frame; add --frames 120, --turn 360, say"},
    {"explode-axis", is_exploded, "nothing is pulled apart; add --explode 1, say"},
    {"json", is_listing,
     "it is of --list and of drypoint info; a drawing's statistics are --stats json"},

    {"method", has_quads, "it is of added polygons; add --ink quads"},
    {"between", has_quads_alone, "it is of added polygons; add --ink quads"},
    {"edge-table", has_table, "only emergent strokes have that table"},
};

static const rule making_rules[] = {{"seed", is_terrain, "only terrains differ by their seed"}};

/* ---- telling ---- */

static const option *find_option(const tool_settings *s, const char *name, size_t length) {
    for (const option *o = option_table; o < option_table + option_count; o++)
        if (o->commands >> s->command & 1 && strlen(o->name) == length &&
            !strncmp(o->name, name, length))
            return o;
    return NULL;
}

bool option_given(const tool_settings *s, const char *name) {
    const option *const o = find_option(s, name, strlen(name));
    return o && s->given[o - option_table];
}

typedef struct names {
    char text[400];
    size_t length;
    int count;
} names;

/* "--a", "--a, --b" */
static void add_name(names *to, const char *name) {
    if (to->length + strlen(name) + 5 > sizeof to->text) return;
    to->length += (size_t)snprintf(to->text + to->length, sizeof to->text - to->length, "%s--%s",
                                   to->count++ ? ", " : "", name);
}

static void apply(const tool_settings *s, const rule *r, bool told[OPTIONS_MOST]) {
    names found = {0};
    if (r->works(s)) return;
    for (const char *at = r->options;;) {
        const size_t length = strcspn(at, "|");
        const option *const o = find_option(s, at, length);
        if (o && s->given[o - option_table] && !told[o - option_table]) {
            told[o - option_table] = true;
            add_name(&found, o->name);
        }
        if (!at[length]) break;
        at += length + 1;
    }
    if (found.count)
        warn("%s change%s nothing: %s", found.text, found.count == 1 ? "s" : "", r->otherwise);
}

/* An edge that is both, as it is if the angles overlap, is drawn once. */
static void check_angles(const tool_settings *s) {
    const double ridge = s->ridge_angle > 0 ? s->ridge_angle : 150,
                 valley = s->valley_angle > 0 ? s->valley_angle : 210;
    if (ridge <= valley || !finds_lines(s) || !has_ridges(s) || !has_valleys(s)) return;
    if (option_given(s, "ridge-angle") || option_given(s, "valley-angle"))
        warn("--ridge-angle %g is above --valley-angle %g: edges between the two are drawn as "
             "ridges",
             ridge, valley);
}

/* With --list only those count that say which model there is, and which objects of it. */
static void warn_of_list(const tool_settings *s) {
    static const char counting[] =
        "list|json|object|only|without|explode|explode-axis|animation|time|"
        "deform|morph|blend|memory|read-time|quiet";
    names found = {0};
    for (const option *o = option_table; o < option_table + option_count; o++)
        if (s->given[o - option_table] && !word_index(counting, o->name)) add_name(&found, o->name);
    if (found.count)
        warn("%s change%s nothing: --list draws nothing; leave it out to draw", found.text,
             found.count == 1 ? "s" : "");
}

void options_warn(const tool_settings *s) {
    bool told[OPTIONS_MOST] = {false};
    if (s->quiet || s->command == COMMAND_INFO) return;
    if (s->list) {
        warn_of_list(s);
        return;
    }
    const bool making = s->command == COMMAND_MAKE;
    const rule *const rules = making ? making_rules : drawing_rules;
    const size_t count =
        making ? sizeof making_rules / sizeof *rules : sizeof drawing_rules / sizeof *rules;
    for (size_t k = 0; k < count; k++) apply(s, &rules[k], told);
    if (!making) check_angles(s);
}
