/* drypoint MODEL --list: the objects of a model, by name. */
#include "objects.h"
#include "report.h"

#include <stdio.h>

/* Names come from files: what a terminal would take for a command is not printed. */
static void print_name(const char *name) {
    if (!name) fputs("(no name)", stdout);
    for (const char *c = name; c && *c; c++)
        fputc((unsigned char)*c < 32 || *c == 127 ? '?' : *c, stdout);
    fputc('\n', stdout);
}

static void print_row(const dp_source *source, const dp_group *group, uint32_t number) {
    const uint32_t color = dp_source_group_color(source, number);
    char text[16] = "-";
    if (color) snprintf(text, sizeof text, "#%06x", color >> 8);
    printf("%10llu  %-7s  ", (unsigned long long)group->polygons, text);
    print_name(dp_source_group_name(source, number));
}

static void print_numbers(const char *name, const double p[3]) {
    printf(", \"%s\": ", name);
    if (p[0] - p[0] != 0)
        printf("null");
    else
        printf("[%.9g, %.9g, %.9g]", p[0], p[1], p[2]);
}

static void print_object(const dp_source *source, const dp_group *group, uint32_t number,
                         bool first) {
    const char *const name = dp_source_group_name(source, number);
    const uint32_t color = dp_source_group_color(source, number);
    printf("%s\n {\"group\": %u, \"name\": ", first ? "" : ",", number);
    if (name)
        print_json_string(stdout, name);
    else
        printf("null");
    printf(", \"polygons\": %llu, \"color\": ", (unsigned long long)group->polygons);
    if (color)
        printf("\"#%08x\"", color);
    else
        printf("null");
    print_numbers("min", group->min);
    print_numbers("max", group->max);
    putchar('}');
}

static void print(const tool_settings *s, const dp_source *source, const object_list *list) {
    bool first = true;
    if (s->json) putchar('[');
    if (!s->json) printf("  polygons  colour   name\n");
    for (uint32_t g = 0; g < list->count; g++) {
        if (!list->groups[g].polygons) continue;
        if (s->json)
            print_object(source, &list->groups[g], g, first);
        else
            print_row(source, &list->groups[g], g);
        first = false;
    }
    if (s->json) printf("\n]\n");
}

int objects_print(const tool_settings *s) {
    dp_source *source = NULL;
    object_list list = {0};
    int code = open_model(s, &source);
    if (!code) code = object_list_read(s, source, &list);
    if (!code && !list.count) {
        wrong_usage("%s: there are no polygons in it; give a model with faces", s->model);
        code = EXIT_FAILED;
    }
    if (!code) print(s, source, &list);
    const char *const remark = code ? NULL : dp_source_remark(source);
    if (remark && !s->quiet) warn_of_model(s, remark);
    object_list_free(&list);
    dp_source_destroy(source);
    return code;
}
