/* Which of a model's objects are drawn, where, and in which style.
 *
 *     --only, --without, --object NAME:hide    which
 *     --explode                                where
 *     --object NAME:color=...                  in which style: that of the picture, over which the object's own
 *                                              settings are laid in their order
 *
 * Names are looked for in the model once, as it is at time 0 and before it is cut: one that fits nothing is an
 * error. Then, too, it is found where parts go, so that these neither depend on the section nor on the time. */
#include "objects.h"
#include "colors.h"
#include "page.h"
#include "report.h"

#include <stdlib.h>
#include <string.h>

bool objects_asked(const tool_settings *s) {
    return s->only.count || s->without.count || s->objects.count || s->has_explode || s->list;
}

/* ---- names ---- */

static bool are_known(const tool_settings *s, dp_source *source, const object_list *list,
                      const char *option_name, const text_list *names) {
    for (uint32_t k = 0; k < names->count; k++) {
        const char *const text = names->items[k];
        if (!object_names_known(s, source, list, option_name, text, text + strlen(text)))
            return false;
    }
    return true;
}

static bool all_known(const tool_settings *s, dp_source *source, const object_list *list) {
    for (uint32_t k = 0; k < s->objects.count; k++) {
        const char *const text = s->objects.items[k], *end, *settings;
        object_split(text, &end, &settings);
        if (!object_names_known(s, source, list, "object", text, end)) return false;
    }
    return are_known(s, source, list, "only", &s->only) &&
           are_known(s, source, list, "without", &s->without);
}

static bool is_listed(const text_list *names, const char *name) {
    for (uint32_t k = 0; k < names->count; k++)
        if (object_names_fit(name, names->items[k], names->items[k] + strlen(names->items[k])))
            return true;
    return false;
}

/* Lays over the settings what objects of that name have of their own. */
static void lay_over(const tool_settings *s, const char *name, tool_settings *own, bool *hide,
                     bool *any) {
    for (uint32_t k = 0; k < s->objects.count; k++) {
        const char *const text = s->objects.items[k], *end, *settings;
        object_split(text, &end, &settings);
        if (!object_names_fit(name, text, end)) continue;
        *hide |= object_apply(text, own);
        *any = true;
    }
}

/* ---- which, and where ---- */

static bool is_left_out(const tool_settings *s, const char *name) {
    if (s->only.count && !is_listed(&s->only, name)) return true;
    if (is_listed(&s->without, name)) return true;
    tool_settings own = *s;
    bool hide = false, any = false;
    lay_over(s, name, &own, &hide, &any);
    return hide;
}

/* Marks what is left out; the number of groups that are not. */
static uint32_t leave_out(const tool_settings *s, const dp_source *source, const object_list *list,
                          dp_placement *placements) {
    uint32_t left = 0;
    for (uint32_t g = 0; g < list->count; g++) {
        if (!list->groups[g].polygons) continue;
        placements[g].hidden = is_left_out(s, dp_source_group_name(source, g));
        left += !placements[g].hidden;
    }
    return left;
}

static int explode(const tool_settings *s, const dp_source *source, const object_list *list,
                   dp_placement *placements) {
    dp_explosion explosion = {.factor = s->explode};
    dp_diag diag = {0};
    bool moved = false;
    if (s->explode_axis) explosion.axis[s->explode_axis - 1] = 1;
    if (dp_source_explode(source, list->groups, list->count, &explosion, placements, &diag))
        return report_failure(NULL, &diag);
    for (uint32_t g = 0; g < list->count; g++)
        for (int k = 0; k < 3; k++) moved |= placements[g].offset[k] != 0;
    if (!moved && s->explode > 0 && !s->quiet)
        warn("--explode changes nothing: no part lies away from the model's centre%s",
             s->explode_axis ? " along that axis" : "");
    return 0;
}

static bool changes_anything(const dp_placement *placements, uint32_t count) {
    for (uint32_t g = 0; g < count; g++)
        if (placements[g].hidden || placements[g].offset[0] != 0 || placements[g].offset[1] != 0 ||
            placements[g].offset[2] != 0)
            return true;
    return false;
}

static int place(const tool_settings *s, const dp_source *source, const object_list *list,
                 object_places *places) {
    if (!list->count) return 0;
    places->at = calloc(list->count, sizeof *places->at);
    places->count = list->count;
    if (!places->at) {
        wrong_usage("out of memory for the objects of a model");
        return EXIT_FAILED;
    }
    if (!leave_out(s, source, list, places->at)) {
        wrong_usage("%s: nothing is left of it; leave out some of --only, --without and hide",
                    s->model);
        return EXIT_FAILED;
    }
    return s->has_explode ? explode(s, source, list, places->at) : 0;
}

int objects_place(const tool_settings *s, dp_source *source, object_places *places) {
    object_list list = {0};
    if (!objects_asked(s)) return 0;
    int code = object_list_read(s, source, &list);
    if (!code && !all_known(s, source, &list)) code = EXIT_FAILED;
    if (!code) code = place(s, source, &list, places);
    object_list_free(&list);
    return code;
}

int objects_arrange(const object_places *places, dp_source **source) {
    dp_source *out;
    dp_diag diag = {0};
    if (!changes_anything(places->at, places->count)) return 0;
    if (dp_source_arrange(*source, places->at, places->count, NULL, &out, &diag))
        return report_failure(NULL, &diag);
    *source = out;
    return 0;
}

void objects_places_free(object_places *places) {
    free(places->at);
    *places = (object_places){0};
}

/* ---- styles ---- */

/* The style that an object's settings make. */
static bool make_own(const tool_settings *s, const tool_settings *own, const page_plan *plan,
                     const dp_style *picture, dp_style *style) {
    *style = make_style(own);
    style->hidden.look = picture->hidden.look;
    if (!page_widths(own, plan, style)) return false;
    if (s->edges == EDGES_MAP || s->edges == EDGES_NONE) style->lines = DP_NO_LINES;
    style->shade.model_colors = picture->shade.model_colors && !own->style.surface;
    if (!own->style.surface)
        style->surface = picture->surface;
    else if (style->surface != DP_COLOR_NONE)
        style->surface =
            color_over(style->surface, picture->paper ? picture->paper : DP_RGB(255, 255, 255));
    return true;
}

static bool is_styled(const tool_settings *s, const char *name) {
    tool_settings own = *s;
    bool hide = false, any = false;
    lay_over(s, name, &own, &hide, &any);
    return any;
}

/* An object of which a section leaves nothing may be there at another time. */
static uint32_t count_styles(const tool_settings *s, const dp_source *source,
                             const object_list *list) {
    uint32_t count = 0;
    for (uint32_t g = 0; g < OBJECTS_MOST; g++) {
        const char *const name = dp_source_group_name(source, g);
        const bool seen = g < list->count && list->groups[g].polygons;
        if ((name || seen) && is_styled(s, name)) count = g + 1;
    }
    return count;
}

/* Fills in the styles, those of other groups with the picture's. */
static bool fill_styles(const tool_settings *s, const dp_source *source, const page_plan *plan,
                        const dp_style *picture, object_styles *styles) {
    bool told = s->quiet;
    for (uint32_t g = 0; g < styles->count; g++) {
        tool_settings own = *s;
        bool hide = false, any = false;
        own.style.surface = 0; /* what is there afterwards is the object's */
        own.quiet = told;      /* warnings on widths once */
        lay_over(s, dp_source_group_name(source, g), &own, &hide, &any);
        styles->styles[g] = *picture;
        if (!any) continue;
        if (!make_own(s, &own, plan, picture, &styles->styles[g])) return false;
        told = true;
    }
    return true;
}

int objects_style(const tool_settings *s, dp_source *source, const page_plan *plan,
                  const dp_style *picture, object_styles *styles) {
    object_list list = {0};
    if (!s->objects.count) return 0;
    int code = object_list_read(s, source, &list);
    if (!code) styles->count = count_styles(s, source, &list);
    object_list_free(&list);
    if (code || !styles->count) return code;
    styles->styles = calloc(styles->count, sizeof *styles->styles);
    if (!styles->styles) {
        wrong_usage("out of memory for the styles of %u objects", styles->count);
        return EXIT_FAILED;
    }
    return fill_styles(s, source, plan, picture, styles) ? 0 : EXIT_USAGE;
}

bool objects_without_lines(const object_styles *styles, object_styles *bare) {
    *bare = (object_styles){.count = styles->count};
    if (!styles->count) return true;
    bare->styles = malloc(styles->count * sizeof *bare->styles);
    if (!bare->styles)
        return wrong_usage("out of memory for the styles of %u objects", styles->count);
    memcpy(bare->styles, styles->styles, styles->count * sizeof *bare->styles);
    for (uint32_t g = 0; g < bare->count; g++) bare->styles[g].lines = DP_NO_LINES;
    return true;
}

void objects_free(object_styles *styles) {
    free(styles->styles);
    *styles = (object_styles){0};
}
