/* shaders.h: the texts of our three programs (shaders.c). */
#ifndef PRELOAD_SHADERS_H
#define PRELOAD_SHADERS_H

extern const char shader_paper_vertex[], shader_paper_fragment[];
extern const char shader_lines_vertex[], shader_lines_geometry[], shader_lines_fragment[];
extern const char shader_cover_vertex[], shader_cover_fragment[];

#endif
