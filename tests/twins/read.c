/* OBJ: lines `v` and `f` with positive vertex numbers; STL: binary, and the vertices of ASCII. */
#include "read.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { CORNERS = 64, BEFORE = 84 /* bytes of a binary STL's head */, EACH = 50 };

static char *read_file(const char *path, size_t *size) {
    FILE *const file = fopen(path, "rb");
    char *text = NULL;
    size_t room = 0;
    *size = 0;
    if (file == NULL) return NULL;
    do {
        room = 2 * room + 65536;
        text = realloc(text, room + 1);
        if (text == NULL) abort();
        *size += fread(text + *size, 1, room - *size, file);
    } while (*size == room);
    text[*size] = 0;
    fclose(file);
    return text;
}

static void read_binary_stl(const char *bytes, uint32_t count, soup *out) {
    for (uint32_t i = 0; i < count; i++) {
        float f[12];
        v3 p[3];
        memcpy(f, bytes + BEFORE + (size_t)EACH * i, sizeof f);
        for (int k = 0; k < 3; k++)
            p[k] = (v3){(double)f[3 + 3 * k], (double)f[4 + 3 * k], (double)f[5 + 3 * k]};
        soup_add(out, p, 3, 0);
    }
}

static v3 read_point(const char **at) {
    double p[3];
    char *end = NULL;
    for (int k = 0; k < 3; k++) {
        p[k] = strtod(*at, &end);
        *at = end;
    }
    return (v3){p[0], p[1], p[2]};
}

static void read_ascii_stl(const char *text, soup *out) {
    v3 p[3];
    uint32_t n = 0;
    while ((text = strstr(text, "vertex")) != NULL) {
        text += strlen("vertex");
        p[n++] = read_point(&text);
        if (n == 3) soup_add(out, p, 3, 0), n = 0;
    }
}

static bool read_face(const char *line, const soup *vertices, soup *out) {
    v3 p[CORNERS];
    uint32_t n = 0;
    for (;;) {
        char *end;
        const unsigned long v = strtoul(line, &end, 10);
        if (end == line) break;
        if (v == 0 || v > vertices->point_count || n == CORNERS) return false;
        p[n++] = vertices->points[v - 1];
        line = end + strcspn(end, " \n"); /* without a texture's and a normal's number */
        if (*line == '\n') break;
    }
    if (n >= 3) soup_add(out, p, n, 0);
    return n >= 3;
}

static bool read_obj(const char *text, soup *out) {
    soup vertices = {0};
    bool good = true;
    for (const char *line = text; line != NULL && good; line = strchr(line, '\n')) {
        while (*line == '\n' || *line == '\r') line++;
        const char *rest = line + 2;
        if (!strncmp(line, "v ", 2)) {
            const v3 p = read_point(&rest);
            soup_add(&vertices, &p, 1, 0);
        } else if (!strncmp(line, "f ", 2))
            good = read_face(rest, &vertices, out);
    }
    soup_free(&vertices);
    return good;
}

bool soup_read(const char *path, soup *out) {
    size_t size;
    uint32_t count = 0;
    bool good = true;
    char *const text = read_file(path, &size);
    if (text == NULL) return false;
    if (size >= BEFORE) memcpy(&count, text + BEFORE - 4, 4);
    if (strstr(path, ".obj") != NULL)
        good = read_obj(text, out);
    else if (size == BEFORE + (size_t)EACH * count)
        read_binary_stl(text, count, out);
    else
        read_ascii_stl(text, out);
    free(text);
    return good && out->polygon_count > 0;
}
