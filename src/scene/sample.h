/* The value of a channel at a time. */
#ifndef DP_SCENE_SAMPLE_H
#define DP_SCENE_SAMPLE_H

#include <drypoint/scene.h>

/* Writes the channel's `width` values at `time`, as glTF 2.0, appendix C, has them. False: there
 * are no keys, and nothing is written. Rotations have any length. */
bool dp_channel_sample(const dp_scene_channel *channel, double time, double *to);

#endif
