/* real.h: the GL, GLX and EGL functions behind ours.
 *
 * A preloaded library stands before libGL in the order in which names are found, so a program's call
 * of glBegin reaches ours; dlsym(RTLD_NEXT) finds the one behind. Inside this folder a bare glBegin(...)
 * would call ourselves: always gl.glBegin(...). */
#ifndef PRELOAD_REAL_H
#define PRELOAD_REAL_H

#define GL_GLEXT_PROTOTYPES
#define GLX_GLXEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/glext.h>
#include <GL/glx.h>
#include <stdbool.h>

#define EXPORT __attribute__((visibility("default")))

/* EGL, GLFW and SDL as far as we need them, so that their headers need not be there. */
typedef void (*any_function)(void);
unsigned eglSwapBuffers(void *display, void *surface);
unsigned eglSwapBuffersWithDamageEXT(void *display, void *surface, const int *rects, int count);
unsigned eglSwapBuffersWithDamageKHR(void *display, void *surface, const int *rects, int count);
unsigned eglMakeCurrent(void *display, void *draw, void *read, void *context);
void *eglCreateContext(void *display, void *config, void *share, const int *attributes);
unsigned eglDestroyContext(void *display, void *context);
void *eglGetCurrentContext(void);
any_function eglGetProcAddress(const char *name);
void glfwSwapBuffers(void *window);
void SDL_GL_SwapWindow(void *window);

/* What we call and do not replace. */
/* clang-format off */
#define PLAIN_FUNCTIONS(X) \
    X(glGetIntegerv) X(glGetFloatv) X(glGetDoublev) X(glGetBooleanv) X(glGetString) X(glGetPointerv) X(glIsList) \
    X(glGetBufferSubData) X(glGetBufferParameteriv) X(glUniform1i) X(glUniform1f) X(glUniform2f) \
    X(glUniform3f) X(glUniform4f) X(glUniform4fv) X(glUniformMatrix4fv) X(glUniformMatrix3fv) \
    X(glGetUniformLocation) X(glCreateShader) X(glShaderSource) X(glCompileShader) \
    X(glGetShaderiv) X(glGetShaderInfoLog) X(glDeleteShader) X(glCreateProgram) \
    X(glAttachShader) X(glLinkProgram) X(glGetProgramiv) X(glGetProgramInfoLog) \
    X(glBindAttribLocation) X(glGenVertexArrays) X(glBindVertexArray) \
    X(glEnableVertexAttribArray) X(glVertexAttribPointer) X(glGenBuffers) X(glBindBuffer) \
    X(glBufferData) X(glBufferSubData) X(glGenFramebuffers) X(glFramebufferTexture2D) \
    X(glCheckFramebufferStatus) X(glGenTextures) X(glBindTexture) X(glTexImage2D) \
    X(glTexParameteri) X(glClearColor) X(glBlendEquation) X(glPixelTransferf) X(glGetTexEnviv) \
    X(glXGetCurrentContext) X(eglGetCurrentContext)
/* clang-format on */

/* What we replace: each has a function of its own name in this folder. First what changes the state that
 * lines depend on (state_calls.c), with its parameters and arguments. */
#define STATE_FUNCTIONS(X)                                                                         \
    X(glBlendFunc, (GLenum a, GLenum b), (a, b))                                                   \
    X(glBlendFuncSeparate, (GLenum a, GLenum b, GLenum c, GLenum d), (a, b, c, d))                 \
    X(glDepthFunc, (GLenum f), (f))                                                                \
    X(glDepthMask, (GLboolean on), (on))                                                           \
    X(glDepthRange, (GLdouble n, GLdouble f), (n, f))                                              \
    X(glColorMask, (GLboolean r, GLboolean g, GLboolean b, GLboolean a), (r, g, b, a))             \
    X(glFrontFace, (GLenum winding), (winding))                                                    \
    X(glCullFace, (GLenum side), (side))                                                           \
    X(glPolygonMode, (GLenum side, GLenum mode), (side, mode))                                     \
    X(glViewport, (GLint x, GLint y, GLsizei w, GLsizei h), (x, y, w, h))                          \
    X(glScissor, (GLint x, GLint y, GLsizei w, GLsizei h), (x, y, w, h))                           \
    X(glMatrixMode, (GLenum mode), (mode))                                                         \
    X(glLoadIdentity, (void), ())                                                                  \
    X(glLoadMatrixf, (const GLfloat *m), (m))                                                      \
    X(glLoadMatrixd, (const GLdouble *m), (m))                                                     \
    X(glMultMatrixf, (const GLfloat *m), (m))                                                      \
    X(glMultMatrixd, (const GLdouble *m), (m))                                                     \
    X(glLoadTransposeMatrixf, (const GLfloat m[16]), (m))                                          \
    X(glLoadTransposeMatrixd, (const GLdouble m[16]), (m))                                         \
    X(glMultTransposeMatrixf, (const GLfloat m[16]), (m))                                          \
    X(glMultTransposeMatrixd, (const GLdouble m[16]), (m))                                         \
    X(glTranslatef, (GLfloat x, GLfloat y, GLfloat z), (x, y, z))                                  \
    X(glTranslated, (GLdouble x, GLdouble y, GLdouble z), (x, y, z))                               \
    X(glRotatef, (GLfloat a, GLfloat x, GLfloat y, GLfloat z), (a, x, y, z))                       \
    X(glRotated, (GLdouble a, GLdouble x, GLdouble y, GLdouble z), (a, x, y, z))                   \
    X(glScalef, (GLfloat x, GLfloat y, GLfloat z), (x, y, z))                                      \
    X(glScaled, (GLdouble x, GLdouble y, GLdouble z), (x, y, z))                                   \
    X(glOrtho, (GLdouble l, GLdouble r, GLdouble b, GLdouble t, GLdouble n, GLdouble f),           \
      (l, r, b, t, n, f))                                                                          \
    X(glFrustum, (GLdouble l, GLdouble r, GLdouble b, GLdouble t, GLdouble n, GLdouble f),         \
      (l, r, b, t, n, f))                                                                          \
    X(glPushMatrix, (void), ())                                                                    \
    X(glPopMatrix, (void), ())                                                                     \
    X(glPushAttrib, (GLbitfield mask), (mask))                                                     \
    X(glPopAttrib, (void), ())                                                                     \
    X(glActiveTexture, (GLenum unit), (unit))                                                      \
    X(glActiveTextureARB, (GLenum unit), (unit))                                                   \
    X(glUseProgram, (GLuint program), (program))                                                   \
    X(glUseProgramObjectARB, (GLhandleARB program), (program))                                     \
    X(glBindProgramPipeline, (GLuint pipeline), (pipeline))                                        \
    X(glListBase, (GLuint base), (base))

/* Then what reads the picture back, so that the lines must be drawn before (state_calls.c). */
#define READ_FUNCTIONS(X)                                                                          \
    X(glReadPixels, (GLint x, GLint y, GLsizei w, GLsizei h, GLenum f, GLenum t, void *p),         \
      (x, y, w, h, f, t, p))                                                                       \
    X(glCopyPixels, (GLint x, GLint y, GLsizei w, GLsizei h, GLenum t), (x, y, w, h, t))           \
    X(glCopyTexImage1D, (GLenum t, GLint l, GLenum f, GLint x, GLint y, GLsizei w, GLint border),  \
      (t, l, f, x, y, w, border))                                                                  \
    X(glCopyTexImage2D,                                                                            \
      (GLenum t, GLint l, GLenum f, GLint x, GLint y, GLsizei w, GLsizei h, GLint border),         \
      (t, l, f, x, y, w, h, border))                                                               \
    X(glCopyTexSubImage1D, (GLenum t, GLint l, GLint to, GLint x, GLint y, GLsizei w),             \
      (t, l, to, x, y, w))                                                                         \
    X(glCopyTexSubImage2D,                                                                         \
      (GLenum t, GLint l, GLint tx, GLint ty, GLint x, GLint y, GLsizei w, GLsizei h),             \
      (t, l, tx, ty, x, y, w, h))                                                                  \
    X(glCopyTexSubImage3D,                                                                         \
      (GLenum t, GLint l, GLint tx, GLint ty, GLint tz, GLint x, GLint y, GLsizei w, GLsizei h),   \
      (t, l, tx, ty, tz, x, y, w, h))                                                              \
    X(glAccum, (GLenum op, GLfloat value), (op, value))                                            \
    X(glBlitFramebuffer,                                                                           \
      (GLint a, GLint b, GLint c, GLint d, GLint e, GLint f, GLint g, GLint h, GLbitfield m,       \
       GLenum filter),                                                                             \
      (a, b, c, d, e, f, g, h, m, filter))

/* The others that we replace. */
/* clang-format off */
#define OWN_FUNCTIONS(X) \
    X(glBegin) X(glEnd) X(glArrayElement) X(glDrawArrays) X(glDrawElements) X(glDrawRangeElements) \
    X(glMultiDrawArrays) X(glMultiDrawElements) X(glNewList) X(glEndList) X(glCallList) \
    X(glCallLists) X(glDeleteLists) X(glEnable) X(glDisable) X(glIsEnabled) X(glGetError) \
    X(glClear) X(glFlush) X(glFinish) X(glBindFramebuffer) X(glBindFramebufferEXT) \
    X(glRenderMode) X(glXSwapBuffers) X(glXMakeCurrent) X(glXMakeContextCurrent) \
    X(glXCreateContext) X(glXCreateNewContext) X(glXCreateContextAttribsARB) \
    X(glXDestroyContext) X(glXGetProcAddress) X(glXGetProcAddressARB) X(eglSwapBuffers) \
    X(eglSwapBuffersWithDamageEXT) X(eglSwapBuffersWithDamageKHR) X(eglMakeCurrent) \
    X(eglCreateContext) X(eglDestroyContext) X(eglGetProcAddress) X(glfwSwapBuffers) \
    X(SDL_GL_SwapWindow)
/* clang-format on */

/* glVertex in its 24 kinds, and glRect in its 8. */
/* clang-format off */
#define VERTEX_NAMES(X) \
    X(glVertex2s) X(glVertex2i) X(glVertex2f) X(glVertex2d) X(glVertex2sv) X(glVertex2iv) X(glVertex2fv) \
    X(glVertex2dv) X(glVertex3s) X(glVertex3i) X(glVertex3f) X(glVertex3d) X(glVertex3sv) \
    X(glVertex3iv) X(glVertex3fv) X(glVertex3dv) X(glVertex4s) X(glVertex4i) X(glVertex4f) \
    X(glVertex4d) X(glVertex4sv) X(glVertex4iv) X(glVertex4fv) X(glVertex4dv) X(glRects) \
    X(glRecti) X(glRectf) X(glRectd) X(glRectsv) X(glRectiv) X(glRectfv) X(glRectdv)
/* clang-format on */

/* All of them, NULL where the libraries loaded do not have one. Written once, by real_load. */
struct real_functions {
#define MEMBER(name)                                 __typeof__(&name) name;
#define MEMBER_OF_THREE(name, parameters, arguments) MEMBER(name)
    PLAIN_FUNCTIONS(MEMBER)
    OWN_FUNCTIONS(MEMBER)
    VERTEX_NAMES(MEMBER)
    STATE_FUNCTIONS(MEMBER_OF_THREE)
    READ_FUNCTIONS(MEMBER_OF_THREE)
#undef MEMBER
#undef MEMBER_OF_THREE
};
extern struct real_functions gl;

/* Passes a call on, if there is someone. */
#define CALL(function, ...)                                                                        \
    do {                                                                                           \
        if (gl.function) gl.function(__VA_ARGS__);                                                 \
    } while (0)

/* Fills `gl`; cheap after the first time. Every function that we replace begins with it, directly or
 * through context_current. */
void real_load(void);

/* Ours of that name, if we replace it and the real one exists; else NULL. */
any_function real_replacement(const char *name);

#endif
