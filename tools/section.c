/* --clip and --section-...: from settings to a model that is cut open. */
#include "section.h"
#include "commands.h"
#include "models.h"
#include "progress.h"
#include "report.h"

#include <math.h>
#include <string.h>

static const char *end_of(const char *text) { return text + strlen(text); }

/* ---- options ---- */

/* Reads three numbers, or four; how many. 0: something else. */
static int read_numbers(const char *value, double to[4]) {
    const char *at = value;
    for (int count = 0; count < 4;) {
        const char *const end = at + strcspn(at, ",");
        if (!read_number(at, end, &to[count++])) return 0;
        if (!*end) return count;
        at = end + 1;
    }
    return 0;
}

bool store_clip(const option *o, const char *value, tool_settings *settings) {
    tool_section *const to = &settings->section;
    double n[4] = {0};
    if (to->count == DP_CLIP_PLANES)
        return wrong_usage("--%s: %s is one plane too many; %d are the most", o->name, value,
                           DP_CLIP_PLANES);
    const int count = read_numbers(value, n);
    if (count < 3)
        return wrong_usage(
            "--%s: \"%s\" is not a plane; give three or four numbers: 0,0,1,2.5 takes "
            "away what lies above z = 2.5",
            o->name, value);
    const double square = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
    if (!(square > 0) || !isfinite(square) || !isfinite(n[3]))
        return wrong_usage("--%s: the normal of %s has no direction; give one like 0,0,1", o->name,
                           value);
    memcpy(to->plane[to->count], n, sizeof n);
    to->has_offset[to->count++] = count == 4;
    return true;
}

bool store_spacing(const option *o, const char *value, tool_section *to) {
    const char *const end = end_of(value);
    const bool share = end > value && end[-1] == '%';
    double number;
    if (!read_number(value, end - share, &number))
        return wrong_usage(
            "--%s: \"%s\" is no distance; give one in the model's units, or like 2%% "
            "of its size",
            o->name, value);
    if (!(number > 0) || !isfinite(number) || (share && number > 100))
        return wrong_usage("--%s: %s is out of range; give one above 0%s", o->name, value,
                           share ? ", and at most 100%" : "");
    to->spacing = share ? 0 : number;
    to->share = share ? number / 100 : 0;
    return true;
}

/* ---- models ---- */

/* Where a plane lies that has no offset: in the middle of the model's box. */
static dp_result find_middle(dp_source *source, double middle[3], dp_diag *diag) {
    dp_extent extent;
    const dp_result result = dp_source_extent(source, &extent, diag);
    for (int k = 0; k < 3; k++)
        middle[k] = result ? 0 : (extent.exact_min[k] + extent.exact_max[k]) / 2;
    return result;
}

static bool needs_middle(const tool_section *s) {
    bool any = false;
    for (uint32_t k = 0; k < s->count; k++) any |= !s->has_offset[k];
    return any;
}

static dp_clip clip_of(const tool_section *s, const double middle[3]) {
    dp_clip clip = {.plane_count = s->count,
                    .look = s->look ? (dp_section_look)(s->look - 1) : DP_SECTION_HATCHED,
                    .hatch_angle = s->has_angle ? (s->angle != 0 ? s->angle : 180) : 0,
                    .hatch_spacing = s->spacing,
                    .hatch_share = s->share};
    for (uint32_t k = 0; k < s->count; k++) {
        const double *const n = s->plane[k];
        const double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        const double through = (n[0] * middle[0] + n[1] * middle[1] + n[2] * middle[2]) / length;
        memcpy(clip.planes[k].normal, n, sizeof clip.planes[k].normal);
        clip.planes[k].offset = s->has_offset[k] ? n[3] / length : through;
    }
    return clip;
}

static int cannot_read_twice(const tool_settings *s) {
    wrong_usage(
        "%s can be read only once, so its middle is not known; give --clip a fourth number, the "
        "plane's distance from 0",
        model_spoken(s->model));
    return EXIT_FAILED;
}

int open_section(const tool_settings *s, dp_source **source) {
    const tool_section *const section = &s->section;
    double middle[3] = {0};
    dp_diag diag = {0};
    dp_source *cut = NULL;
    if (!section->count) return 0;
    int code = 0;
    dp_result result = DP_OK;
    if (needs_middle(section)) {
        if (!dp_source_rewindable(*source)) code = cannot_read_twice(s);
        progress_begin("reading", s->quiet);
        if (!code) result = find_middle(*source, middle, &diag);
        progress_end();
    }
    const dp_clip clip = clip_of(section, middle);
    if (!code && !result) result = dp_source_clip(*source, &clip, NULL, &cut, &diag);
    if (result) code = report_model(s, &diag);
    if (code) dp_source_destroy(*source);
    *source = cut;
    return code;
}
