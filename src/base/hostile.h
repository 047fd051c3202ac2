/* Sizes on which only speed depends, and their smallest values that still work.
 *
 * The hostile build (DRYPOINT_HOSTILE) uses the small ones: arrays move whenever they grow;
 * batches, chunks and tiles end after a few items. What would go wrong at a border in one of
 * millions of items then goes wrong in every test. Invariant: results are the same. */
#ifndef DP_BASE_HOSTILE_H
#define DP_BASE_HOSTILE_H

#ifdef DP_HOSTILE
#define DP_TUNED(fast, hostile) (hostile)
#else
#define DP_TUNED(fast, hostile) (fast)
#endif

#endif
