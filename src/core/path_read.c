/* Reads a camera's path from JSON.
 *
 *     path   an array of views, or {"views": [view, …]}
 *     view   {"time": s, "eye": [x, y, z], "target": [x, y, z], "up": [x, y, z],
 *             "fov": degrees, or "height": world units}
 *
 * A mistake is told with its line: that of the member's name, which lies in the text as it stands. */
#include <drypoint/path.h>

#include "base/arena.h"
#include "base/diag.h"
#include "base/json.h"
#include "core/path.h"

#include <stdint.h>
#include <string.h>

typedef struct reader {
    const char *text;
    size_t size;
    dp_diag *diag;
    uint32_t view; /* that is read, from 0 */
} reader;

/* 0: the name does not lie in the text (it is written with escapes). */
static uint64_t line_of(const reader *r, const dp_json *member) {
    const uintptr_t begin = (uintptr_t)r->text, at = member ? (uintptr_t)member->name : 0;
    if (!member || !member->name || at < begin || at >= begin + r->size) return 0;
    uint64_t line = 1;
    for (const char *c = r->text; c < member->name; c++) line += *c == '\n';
    return line;
}

/* The first member's line is the view's. */
static const dp_json *first_member(const dp_json *view) {
    return view->kind == DP_JSON_OBJECT && view->count ? &view->as.items[0] : NULL;
}

static dp_result refuse(const reader *r, const dp_json *member, const char *what) {
    return dp_fail_line(r->diag, DP_ERR_FORMAT, line_of(r, member), "view %u of the path %s",
                        (unsigned)r->view + 1, what);
}

/* ---- members ---- */

static bool is_known(const dp_json *member) {
    static const char *const names[] = {"time", "eye", "target", "up", "fov", "height"};
    for (size_t k = 0; k < sizeof names / sizeof *names; k++)
        if (member->name_size == strlen(names[k]) &&
            !memcmp(member->name, names[k], member->name_size))
            return true;
    return false;
}

static dp_result check_names(const reader *r, const dp_json *view) {
    for (uint32_t i = 0; i < view->count; i++) {
        const dp_json *const member = &view->as.items[i];
        if (is_known(member)) continue;
        const int length = member->name_size < 40 ? (int)member->name_size : 40;
        return dp_fail_line(r->diag, DP_ERR_FORMAT, line_of(r, member),
                            "view %u of the path has a \"%.*s\"; known are time, eye, target, up, "
                            "fov and height",
                            (unsigned)r->view + 1, length, member->name);
    }
    return DP_OK;
}

/* Reads a number where there is one. */
static dp_result read_value(const reader *r, const dp_json *view, const char *name,
                            const char *otherwise, double *value) {
    const dp_json *const member = dp_json_find(view, name);
    if (!member) return DP_OK;
    if (member->kind != DP_JSON_NUMBER) return refuse(r, member, otherwise);
    *value = member->as.number;
    return DP_OK;
}

/* Reads a point where there is one. */
static dp_result read_point(const reader *r, const dp_json *view, const char *name,
                            const char *otherwise, double point[3]) {
    const dp_json *const member = dp_json_find(view, name);
    if (!member) return DP_OK;
    if (dp_json_count(member) != 3) return refuse(r, member, otherwise);
    for (uint32_t k = 0; k < 3; k++) {
        const dp_json *const item = dp_json_item(member, k);
        if (item->kind != DP_JSON_NUMBER) return refuse(r, member, otherwise);
        point[k] = item->as.number;
    }
    return DP_OK;
}

/* ---- views ---- */

static dp_result check_range(const reader *r, const dp_json *view) {
    const dp_json *const fov = dp_json_find(view, "fov"), *const height =
                                                              dp_json_find(view, "height");
    if (fov && height)
        return refuse(r, height,
                      "has a fov and a height; a fov is of perspective, a height of "
                      "none: leave one out");
    if (fov && !(fov->as.number > 0 && fov->as.number < 180))
        return refuse(r, fov, "has a fov that is not between 0 and 180 degrees");
    if (height && !(height->as.number > 0)) return refuse(r, height, "has a height not above 0");
    return DP_OK;
}

static dp_result read_view(const reader *r, const dp_json *view, dp_key_view *v) {
    *v = (dp_key_view){.time = r->view};
    if (view->kind != DP_JSON_OBJECT)
        return refuse(r, NULL, "is no object; give {\"eye\": [x, y, z], \"target\": [x, y, z]}");
    if (!dp_json_find(view, "eye") || !dp_json_find(view, "target"))
        return refuse(r, first_member(view), "needs an \"eye\" and a \"target\"");
    dp_result result = check_names(r, view);
    if (!result) result = read_value(r, view, "time", "has a time that is no number", &v->time);
    if (!result)
        result = read_point(r, view, "eye", "has an eye that is not three numbers", v->eye);
    if (!result)
        result = read_point(r, view, "target", "has a target that is not three numbers", v->target);
    if (!result) result = read_point(r, view, "up", "has an up that is not three numbers", v->up);
    if (!result) result = read_value(r, view, "fov", "has a fov that is no number", &v->fov_y);
    if (!result)
        result = read_value(r, view, "height", "has a height that is no number", &v->height);
    return result ? result : check_range(r, view);
}

/* All views have a time, or none has. */
static dp_result check_times(reader *r, const dp_json *views) {
    const bool given = dp_json_find(dp_json_item(views, 0), "time") != NULL;
    for (r->view = 1; r->view < views->count; r->view++) {
        const dp_json *const view = dp_json_item(views, r->view);
        if ((dp_json_find(view, "time") != NULL) != given)
            return refuse(r, first_member(view),
                          given
                              ? "has no time, as the first has; give all views one, or none"
                              : "has a time, and the first has none; give all views one, or none");
    }
    return DP_OK;
}

static dp_result read_views(reader *r, const dp_json *views, dp_key_view *keys) {
    for (r->view = 0; r->view < views->count; r->view++) {
        const dp_json *const view = dp_json_item(views, r->view);
        const dp_result result = read_view(r, view, &keys[r->view]);
        if (result) return result;
        const char *const wrong =
            dp_key_view_mistake(&keys[r->view], r->view ? &keys[r->view - 1] : NULL);
        if (wrong) return refuse(r, first_member(view), wrong);
    }
    return DP_OK;
}

static dp_result find_views(const reader *r, const dp_json *root, const dp_json **views) {
    *views = root->kind == DP_JSON_OBJECT ? dp_json_find(root, "views") : root;
    if (!*views || (*views)->kind != DP_JSON_ARRAY)
        return dp_fail_line(r->diag, DP_ERR_FORMAT, 1,
                            "there are no views; give {\"views\": [{\"eye\": [x, y, z], "
                            "\"target\": [x, y, z]}, ...]}");
    if ((*views)->count) return DP_OK;
    return dp_fail_line(r->diag, DP_ERR_FORMAT, line_of(r, *views), "the path has no view");
}

static dp_result read_tree(reader *r, const dp_json *root, const double up[3], dp_arena *arena,
                           const dp_allocator *allocator, dp_camera_path **out) {
    const dp_json *views;
    dp_result result = find_views(r, root, &views);
    if (result) return result;
    dp_key_view *const keys = dp_arena_take(arena, views->count, sizeof *keys);
    if (!keys) return dp_fail(r->diag, DP_ERR_MEMORY, "out of memory for a path");
    result = read_views(r, views, keys);
    if (!result) result = check_times(r, views);
    return result ? result : dp_camera_path_create(keys, views->count, up, allocator, out, r->diag);
}

dp_result dp_camera_path_read(const char *text, size_t size, const double up[3],
                              const dp_allocator *allocator, dp_camera_path **out, dp_diag *diag) {
    if (!out || (!text && size))
        return dp_fail(diag, DP_ERR_ARGUMENT, "dp_camera_path_read: text or out is NULL");
    *out = NULL;
    reader r = {.text = text, .size = size, .diag = diag};
    const dp_json *root = NULL;
    dp_arena arena = {.memory = dp_allocator_resolve(allocator)};
    dp_result result = dp_json_parse(text, size, &arena, &root, diag);
    if (!result) result = read_tree(&r, root, up, &arena, allocator, out);
    dp_arena_free(&arena);
    return result;
}
