/* JSON (RFC 8259) as a tree in memory. */
#ifndef DP_BASE_JSON_H
#define DP_BASE_JSON_H

#include "base/arena.h"

typedef enum dp_json_kind {
    DP_JSON_NULL,
    DP_JSON_BOOL,
    DP_JSON_NUMBER,
    DP_JSON_STRING,
    DP_JSON_ARRAY,
    DP_JSON_OBJECT
} dp_json_kind;

/* Text is UTF-8 as it stands in the file (not checked), without a 0 behind it. */
typedef struct dp_json {
    dp_json_kind kind;
    uint32_t count;     /* items, members */
    uint32_t name_size; /* bytes; of a member */
    const char *name;
    union {
        bool truth;
        double number; /* finite; to a few units in the last place */
        struct {
            const char *text;
            size_t size; /* bytes */
        } string;
        const struct dp_json *items; /* [count]; of an object, in the file's order */
    } as;
} dp_json;

/* Parses a whole text, which must outlive the tree: strings without escapes lie in it. A byte
 * order mark is skipped. DP_ERR_FORMAT with the line, DP_ERR_LIMIT for more than 256 levels or
 * 2^28 values, DP_ERR_MEMORY. */
dp_result dp_json_parse(const char *text, size_t size, dp_arena *arena, const dp_json **out,
                        dp_diag *diag);

/* The first member of that name; NULL: there is none, or `object` is no object, or NULL. */
const dp_json *dp_json_find(const dp_json *object, const char *name);
/* Item `i` of an array; NULL: there is none, or `array` is no array, or NULL. */
const dp_json *dp_json_item(const dp_json *array, uint32_t i);
/* How many items an array has; 0 for all else, and for NULL. */
uint32_t dp_json_count(const dp_json *array);
/* Is it this text? False for NULL. */
bool dp_json_is(const dp_json *string, const char *text);

#endif
