/* shaders.h: the texts of our three programs (shaders.c). */
#ifndef PRELOAD_SHADERS_H
#define PRELOAD_SHADERS_H

/* The parts of a shader, in order; the others are NULL. */
enum { SHADER_PARTS = 5 };
typedef const char *const shader_text[SHADER_PARTS];

extern const shader_text shader_paper_vertex, shader_paper_fragment;
extern const shader_text shader_lines_vertex, shader_lines_geometry, shader_lines_fragment;
extern const shader_text shader_cover_vertex, shader_cover_fragment;

#endif
