/* immediate.h: vertices in immediate mode. */
#ifndef PRELOAD_IMMEDIATE_H
#define PRELOAD_IMMEDIATE_H

/* A vertex between glBegin and glEnd, for whoever records (immediate.c). */
void immediate_vertex(float x, float y, float z, float w);

#endif
