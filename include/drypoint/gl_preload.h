/* drypoint/gl_preload.h: lines for fixed-function OpenGL programs; Raskar 2001, Figure 3, literally.
 *
 *     glEnable(GL_SIL_RIDGE_VALLEY);
 *     glBegin(GL_TRIANGLES);
 *     glVertex3f(x, y, z);
 *     ...
 *     glEnd();
 *     glDisable(GL_SIL_RIDGE_VALLEY);
 *
 * and then, when it runs,
 *
 *     LD_PRELOAD=/usr/local/lib/drypoint/libdrypoint-preload.so ./program
 *
 * Nothing is linked. Without the library preloaded, glEnable answers GL_INVALID_ENUM and nothing else
 * happens; a program can ask so whether it gets lines (glGetError after it, or glIsEnabled). Programs
 * that do not ask get lines by the environment: DRYPOINT_LINES=1. docs/preload.md lists all variables
 * and says what is left as it is: programs with shaders of their own, textured and blended polygons. */
#ifndef DRYPOINT_GL_PRELOAD_H
#define DRYPOINT_GL_PRELOAD_H

/* A capability for glEnable, glDisable and glIsEnabled. Its value spells "DRYP". Khronos hands out
 * enumerants in blocks upwards from 0x8000 (2026: below 0xA000) and keeps 100000 to 110000 (decimal) for
 * history, so no extension can meet it; and it is no sum of bits that a bit field uses. */
#define GL_SIL_RIDGE_VALLEY 0x44525950

/* The same as an enumerant, for debuggers and bindings, which see no macros. */
enum dp_gl_capability { DP_GL_SIL_RIDGE_VALLEY = GL_SIL_RIDGE_VALLEY };

#endif
