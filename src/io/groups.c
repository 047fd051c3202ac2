/* Names of groups: an array of strings, and a hash table over it with open addressing.
 *
 * Invariant: every group is in exactly one slot, and at least half of the slots are free. */
#include "io/groups.h"

#include <string.h>

static size_t hash(const char *name) {
    uint64_t value = 0xcbf29ce484222325; /* FNV-1a */
    for (; *name; name++) value = (value ^ (uint8_t)*name) * 0x100000001b3;
    return (size_t)(value ^ value >> 32);
}

/* The slot that holds the name, or the free one where it belongs. */
static uint32_t *find_slot(const dp_groups *groups, const char *name) {
    size_t i = hash(name);
    for (;; i++) {
        uint32_t *const slot = &groups->slots[i & (groups->slot_count - 1)];
        if (!*slot || strcmp(groups->text + groups->starts[*slot - 1], name) == 0) return slot;
    }
}

static bool grow_slots(dp_groups *groups) {
    const size_t count = groups->slot_count ? 2 * groups->slot_count : 16;
    uint32_t *const slots = dp_alloc_zeroed(&groups->allocator, dp_times(count, sizeof *slots));
    if (!slots) return false;
    dp_free(&groups->allocator, groups->slots);
    groups->slots = slots;
    groups->slot_count = count;
    for (size_t g = 0; g < groups->count; g++)
        *find_slot(groups, groups->text + groups->starts[g]) = (uint32_t)g + 1;
    return true;
}

static bool add(dp_groups *groups, const char *name, uint32_t *slot) {
    const size_t size = strlen(name) + 1;
    if (!dp_reserve(&groups->allocator, &groups->text, &groups->text_capacity,
                    groups->text_size + size, 1) ||
        !dp_reserve(&groups->allocator, &groups->starts, &groups->start_capacity, groups->count + 1,
                    sizeof *groups->starts))
        return false;
    memcpy(groups->text + groups->text_size, name, size);
    groups->starts[groups->count++] = groups->text_size;
    groups->text_size += size;
    *slot = (uint32_t)groups->count;
    return true;
}

bool dp_groups_find(dp_groups *groups, const char *name, uint16_t *group) {
    if (groups->slot_count <= 2 * groups->count + 2 && !grow_slots(groups)) return false;
    uint32_t *const slot = find_slot(groups, name);
    if (!*slot && groups->count < DP_GROUPS_MOST && !add(groups, name, slot)) return false;
    *group = (uint16_t)(*slot ? *slot - 1 : DP_GROUPS_MOST - 1);
    return true;
}

const char *dp_groups_name(const dp_groups *groups, uint32_t group) {
    if (group >= groups->count) return NULL;
    const char *const name = groups->text + groups->starts[group];
    return *name ? name : NULL;
}

void dp_groups_destroy(dp_groups *groups) {
    dp_free(&groups->allocator, groups->text);
    dp_free(&groups->allocator, groups->starts);
    dp_free(&groups->allocator, groups->slots);
}
