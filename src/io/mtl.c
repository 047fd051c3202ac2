/* Material libraries (.mtl): of each `newmtl` its `Kd`, the diffuse colour, as written.
 *
 * A bad library never stops a model from being read: what is missing or broken has no colour. Kd
 * with one number is grey; numbers are clamped to [0, 1].
 *
 * Not handled: textures (map_Kd; that there are some is noted), Kd as a spectrum or CIE XYZ, transparency. */
#include "io/mtl.h"

#include "io/beside.h"
#include "io/color.h"
#include "io/text.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { NO_MATERIAL = -1 };

void dp_materials_init(dp_materials *m, const dp_allocator *allocator) {
    *m = (dp_materials){.names = {.allocator = *allocator}};
}

void dp_materials_destroy(dp_materials *m) {
    dp_free(&m->names.allocator, m->colors);
    dp_groups_destroy(&m->names);
}

bool dp_materials_find(dp_materials *m, const char *name, uint16_t *number) {
    if (!dp_groups_find(&m->names, name, number) ||
        !dp_reserve(&m->names.allocator, &m->colors, &m->color_capacity, (size_t)*number + 1,
                    sizeof *m->colors))
        return false;
    while (m->color_count <= *number) m->colors[m->color_count++] = 0;
    return true;
}

uint32_t dp_materials_color(const dp_materials *m, uint16_t number) {
    return number < m->color_count ? m->colors[number] : 0;
}

/* ------- one library ------- */

/* Reads the colour after `Kd`; 0 if there is none. */
static uint32_t read_color(dp_stream *stream) {
    float rgb[3] = {0, 0, 0};
    int n = 0;
    while (n < 3 && dp_text_blank(stream) && dp_text_float(stream, &rgb[n])) {
        if (isnan(rgb[n])) return 0;
        n++;
    }
    const bool grey = n == 1 && (!dp_text_blank(stream) || *stream->cursor == '#');
    if (grey) rgb[1] = rgb[2] = rgb[0];
    return grey || n == 3 ? dp_color_of(rgb, 1) : 0;
}

bool dp_read_mtl(dp_stream *stream, dp_materials *materials) {
    int32_t current = NO_MATERIAL;
    if (dp_stream_have(stream, 1)) dp_text_skip_mark(stream);
    while (dp_text_space(stream)) {
        if (dp_text_match(stream, "newmtl")) {
            char name[DP_MATERIAL_NAME];
            uint16_t number;
            dp_text_rest(stream, name, sizeof name);
            if (!dp_materials_find(materials, name, &number)) return false;
            current = number;
        } else if (dp_text_match(stream, "kd") && current != NO_MATERIAL) {
            materials->colors[current] = read_color(stream);
        } else if (dp_text_match(stream, "map_kd")) {
            materials->textured = true;
        }
        dp_text_skip_line(stream);
    }
    return true;
}

/* ------- finding libraries ------- */

static dp_result read_library(const dp_stream *model, const char *name, size_t length,
                              dp_materials *materials, dp_diag *diag) {
    dp_stream *stream = NULL;
    const dp_result result = dp_open_beside(model, name, length, &stream, diag);
    if (result) return result;
    const bool enough = dp_read_mtl(stream, materials);
    dp_stream_close(stream);
    return enough ? DP_OK : DP_ERR_MEMORY;
}

static void note_missing(const char *name, size_t length, const char *why, char *remark,
                         size_t size) {
    if (*remark) return;
    snprintf(remark, size, "no colours from %.*s: %s", length < 120 ? (int)length : 120, name, why);
    for (char *p = remark; *p; p++)
        if ((uint8_t)*p < ' ' || *p == 0x7f) *p = '?';
}

bool dp_open_mtl(const dp_stream *model, const char *names, dp_materials *materials, char *remark,
                 size_t size) {
    const size_t all = strlen(names);
    dp_diag diag = {0};
    const dp_result whole = all ? read_library(model, names, all, materials, &diag) : DP_OK;
    if (whole != DP_ERR_IO) return whole != DP_ERR_MEMORY;
    for (const char *word = names; *word; word += strspn(word, " \t")) {
        const size_t length = strcspn(word, " \t");
        const dp_result result =
            length == all ? whole : read_library(model, word, length, materials, &diag);
        if (result == DP_ERR_MEMORY) return false;
        if (result) note_missing(word, length, diag.message, remark, size);
        word += length;
    }
    return true;
}
