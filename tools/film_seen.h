/* All that a film shows, as one source for a camera to be fitted to. */
#ifndef TOOL_FILM_SEEN_H
#define TOOL_FILM_SEEN_H

#include "film_plan.h"

/* Makes a source of the model as it is at some of the film's frames (all, if they are few), one
 * after the other; with `turned`, also turned as they see it, and with what is `beside` it unless that is NULL (a mirror's box, borrowed). It borrows `source` and *plan, and moves the source's time.
 * *polygons, unless NULL, becomes how many the model has. 0, or the exit code after a message; the caller destroys *out before the source. */
int film_seen_make(const film_plan *plan, dp_source *source, bool turned, const dp_extent *beside,
                   dp_source **out, uint64_t *polygons);

#endif
