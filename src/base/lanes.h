/* Vectors of DP_LANES floats or ints, for kernels that are written once and compiled for several
 * widths.
 *
 *    DP_LANES 1: plain C    4: any processor (SSE2, NEON, WebAssembly)    8: AVX2    16: AVX-512
 *
 *    l_…     dp_lf          floats
 *    li_…    dp_li, dp_lu   ints, unsigned ints
 *    lm_…    dp_lm          masks, made by comparisons
 *    ld_…    dp_ld, dp_lb   doubles, half as many; their masks
 *
 * The file that includes this has set DP_LANES. Invariant: every operation is one IEEE operation
 * per lane, so all widths give the same bits (contraction is off, see cmake/). How a mask is stored
 * differs by width; it goes into `l_select` and `lm_bits`. If an argument is NaN, `l_min` and
 * `l_max` return the second one, like dp_minf and dp_maxf. */
#ifndef DP_BASE_LANES_H
#define DP_BASE_LANES_H

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#if DP_LANES >= 8
#include <immintrin.h>
#elif DP_LANES == 4 && defined __SSE2__
#include <emmintrin.h>
#elif DP_LANES == 4 && defined __wasm_simd128__
#include <wasm_simd128.h>
#endif

/* Inlines kernels whose arguments are constants; compilers do that only when they optimise. */
#ifdef __OPTIMIZE__
#define DP_LANES_INLINE static inline __attribute__((always_inline))
#else
#define DP_LANES_INLINE static inline
#endif

#if DP_LANES == 1
typedef float dp_lf;
typedef int32_t dp_li;
typedef uint32_t dp_lu;
typedef bool dp_lm;
#else
typedef float dp_lf __attribute__((vector_size(4 * DP_LANES)));
typedef int32_t dp_li __attribute__((vector_size(4 * DP_LANES)));
typedef uint32_t dp_lu __attribute__((vector_size(4 * DP_LANES)));
#if DP_LANES == 16
typedef __mmask16 dp_lm;
#else
typedef dp_li dp_lm;
#endif
#endif

/* ------- any width ------- */

DP_LANES_INLINE dp_lf l_load(const float *p) {
    dp_lf v;
    memcpy(&v, p, sizeof v);
    return v;
}
DP_LANES_INLINE dp_li li_load(const void *p) {
    dp_li v;
    memcpy(&v, p, sizeof v);
    return v;
}
DP_LANES_INLINE void l_store(float *p, dp_lf v) { memcpy(p, &v, sizeof v); }
DP_LANES_INLINE void li_store(void *p, dp_li v) { memcpy(p, &v, sizeof v); }

/* ------- plain C ------- */

#if DP_LANES == 1
DP_LANES_INLINE dp_lf l_splat(float v) { return v; }
DP_LANES_INLINE dp_li li_splat(int32_t v) { return v; }
DP_LANES_INLINE dp_lm l_lt(dp_lf a, dp_lf b) { return a < b; }
DP_LANES_INLINE dp_lm l_le(dp_lf a, dp_lf b) { return a <= b; }
DP_LANES_INLINE dp_lm lm_and(dp_lm a, dp_lm b) { return a && b; }
DP_LANES_INLINE dp_lm lm_or(dp_lm a, dp_lm b) { return a || b; }
DP_LANES_INLINE dp_lm lm_xor(dp_lm a, dp_lm b) { return a != b; }
DP_LANES_INLINE dp_lm lm_not(dp_lm a) { return !a; }
DP_LANES_INLINE dp_lm l_eq(dp_lf a, dp_lf b) { return a == b; }
DP_LANES_INLINE dp_lm li_eq(dp_li a, dp_li b) { return a == b; }
DP_LANES_INLINE dp_lm li_lt(dp_li a, dp_li b) { return a < b; }
DP_LANES_INLINE uint32_t lm_bits(dp_lm m) { return m; }
DP_LANES_INLINE dp_lf l_select(dp_lm m, dp_lf a, dp_lf b) { return m ? a : b; }
DP_LANES_INLINE dp_li li_select(dp_lm m, dp_li a, dp_li b) { return m ? a : b; }
DP_LANES_INLINE dp_lf l_abs(dp_lf v) { return fabsf(v); }
DP_LANES_INLINE dp_lf l_sqrt(dp_lf v) { return sqrtf(v); }
DP_LANES_INLINE dp_lf l_min(dp_lf a, dp_lf b) { return a < b ? a : b; }
DP_LANES_INLINE dp_lf l_max(dp_lf a, dp_lf b) { return a > b ? a : b; }
DP_LANES_INLINE dp_li l_truncate(dp_lf v) { return (int32_t)v; }

/* ------- four lanes ------- */

#elif DP_LANES == 4
DP_LANES_INLINE dp_lf l_splat(float v) { return (dp_lf){v, v, v, v}; }
DP_LANES_INLINE dp_li li_splat(int32_t v) { return (dp_li){v, v, v, v}; }
DP_LANES_INLINE dp_lm l_lt(dp_lf a, dp_lf b) { return a < b; }
DP_LANES_INLINE dp_lm l_le(dp_lf a, dp_lf b) { return a <= b; }
DP_LANES_INLINE dp_lm l_eq(dp_lf a, dp_lf b) { return a == b; }
DP_LANES_INLINE dp_lm li_eq(dp_li a, dp_li b) { return a == b; }
DP_LANES_INLINE dp_lm li_lt(dp_li a, dp_li b) { return a < b; }
DP_LANES_INLINE dp_lm lm_and(dp_lm a, dp_lm b) { return a & b; }
DP_LANES_INLINE dp_lm lm_or(dp_lm a, dp_lm b) { return a | b; }
DP_LANES_INLINE dp_lm lm_xor(dp_lm a, dp_lm b) { return a ^ b; }
DP_LANES_INLINE dp_lm lm_not(dp_lm a) { return ~a; }
DP_LANES_INLINE dp_li li_select(dp_lm m, dp_li a, dp_li b) { return (m & a) | (~m & b); }
DP_LANES_INLINE dp_lf l_select(dp_lm m, dp_lf a, dp_lf b) {
    return (dp_lf)li_select(m, (dp_li)a, (dp_li)b);
}
DP_LANES_INLINE dp_lf l_abs(dp_lf v) { return (dp_lf)((dp_li)v & li_splat(INT32_MAX)); }
#ifdef __SSE2__
DP_LANES_INLINE uint32_t lm_bits(dp_lm m) { return (uint32_t)_mm_movemask_ps((__m128)m); }
DP_LANES_INLINE dp_lf l_sqrt(dp_lf v) { return (dp_lf)_mm_sqrt_ps((__m128)v); }
DP_LANES_INLINE dp_lf l_min(dp_lf a, dp_lf b) { return (dp_lf)_mm_min_ps((__m128)a, (__m128)b); }
DP_LANES_INLINE dp_lf l_max(dp_lf a, dp_lf b) { return (dp_lf)_mm_max_ps((__m128)a, (__m128)b); }
DP_LANES_INLINE dp_li l_truncate(dp_lf v) { return (dp_li)_mm_cvttps_epi32((__m128)v); }
#elif defined __wasm_simd128__
/* pmin(x, y) is y < x ? y : x, so the arguments change places; also right for NaN and for zeros of
 * either sign. */
DP_LANES_INLINE uint32_t lm_bits(dp_lm m) { return wasm_i32x4_bitmask((v128_t)m); }
DP_LANES_INLINE dp_lf l_sqrt(dp_lf v) { return (dp_lf)wasm_f32x4_sqrt((v128_t)v); }
DP_LANES_INLINE dp_lf l_min(dp_lf a, dp_lf b) {
    return (dp_lf)wasm_f32x4_pmin((v128_t)b, (v128_t)a);
}
DP_LANES_INLINE dp_lf l_max(dp_lf a, dp_lf b) {
    return (dp_lf)wasm_f32x4_pmax((v128_t)b, (v128_t)a);
}
DP_LANES_INLINE dp_li l_truncate(dp_lf v) { return (dp_li)wasm_i32x4_trunc_sat_f32x4((v128_t)v); }
#else
DP_LANES_INLINE uint32_t lm_bits(dp_lm m) {
    return ((uint32_t)m[0] & 1) | ((uint32_t)m[1] & 2) | ((uint32_t)m[2] & 4) |
           ((uint32_t)m[3] & 8);
}
DP_LANES_INLINE dp_lf l_sqrt(dp_lf v) {
    return (dp_lf){sqrtf(v[0]), sqrtf(v[1]), sqrtf(v[2]), sqrtf(v[3])};
}
DP_LANES_INLINE dp_lf l_min(dp_lf a, dp_lf b) { return l_select(a < b, a, b); }
DP_LANES_INLINE dp_lf l_max(dp_lf a, dp_lf b) { return l_select(a > b, a, b); }
DP_LANES_INLINE dp_li l_truncate(dp_lf v) { return __builtin_convertvector(v, dp_li); }
#endif

/* ------- AVX2 ------- */

#elif DP_LANES == 8
DP_LANES_INLINE dp_lf l_splat(float v) { return (dp_lf)_mm256_set1_ps(v); }
DP_LANES_INLINE dp_li li_splat(int32_t v) { return (dp_li)_mm256_set1_epi32(v); }
DP_LANES_INLINE dp_lm l_lt(dp_lf a, dp_lf b) { return a < b; }
DP_LANES_INLINE dp_lm l_le(dp_lf a, dp_lf b) { return a <= b; }
DP_LANES_INLINE dp_lm l_eq(dp_lf a, dp_lf b) { return a == b; }
DP_LANES_INLINE dp_lm li_eq(dp_li a, dp_li b) { return a == b; }
DP_LANES_INLINE dp_lm li_lt(dp_li a, dp_li b) { return a < b; }
DP_LANES_INLINE dp_lm lm_and(dp_lm a, dp_lm b) { return a & b; }
DP_LANES_INLINE dp_lm lm_or(dp_lm a, dp_lm b) { return a | b; }
DP_LANES_INLINE dp_lm lm_xor(dp_lm a, dp_lm b) { return a ^ b; }
DP_LANES_INLINE dp_lm lm_not(dp_lm a) { return ~a; }
DP_LANES_INLINE uint32_t lm_bits(dp_lm m) { return (uint32_t)_mm256_movemask_ps((__m256)m); }
DP_LANES_INLINE dp_lf l_select(dp_lm m, dp_lf a, dp_lf b) {
    return (dp_lf)_mm256_blendv_ps((__m256)b, (__m256)a, (__m256)m);
}
DP_LANES_INLINE dp_li li_select(dp_lm m, dp_li a, dp_li b) {
    return (dp_li)l_select(m, (dp_lf)a, (dp_lf)b);
}
DP_LANES_INLINE dp_lf l_abs(dp_lf v) { return (dp_lf)((dp_li)v & li_splat(INT32_MAX)); }
DP_LANES_INLINE dp_lf l_sqrt(dp_lf v) { return (dp_lf)_mm256_sqrt_ps((__m256)v); }
DP_LANES_INLINE dp_lf l_min(dp_lf a, dp_lf b) { return (dp_lf)_mm256_min_ps((__m256)a, (__m256)b); }
DP_LANES_INLINE dp_lf l_max(dp_lf a, dp_lf b) { return (dp_lf)_mm256_max_ps((__m256)a, (__m256)b); }
DP_LANES_INLINE dp_li l_truncate(dp_lf v) { return (dp_li)_mm256_cvttps_epi32((__m256)v); }

/* ------- AVX-512 ------- */

#else
DP_LANES_INLINE dp_lf l_splat(float v) { return (dp_lf)_mm512_set1_ps(v); }
DP_LANES_INLINE dp_li li_splat(int32_t v) { return (dp_li)_mm512_set1_epi32(v); }
DP_LANES_INLINE dp_lm l_lt(dp_lf a, dp_lf b) {
    return _mm512_cmp_ps_mask((__m512)a, (__m512)b, _CMP_LT_OQ);
}
DP_LANES_INLINE dp_lm l_le(dp_lf a, dp_lf b) {
    return _mm512_cmp_ps_mask((__m512)a, (__m512)b, _CMP_LE_OQ);
}
DP_LANES_INLINE dp_lm l_eq(dp_lf a, dp_lf b) {
    return _mm512_cmp_ps_mask((__m512)a, (__m512)b, _CMP_EQ_OQ);
}
DP_LANES_INLINE dp_lm li_lt(dp_li a, dp_li b) {
    return _mm512_cmplt_epi32_mask((__m512i)a, (__m512i)b);
}
DP_LANES_INLINE dp_lm li_eq(dp_li a, dp_li b) {
    return _mm512_cmpeq_epi32_mask((__m512i)a, (__m512i)b);
}
DP_LANES_INLINE dp_lm lm_and(dp_lm a, dp_lm b) { return (dp_lm)(a & b); }
DP_LANES_INLINE dp_lm lm_or(dp_lm a, dp_lm b) { return (dp_lm)(a | b); }
DP_LANES_INLINE dp_lm lm_xor(dp_lm a, dp_lm b) { return (dp_lm)(a ^ b); }
DP_LANES_INLINE dp_lm lm_not(dp_lm a) { return (dp_lm)~a; }
DP_LANES_INLINE uint32_t lm_bits(dp_lm m) { return m; }
DP_LANES_INLINE dp_lf l_select(dp_lm m, dp_lf a, dp_lf b) {
    return (dp_lf)_mm512_mask_blend_ps(m, (__m512)b, (__m512)a);
}
DP_LANES_INLINE dp_li li_select(dp_lm m, dp_li a, dp_li b) {
    return (dp_li)_mm512_mask_blend_epi32(m, (__m512i)b, (__m512i)a);
}
DP_LANES_INLINE dp_lf l_abs(dp_lf v) { return (dp_lf)_mm512_abs_ps((__m512)v); }
DP_LANES_INLINE dp_lf l_sqrt(dp_lf v) { return (dp_lf)_mm512_sqrt_ps((__m512)v); }
DP_LANES_INLINE dp_lf l_min(dp_lf a, dp_lf b) { return (dp_lf)_mm512_min_ps((__m512)a, (__m512)b); }
DP_LANES_INLINE dp_lf l_max(dp_lf a, dp_lf b) { return (dp_lf)_mm512_max_ps((__m512)a, (__m512)b); }
DP_LANES_INLINE dp_li l_truncate(dp_lf v) { return (dp_li)_mm512_cvttps_epi32((__m512)v); }
#endif

/* table[at], by lane. */
DP_LANES_INLINE dp_lf l_lookup(const float *table, dp_li at) {
#if DP_LANES == 1
    return table[at];
#elif DP_LANES == 4
    return (dp_lf){table[at[0]], table[at[1]], table[at[2]], table[at[3]]};
#elif DP_LANES == 8
    return (dp_lf)_mm256_i32gather_ps(table, (__m256i)at, 4);
#else
    return (dp_lf)_mm512_i32gather_ps((__m512i)at, table, 4);
#endif
}

/* The same for words of any type. */
DP_LANES_INLINE dp_li l_lookup_bits(const void *table, dp_li at) {
#if DP_LANES == 1
    dp_li v;
    memcpy(&v, (const char *)table + 4 * (ptrdiff_t)at, sizeof v);
    return v;
#else
    return (dp_li)l_lookup(table, at);
#endif
}

/* The larger byte of each pair. */
DP_LANES_INLINE dp_li li_max_bytes(dp_li a, dp_li b) {
#if DP_LANES == 16
    return (dp_li)_mm512_max_epu8((__m512i)a, (__m512i)b);
#elif DP_LANES == 8
    return (dp_li)_mm256_max_epu8((__m256i)a, (__m256i)b);
#elif DP_LANES == 4 && defined __SSE2__
    return (dp_li)_mm_max_epu8((__m128i)a, (__m128i)b);
#elif DP_LANES == 4 && defined __wasm_simd128__
    return (dp_li)wasm_u8x16_max((v128_t)a, (v128_t)b);
#else
    uint8_t x[4 * DP_LANES], y[4 * DP_LANES];
    memcpy(x, &a, sizeof x);
    memcpy(y, &b, sizeof y);
    for (int i = 0; i < 4 * DP_LANES; i++) x[i] = x[i] > y[i] ? x[i] : y[i];
    memcpy(&a, x, sizeof x);
    return a;
#endif
}

/* Call this at the end of a kernel that calls functions with vector arguments. Compilers then leave
 * the registers' upper halves set, and later code with 16-byte vectors runs up to half as fast. */
DP_LANES_INLINE void l_done(void) {
#if DP_LANES >= 8
    _mm256_zeroupper();
#endif
}

DP_LANES_INLINE dp_lm l_gt(dp_lf a, dp_lf b) { return l_lt(b, a); }
DP_LANES_INLINE dp_lm l_ge(dp_lf a, dp_lf b) { return l_le(b, a); }

/* ------- doubles: half as many lanes ------- */

#if DP_LANES == 1
enum { DP_HALF = 1 };
typedef double dp_ld;
typedef bool dp_lb;
DP_LANES_INLINE dp_ld ld_splat(double v) { return v; }
DP_LANES_INLINE dp_ld ld_load(const float *p) { return *p; }
DP_LANES_INLINE void ld_store(float *p, dp_ld v) { *p = (float)v; }
DP_LANES_INLINE dp_ld ld_select(dp_lb m, dp_ld a, dp_ld b) { return m ? a : b; }
DP_LANES_INLINE dp_ld ld_sqrt(dp_ld v) { return sqrt(v); }
#else
enum { DP_HALF = DP_LANES / 2 };
typedef double dp_ld __attribute__((vector_size(4 * DP_LANES)));
typedef int64_t dp_lb __attribute__((vector_size(4 * DP_LANES)));
typedef float dp_half __attribute__((vector_size(2 * DP_LANES)));
DP_LANES_INLINE dp_ld ld_splat(double v) { return v - (dp_ld){0}; }
DP_LANES_INLINE dp_ld ld_load(const float *p) {
    dp_half v;
    memcpy(&v, p, sizeof v);
    return __builtin_convertvector(v, dp_ld);
}
DP_LANES_INLINE void ld_store(float *p, dp_ld v) {
    const dp_half h = __builtin_convertvector(v, dp_half);
    memcpy(p, &h, sizeof h);
}
DP_LANES_INLINE dp_ld ld_select(dp_lb m, dp_ld a, dp_ld b) {
    return (dp_ld)((m & (dp_lb)a) | (~m & (dp_lb)b));
}
DP_LANES_INLINE dp_ld ld_sqrt(dp_ld v) {
#if DP_LANES == 16
    return (dp_ld)_mm512_sqrt_pd((__m512d)v);
#elif DP_LANES == 8
    return (dp_ld)_mm256_sqrt_pd((__m256d)v);
#elif defined __SSE2__
    return (dp_ld)_mm_sqrt_pd((__m128d)v);
#elif defined __wasm_simd128__
    return (dp_ld)wasm_f64x2_sqrt((v128_t)v);
#else
    return (dp_ld){sqrt(v[0]), sqrt(v[1])};
#endif
}
#endif
DP_LANES_INLINE dp_ld ld_at(const double *p) {
    dp_ld v;
    memcpy(&v, p, sizeof v);
    return v;
}
DP_LANES_INLINE void ld_put(double *p, dp_ld v) { memcpy(p, &v, sizeof v); }

/* ------- records of four words, one per lane -------
 *
 * Lane l's record is at base + at[l], counted in records.
 *
 *    rows       row i holds the whole records of lanes 4 g + i, group g after group g
 *    columns    column i holds word i of every lane */

#if DP_LANES > 1
typedef float dp_record __attribute__((vector_size(16)));

DP_LANES_INLINE dp_record l_record(const void *base, uint32_t at) {
    dp_record r;
    memcpy(&r, (const char *)base + 16 * (size_t)at, sizeof r);
    return r;
}

/* Reads a row: records at[0], at[4 step], …, one for each group. */
DP_LANES_INLINE dp_lf l_row(const void *base, const uint32_t *at, const size_t step) {
#if DP_LANES == 4
    (void)step;
    return (dp_lf)l_record(base, at[0]);
#elif DP_LANES == 8
    return (dp_lf)_mm256_insertf128_ps(_mm256_castps128_ps256((__m128)l_record(base, at[0])),
                                       (__m128)l_record(base, at[4 * step]), 1);
#else
    const __m512 a = _mm512_castps128_ps512((__m128)l_record(base, at[0]));
    const __m512 b = _mm512_insertf32x4(a, (__m128)l_record(base, at[4 * step]), 1);
    const __m512 c = _mm512_insertf32x4(b, (__m128)l_record(base, at[8 * step]), 2);
    return (dp_lf)_mm512_insertf32x4(c, (__m128)l_record(base, at[12 * step]), 3);
#endif
}

/* Reads a row: four words from base, base + step, … (bytes), for each group. */
DP_LANES_INLINE dp_lf l_row_of_bytes(const uint8_t *base, size_t step) {
#if DP_LANES == 4
    (void)step;
    return (dp_lf)l_record(base, 0);
#elif DP_LANES == 8
    return (dp_lf)_mm256_insertf128_ps(_mm256_castps128_ps256((__m128)l_record(base, 0)),
                                       (__m128)l_record(base + step, 0), 1);
#else
    const __m512 a = _mm512_castps128_ps512((__m128)l_record(base, 0));
    const __m512 b = _mm512_insertf32x4(a, (__m128)l_record(base + step, 0), 1);
    const __m512 c = _mm512_insertf32x4(b, (__m128)l_record(base + 2 * step, 0), 2);
    return (dp_lf)_mm512_insertf32x4(c, (__m128)l_record(base + 3 * step, 0), 3);
#endif
}

/* Writes a row's records to base, base + group, … (bytes). */
DP_LANES_INLINE void l_put_row(char *base, size_t group, dp_lf row) {
#if DP_LANES == 4
    (void)group;
    memcpy(base, &row, 16);
#elif DP_LANES == 8
    _mm_storeu_ps((float *)(void *)base, _mm256_castps256_ps128((__m256)row));
    _mm_storeu_ps((float *)(void *)(base + group), _mm256_extractf128_ps((__m256)row, 1));
#else
    _mm_storeu_ps((float *)(void *)base, _mm512_castps512_ps128((__m512)row));
    _mm_storeu_ps((float *)(void *)(base + group), _mm512_extractf32x4_ps((__m512)row, 1));
    _mm_storeu_ps((float *)(void *)(base + 2 * group), _mm512_extractf32x4_ps((__m512)row, 2));
    _mm_storeu_ps((float *)(void *)(base + 3 * group), _mm512_extractf32x4_ps((__m512)row, 3));
#endif
}

/* The first two words of every record. */
DP_LANES_INLINE dp_lm lm_first_pair(void) {
#if DP_LANES == 4
    return (dp_lm){-1, -1, 0, 0};
#elif DP_LANES == 8
    return (dp_lm){-1, -1, 0, 0, -1, -1, 0, 0};
#else
    return 0x3333;
#endif
}

/* Rows to columns, or columns to rows. */
DP_LANES_INLINE void l_transpose(dp_lf r[4]) {
#if DP_LANES == 4 && defined __SSE2__
    const __m128 a = _mm_unpacklo_ps((__m128)r[0], (__m128)r[1]),
                 b = _mm_unpackhi_ps((__m128)r[0], (__m128)r[1]);
    const __m128 c = _mm_unpacklo_ps((__m128)r[2], (__m128)r[3]),
                 d = _mm_unpackhi_ps((__m128)r[2], (__m128)r[3]);
    r[0] = (dp_lf)_mm_movelh_ps(a, c), r[1] = (dp_lf)_mm_movehl_ps(c, a);
    r[2] = (dp_lf)_mm_movelh_ps(b, d), r[3] = (dp_lf)_mm_movehl_ps(d, b);
#elif DP_LANES == 4 && defined __wasm_simd128__
    const v128_t p = (v128_t)r[0], q = (v128_t)r[1], s = (v128_t)r[2], t = (v128_t)r[3];
    const v128_t a = wasm_i32x4_shuffle(p, q, 0, 4, 1, 5), b = wasm_i32x4_shuffle(p, q, 2, 6, 3, 7);
    const v128_t c = wasm_i32x4_shuffle(s, t, 0, 4, 1, 5), d = wasm_i32x4_shuffle(s, t, 2, 6, 3, 7);
    r[0] = (dp_lf)wasm_i64x2_shuffle(a, c, 0, 2), r[1] = (dp_lf)wasm_i64x2_shuffle(a, c, 1, 3);
    r[2] = (dp_lf)wasm_i64x2_shuffle(b, d, 0, 2), r[3] = (dp_lf)wasm_i64x2_shuffle(b, d, 1, 3);
#elif DP_LANES == 4
    const dp_lf a = r[0], b = r[1], c = r[2], d = r[3];
    r[0] = (dp_lf){a[0], b[0], c[0], d[0]}, r[1] = (dp_lf){a[1], b[1], c[1], d[1]};
    r[2] = (dp_lf){a[2], b[2], c[2], d[2]}, r[3] = (dp_lf){a[3], b[3], c[3], d[3]};
#elif DP_LANES == 8
    const __m256 a = _mm256_unpacklo_ps((__m256)r[0], (__m256)r[1]),
                 b = _mm256_unpackhi_ps((__m256)r[0], (__m256)r[1]);
    const __m256 c = _mm256_unpacklo_ps((__m256)r[2], (__m256)r[3]),
                 d = _mm256_unpackhi_ps((__m256)r[2], (__m256)r[3]);
    r[0] = (dp_lf)_mm256_shuffle_ps(a, c, 0x44), r[1] = (dp_lf)_mm256_shuffle_ps(a, c, 0xee);
    r[2] = (dp_lf)_mm256_shuffle_ps(b, d, 0x44), r[3] = (dp_lf)_mm256_shuffle_ps(b, d, 0xee);
#else
    const __m512 a = _mm512_unpacklo_ps((__m512)r[0], (__m512)r[1]),
                 b = _mm512_unpackhi_ps((__m512)r[0], (__m512)r[1]);
    const __m512 c = _mm512_unpacklo_ps((__m512)r[2], (__m512)r[3]),
                 d = _mm512_unpackhi_ps((__m512)r[2], (__m512)r[3]);
    r[0] = (dp_lf)_mm512_shuffle_ps(a, c, 0x44), r[1] = (dp_lf)_mm512_shuffle_ps(a, c, 0xee);
    r[2] = (dp_lf)_mm512_shuffle_ps(b, d, 0x44), r[3] = (dp_lf)_mm512_shuffle_ps(b, d, 0xee);
#endif
}
#endif

/* Writes lane l's record, given by columns, to `at` + l. */
DP_LANES_INLINE void l_put_records(void *at, dp_lf columns[4]) {
#if DP_LANES == 1
    memcpy(at, columns, 16);
#else
    l_transpose(columns);
    for (int i = 0; i < 4; i++) l_put_row((char *)at + 16 * i, 64, columns[i]);
#endif
}

/* The same, but around the caches, so that no other processor must give up its copy. `at` must be
 * aligned to 16 bytes. */
DP_LANES_INLINE void l_put_past_caches(void *at, dp_lf columns[4]) {
#if DP_LANES > 1 && defined __SSE2__
    float records[DP_LANES][4], *const out = at;
    l_put_records(records, columns);
    for (size_t l = 0; l < DP_LANES; l++) _mm_stream_ps(out + 4 * l, _mm_loadu_ps(records[l]));
#else
    l_put_records(at, columns);
#endif
}

/* Call this before others may read what was written around the caches. */
DP_LANES_INLINE void l_past_caches_done(void) {
#if DP_LANES > 1 && defined __SSE2__
    _mm_sfence();
#endif
}

/* Reads lane l's record, by columns. */
DP_LANES_INLINE void l_records(const void *base, const uint32_t at[DP_LANES], dp_lf out[4]) {
#if DP_LANES == 1
    memcpy(out, (const char *)base + 16 * (size_t)*at, 16);
#else
    for (int i = 0; i < 4; i++) out[i] = l_row(base, at + i, 1);
    l_transpose(out);
#endif
}

/* Bits of the first n lanes. */
DP_LANES_INLINE uint32_t lm_first(uint32_t n) {
    return n < DP_LANES ? (1u << n) - 1 : (uint32_t)((1ull << DP_LANES) - 1);
}

/* 0, 1, 2, … by lane. */
static const float dp_lane_steps[16] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
DP_LANES_INLINE dp_lf l_steps(void) { return l_load(dp_lane_steps); }

/* The mask with these bits; the inverse of lm_bits. */
DP_LANES_INLINE dp_lm lm_of_bits(uint32_t bits) {
#if DP_LANES == 1
    return bits & 1;
#elif DP_LANES == 16
    return (dp_lm)bits;
#else
    static const int32_t places[8] = {1, 2, 4, 8, 16, 32, 64, 128};
    const dp_li place = li_load(places);
    return li_eq(li_splat((int32_t)bits) & place, place);
#endif
}

/* ------- the same bits ------- */

DP_LANES_INLINE dp_li li_of_bits(dp_lf v) {
    dp_li bits;
    memcpy(&bits, &v, sizeof bits);
    return bits;
}
DP_LANES_INLINE dp_lf l_of_bits(dp_li v) {
    dp_lf value;
    memcpy(&value, &v, sizeof value);
    return value;
}

/* ------- 16 bits of a word, and floats of ints ------- */

DP_LANES_INLINE dp_lf l_from_int(dp_li v) {
#if DP_LANES == 1
    return (float)v;
#else
    return __builtin_convertvector(v, dp_lf);
#endif
}

/* `high`: the upper half, with its sign; `up`: the lower half moved to the upper. */
#if DP_LANES == 1
DP_LANES_INLINE dp_li li_high(dp_li v) { return (int16_t)((uint32_t)v >> 16); }
DP_LANES_INLINE dp_li li_up(dp_li v) { return (int32_t)((uint32_t)v << 16); }
#else
DP_LANES_INLINE dp_li li_high(dp_li v) { return v >> 16; }
DP_LANES_INLINE dp_li li_up(dp_li v) { return (dp_li)((dp_lu)v << 16); }
#endif

/* ------- rounding and powers ------- */

/* The largest whole number <= v; floats of 2^23 and more are whole. */
DP_LANES_INLINE dp_lf l_floor(dp_lf v) {
    const dp_lm small = l_lt(l_abs(v), l_splat(8388608));
    const dp_lf whole = l_from_int(l_truncate(l_select(small, v, l_splat(0))));
    return l_select(small, whole - l_select(l_gt(whole, v), l_splat(1), l_splat(0)), v);
}

/* The largest power of two <= v, for v positive and normal: v without its fraction bits. */
DP_LANES_INLINE dp_lf l_power_below(dp_lf v) {
#if DP_LANES == 1
    uint32_t bits;
    memcpy(&bits, &v, sizeof bits);
    bits &= 0x7f800000;
    memcpy(&v, &bits, sizeof bits);
    return v;
#else
    return (dp_lf)((dp_li)v & li_splat(0x7f800000));
#endif
}

/* Numbers of the lanes whose bit is set, ascending; what follows them is of no use. */
DP_LANES_INLINE dp_li li_order(uint32_t bits) {
#if DP_LANES == 1
    (void)bits;
    return 0;
#elif DP_LANES == 16
    return (dp_li)_mm512_maskz_compress_epi32(
        (__mmask16)bits, _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15));
#else
    uint32_t order[DP_LANES + 1] = {0}, n = 0;
    for (uint32_t l = 0; l < DP_LANES; l++) order[n] = l, n += bits >> l & 1;
    return li_load(order);
#endif
}

/* Lane l gets v[order[l]]. */
DP_LANES_INLINE dp_li li_permute(dp_li v, dp_li order) {
#if DP_LANES == 1
    (void)order;
    return v;
#elif DP_LANES == 8
    return (dp_li)_mm256_permutevar8x32_epi32((__m256i)v, (__m256i)order);
#elif DP_LANES == 16
    return (dp_li)_mm512_permutexvar_epi32((__m512i)order, (__m512i)v);
#else
    return (dp_li){v[order[0]], v[order[1]], v[order[2]], v[order[3]]};
#endif
}

/* Stores the low byte of every lane. */
DP_LANES_INLINE void li_store_bytes(uint8_t *p, dp_li v) {
#if DP_LANES == 1
    *p = (uint8_t)v;
#elif DP_LANES == 16
    _mm_storeu_si128((__m128i *)(void *)p, _mm512_cvtepi32_epi8((__m512i)v));
#else
    typedef uint8_t bytes __attribute__((vector_size(DP_LANES)));
    const bytes b = __builtin_convertvector((dp_lu)v, bytes);
    memcpy(p, &b, sizeof b);
#endif
}

/* Stores the lanes in `mask`. */
DP_LANES_INLINE void l_store_some(float *p, dp_lm mask, dp_lf v) {
#if DP_LANES == 16
    _mm512_mask_storeu_ps(p, mask, (__m512)v);
#else
    l_store(p, l_select(mask, v, l_load(p)));
#endif
}
DP_LANES_INLINE void li_store_some(void *p, dp_lm mask, dp_li v) {
#if DP_LANES == 16
    _mm512_mask_storeu_epi32(p, mask, (__m512i)v);
#else
    li_store(p, li_select(mask, v, li_load(p)));
#endif
}

#endif
