/* Options that may be given several times: their values in order. */
#include "objects.h"
#include "options.h"
#include "report.h"

#include <stdlib.h>
#include <string.h>

bool option_names_check(const char *name, const char *text, const char *end) {
    for (;;) {
        const char *own = object_name_end(text);
        if (own > end) own = end;
        if (own == text)
            return wrong_usage("--%s: a name is empty; give names like bolt, or 'bolt*,nut'", name);
        if (own == end) return true;
        text = own + 1;
    }
}

bool store_list(const option *o, const char *value, text_list *to) {
    const bool sound = o->kind == OPTION_OBJECT
                           ? object_check(value)
                           : option_names_check(o->name, value, value + strlen(value));
    if (!sound) return false;
    const char **const longer = realloc(to->items, (to->count + (size_t)1) * sizeof *longer);
    if (!longer) return wrong_usage("out of memory for the values of --%s", o->name);
    to->items = longer;
    to->items[to->count++] = value;
    return true;
}

void option_lists_free(tool_settings *s) {
    text_list *const lists[] = {&s->only, &s->without, &s->objects};
    for (size_t k = 0; k < sizeof lists / sizeof *lists; k++) {
        free(lists[k]->items);
        *lists[k] = (text_list){0};
    }
}
