/* Rules of ornaments (ornaments.c), for the table of presets: from (u, v) in [0, 1]² to ink in
 * [0, 1]. */
#ifndef DP_TEXTURE_RULES_H
#define DP_TEXTURE_RULES_H

#include "base/vec.h"

#include <stdint.h>

typedef float dp_rule(float u, float v, uint32_t seed);

dp_rule dp_rule_hatch, dp_rule_rope, dp_rule_waves, dp_rule_checks, dp_rule_chevrons, dp_rule_lace,
    dp_rule_meander;

#endif
