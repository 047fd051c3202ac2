/* Kernels: loops over many vertices, polygons, samples or pixels, for several kinds of processors.
 *
 *    *.inc       a kernel, written once on vectors of DP_LANES floats (base/lanes.h)
 *    kernels.c   includes a folder's kernels, and puts them into a table of functions;
 *                the build compiles it once for each width (CMakeLists.txt)
 *    kernels.h   declares that table's type, and type_for(lanes)
 *
 * Invariant: plain C, one lane, is the truth. The other widths do the same operations in the same
 * order and give the same bits (tests/unit/test_kernels*.c). */
#ifndef DP_BASE_KERNELS_H
#define DP_BASE_KERNELS_H

#include <stdint.h>

/* A width of vectors for which kernels are compiled. */
typedef struct dp_width {
    const char *name; /* "plain", "base", "avx2", "avx512" */
    uint32_t lanes;   /* 1, 4, 8, 16 */
} dp_width;

enum { DP_WIDTHS_MOST = 4 };

/* Lists the widths that this processor can run, slowest first. Returns how many. WebAssembly with
 * vectors has "base" alone. */
uint32_t dp_widths_list(dp_width list[DP_WIDTHS_MOST]);

/* Lanes of the fastest width. In builds with tests, DRYPOINT_CPU in the environment chooses
 * another. */
uint32_t dp_lanes_best(void);

/* Widths that are built, by their lanes. Base always is. */
#ifndef DP_WIDTHS_BUILT
#define DP_WIDTHS_BUILT (1 | 4 | 8 | 16)
#endif

/* Declares a folder's tables of type `type`, one for each width, and type_for(lanes), which returns
 * one. */
#ifdef __x86_64__
#define DP_KERNEL_TABLES(type)                                                                     \
    extern const type type##_plain, type##_base, type##_avx2, type##_avx512;                       \
    static inline const type *type##_for(uint32_t lanes) {                                         \
        if (DP_WIDTHS_BUILT & 16 && lanes >= 16) return &type##_avx512;                            \
        if (DP_WIDTHS_BUILT & 8 && lanes >= 8) return &type##_avx2;                                \
        return DP_WIDTHS_BUILT & 1 && lanes < 4 ? &type##_plain : &type##_base;                    \
    }                                                                                              \
    typedef type type##_tables
#elif defined __wasm_simd128__ /* what is not named is not linked, and pages load faster */
#define DP_KERNEL_TABLES(type)                                                                     \
    extern const type type##_plain, type##_base;                                                   \
    static inline const type *type##_for(uint32_t lanes) {                                         \
        (void)lanes;                                                                               \
        return &type##_base;                                                                       \
    }                                                                                              \
    typedef type type##_tables
#else
#define DP_KERNEL_TABLES(type)                                                                     \
    extern const type type##_plain, type##_base;                                                   \
    static inline const type *type##_for(uint32_t lanes) {                                         \
        return lanes >= 4 ? &type##_base : &type##_plain;                                          \
    }                                                                                              \
    typedef type type##_tables
#endif

/* The name of the table in a kernels.c that is compiled for DP_LANES. */
#if DP_LANES == 1
#define DP_KERNEL_TABLE(type) type##_plain
#elif DP_LANES == 4
#define DP_KERNEL_TABLE(type) type##_base
#elif DP_LANES == 8
#define DP_KERNEL_TABLE(type) type##_avx2
#elif DP_LANES == 16
#define DP_KERNEL_TABLE(type) type##_avx512
#endif

#endif
