/* What a key view may not be. */
#ifndef DP_CORE_PATH_H
#define DP_CORE_PATH_H

#include <drypoint/path.h>

/* What is wrong with a view that comes after `before` (or NULL), to follow "view 3 …"; or NULL. */
const char *dp_key_view_mistake(const dp_key_view *view, const dp_key_view *before);

#endif
