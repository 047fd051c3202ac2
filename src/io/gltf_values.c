/* Members of glTF's objects, each checked to be what it must be. */
#include "io/gltf.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static void clean(char *text) {
    for (char *p = text; *p; p++)
        if ((unsigned char)*p < ' ' || *p == 0x7f) *p = '?';
}

bool dp_gltf_fail(dp_gltf *g, dp_result result, const char *format, ...) {
    char text[200];
    va_list arguments;
    if (g->result) return false;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    clean(text);
    g->result = dp_fail(g->diag, result, "%s%s", g->where, text);
    return false;
}

bool dp_gltf_out_of_memory(dp_gltf *g) {
    *g->where = 0;
    return dp_gltf_fail(g, DP_ERR_MEMORY, "out of memory for a glTF file");
}

void dp_gltf_at(dp_gltf *g, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(g->where, sizeof g->where, format, arguments);
    va_end(arguments);
}

void dp_gltf_remark(dp_gltf *g, const char *format, ...) {
    va_list arguments;
    if (*g->remark) return;
    va_start(arguments, format);
    vsnprintf(g->remark, sizeof g->remark, format, arguments);
    va_end(arguments);
    clean(g->remark);
}

bool dp_gltf_member(dp_gltf *g, const dp_json *object, const char *name, dp_json_kind kind,
                    const dp_json **to) {
    static const char *const kinds[] = {"null", "true or false", "a number",
                                        "text", "an array",      "an object"};
    *to = dp_json_find(object, name);
    if (!*to || (*to)->kind == kind) return true;
    return dp_gltf_fail(g, DP_ERR_FORMAT, "\"%s\" must be %s: mend the file, or export it again",
                        name, kinds[kind]);
}

static bool whole(dp_gltf *g, const dp_json *value, const char *name, uint32_t *to) {
    const double number = value->kind == DP_JSON_NUMBER ? value->as.number : -1;
    if (!(number >= 0 && number < UINT32_MAX) || number != (double)(uint32_t)number)
        return dp_gltf_fail(g, DP_ERR_FORMAT, "\"%s\" must be a whole number from 0 to 4294967294",
                            name);
    *to = (uint32_t)number;
    return true;
}

bool dp_gltf_uint(dp_gltf *g, const dp_json *object, const char *name, uint32_t fallback,
                  uint32_t *to) {
    const dp_json *const value = dp_json_find(object, name);
    *to = fallback;
    return !value || whole(g, value, name, to);
}

bool dp_gltf_index_of(dp_gltf *g, const dp_json *value, const char *name, const dp_json *among,
                      const char *what, uint32_t *to) {
    uint32_t number = 0;
    if (!whole(g, value, name, &number)) return false;
    const uint32_t count = dp_json_count(among);
    if (number >= count)
        return dp_gltf_fail(g, DP_ERR_FORMAT,
                            count ? "\"%s\" names %s %u, but %u is the last: mend the file"
                                  : "\"%s\" names %s %u, but the file has none: mend the file",
                            name, what, number, count - 1);
    *to = number + 1;
    return true;
}

bool dp_gltf_index(dp_gltf *g, const dp_json *object, const char *name, const dp_json *among,
                   const char *what, uint32_t *to) {
    const dp_json *const value = dp_json_find(object, name);
    *to = 0;
    return !value || dp_gltf_index_of(g, value, name, among, what, to);
}

bool dp_gltf_numbers(dp_gltf *g, const dp_json *object, const char *name, uint32_t count,
                     double *to, bool *has) {
    const dp_json *array;
    *has = false;
    if (!dp_gltf_member(g, object, name, DP_JSON_ARRAY, &array)) return false;
    if (!array) return true;
    bool sound = array->count == count;
    for (uint32_t i = 0; sound && i < count; i++) {
        sound = array->as.items[i].kind == DP_JSON_NUMBER;
        to[i] = sound ? array->as.items[i].as.number : 0;
    }
    if (!sound) return dp_gltf_fail(g, DP_ERR_FORMAT, "\"%s\" must be %u numbers", name, count);
    return *has = true;
}

const char *dp_gltf_name(dp_gltf *g, const dp_json *object, const char *table, uint32_t number) {
    enum { LONGEST = 1000 };
    const dp_json *const name = dp_json_find(object, "name");
    char made[40];
    const char *text = made;
    size_t size = (size_t)snprintf(made, sizeof made, "%s[%u]", table, number);
    if (name && name->kind == DP_JSON_STRING && name->as.string.size) {
        text = name->as.string.text;
        size = name->as.string.size < LONGEST ? name->as.string.size : LONGEST;
    }
    char *const copy = dp_arena_take(&g->arena, size + 1, 1);
    if (!copy) dp_gltf_out_of_memory(g);
    if (copy) memcpy(copy, text, size);
    return copy;
}
