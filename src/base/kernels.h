/* Kernels: loops over many vertices, polygons, samples or pixels, for several kinds of processors.
 *
 * Each folder keeps its kernels beside the structs that they work on: written once, in .inc files,
 * on vectors of DP_LANES floats (lanes.h), gathered in the folder's kernels.c, which the build
 * compiles once for each width (CMakeLists.txt), and declared as a table of functions in its
 * kernels.h. Plain C, one lane, is the truth: the others do the same operations in the same order
 * and give the same bits (tests/unit/test_kernels*.c). */
#ifndef DP_BASE_KERNELS_H
#define DP_BASE_KERNELS_H

#include <stdint.h>

/* A width of vectors that kernels are compiled for. */
typedef struct dp_width {
    const char *name; /* "plain", "base", "avx2", "avx512" */
    uint32_t lanes;   /* 1, 4, 8, 16 */
} dp_width;

enum { DP_WIDTHS_MOST = 4 };

/* Those that this processor runs, slowest first. Returns how many. */
uint32_t dp_widths_list(dp_width list[DP_WIDTHS_MOST]);

/* How many lanes the fastest has. In builds with tests, the environment's DRYPOINT_CPU names
 * another. */
uint32_t dp_lanes_best(void);

/* Declares a folder's tables of type `type`, one a width, and type_for(lanes), which gives that of
 * a width. */
#ifdef __x86_64__
#define DP_KERNEL_TABLES(type)                                                                     \
    extern const type type##_plain, type##_base, type##_avx2, type##_avx512;                       \
    static inline const type *type##_for(uint32_t lanes) {                                         \
        if (lanes >= 16) return &type##_avx512;                                                    \
        if (lanes >= 8) return &type##_avx2;                                                       \
        return lanes >= 4 ? &type##_base : &type##_plain;                                          \
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

/* The name of such a table in a folder's kernels.c, compiled for DP_LANES. */
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
