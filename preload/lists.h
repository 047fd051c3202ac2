/* lists.h: display lists, and the triangles in them. */
#ifndef PRELOAD_LISTS_H
#define PRELOAD_LISTS_H

#include "context.h"

struct share_group *share_group_create(void); /* NULL without memory */
struct share_group *share_group_join(struct share_group *group);
void share_group_release(struct share_group *group);
void list_recorder_free(struct list_recorder *recorder);

/* While a list is compiled: is it only compiled, so that nothing is drawn now? */
bool list_only(const struct context *context);

/* Around polygons in the list that is being compiled. Vertices go to list_builder between them; NULL: there is
 * no list. */
void list_open_draw(struct context *context, GLenum mode);
struct polygon_builder *list_builder(const struct context *context);
void list_close_draw(struct context *context);

/* Before a call that changes state, or lines on or off, is compiled. */
void list_state_change(struct context *context);
/* glEnable or glDisable of our token is compiled; nothing of it reaches GL. */
void list_switch_lines(struct context *context, bool on);
/* glClear is compiled; false: GL must do it. */
bool list_clear(struct context *context, GLbitfield mask);

#endif
