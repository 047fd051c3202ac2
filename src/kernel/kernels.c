/* Which kernels this processor can run. */
#include "kernel/kernels.h"

#include <stdlib.h>
#include <string.h>

uint32_t dp_kernels_list(const dp_kernels *list[DP_KERNELS_MAX]) {
    uint32_t count = 0;
    list[count++] = &dp_kernels_plain;
#if defined __BYTE_ORDER__ && __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
    list[count++] = &dp_kernels_base;
#endif
#ifdef __x86_64__
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi")) {
        list[count++] = &dp_kernels_avx2;
        if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
            __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw"))
            list[count++] = &dp_kernels_avx512;
    }
#endif
    return count;
}

const dp_kernels *dp_kernels_best(void) {
    const dp_kernels *list[DP_KERNELS_MAX];
    const uint32_t count = dp_kernels_list(list);
#ifdef DP_TESTS
    const char *const name = getenv("DRYPOINT_CPU");
    for (uint32_t i = 0; name && i < count; i++)
        if (!strcmp(list[i]->name, name)) return list[i];
#endif
    return list[count - 1];
}
