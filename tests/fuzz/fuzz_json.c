/* Fuzzes base/json: what is parsed is walked to its last value. */
#include "base/json.h"

#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static uint64_t walk(const dp_json *v) {
    uint64_t sum = (uint64_t)v->kind + v->count;
    for (uint32_t i = 0; i < v->name_size; i++) sum += (uint8_t)v->name[i];
    if (v->kind == DP_JSON_NUMBER && v->as.number - v->as.number != 0) abort();
    if (v->kind == DP_JSON_STRING)
        for (size_t i = 0; i < v->as.string.size; i++) sum += (uint8_t)v->as.string.text[i];
    if (v->kind == DP_JSON_ARRAY || v->kind == DP_JSON_OBJECT)
        for (uint32_t i = 0; i < v->count; i++) sum += walk(&v->as.items[i]);
    return sum;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    dp_arena arena = {.memory = dp_allocator_resolve(NULL)};
    dp_diag diag = {0};
    const dp_json *root;
    const dp_result result = dp_json_parse((const char *)data, size, &arena, &root, &diag);
    if (!root != !!result || (result && (diag.result != result || !diag.message[0]))) abort();
    volatile uint64_t sum = root ? walk(root) : 0;
    (void)sum;
    dp_arena_free(&arena);
    return 0;
}
