/* Which widths of kernels this processor can run, of those that are built. */
#include "base/kernels.h"

#include <stdlib.h>
#include <string.h>

uint32_t dp_widths_list(dp_width list[DP_WIDTHS_MOST]) {
    uint32_t count = 0;
#ifndef __wasm_simd128__
    if (DP_WIDTHS_BUILT & 1) list[count++] = (dp_width){"plain", 1};
#endif
#if defined __BYTE_ORDER__ && __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
    list[count++] = (dp_width){"base", 4};
#endif
#ifdef __x86_64__
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi")) {
        if (DP_WIDTHS_BUILT & 8) list[count++] = (dp_width){"avx2", 8};
        if (DP_WIDTHS_BUILT & 16 && __builtin_cpu_supports("avx512f") &&
            __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") &&
            __builtin_cpu_supports("avx512bw"))
            list[count++] = (dp_width){"avx512", 16};
    }
#endif
    return count;
}

uint32_t dp_lanes_best(void) {
    dp_width list[DP_WIDTHS_MOST];
    const uint32_t count = dp_widths_list(list);
#ifdef DP_TESTS
    const char *const name = getenv("DRYPOINT_CPU");
    for (uint32_t i = 0; name && i < count; i++)
        if (!strcmp(list[i].name, name)) return list[i].lanes;
#endif
    return list[count - 1].lanes;
}
