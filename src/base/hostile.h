/* Sizes that only speed depends on, and their smallest values that still work.
 *
 * The hostile build (DRYPOINT_HOSTILE) takes the small ones: every array moves whenever it grows,
 * every batch, chunk and tile ends after a few items, so that what goes wrong at such a border, at
 * a size of millions, goes wrong in every test. Results must be the same. */
#ifndef DP_BASE_HOSTILE_H
#define DP_BASE_HOSTILE_H

#ifdef DP_HOSTILE
#define DP_TUNED(fast, hostile) (hostile)
#else
#define DP_TUNED(fast, hostile) (fast)
#endif

#endif
