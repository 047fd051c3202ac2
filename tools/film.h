/* Films: one drawing after the other, of a model that moves or is walked round. */
#ifndef TOOL_FILM_H
#define TOOL_FILM_H

#include "options.h"

/* Do the settings ask for a film, or for one frame of it? */
bool film_wanted(const tool_settings *s);
/* A film whose camera stands is one of the model's own motion, from --time 0 on if no other is given. */
void film_settle(tool_settings *s);
/* Is what they ask for possible? A message on stderr if not. */
bool film_check(const tool_settings *s);
/* Draws it. The program's exit code. */
int film_draw(const tool_settings *s);

#endif
