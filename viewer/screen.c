/* The picture on the window, by glBlitFramebuffer: no shader is needed, and any OpenGL from 3.0 on has it. */
#include "screen.h"

#include <GL/glcorearb.h>

#include <stdlib.h>
#include <string.h>

/* X(name, type of the pointer) */
#define FUNCTIONS(X)                                                                               \
    X(GenTextures, PFNGLGENTEXTURESPROC)                                                           \
    X(BindTexture, PFNGLBINDTEXTUREPROC)                                                           \
    X(TexImage2D, PFNGLTEXIMAGE2DPROC)                                                             \
    X(TexSubImage2D, PFNGLTEXSUBIMAGE2DPROC)                                                       \
    X(TexParameteri, PFNGLTEXPARAMETERIPROC)                                                       \
    X(DeleteTextures, PFNGLDELETETEXTURESPROC)                                                     \
    X(GenFramebuffers, PFNGLGENFRAMEBUFFERSPROC)                                                   \
    X(BindFramebuffer, PFNGLBINDFRAMEBUFFERPROC)                                                   \
    X(FramebufferTexture2D, PFNGLFRAMEBUFFERTEXTURE2DPROC)                                         \
    X(DeleteFramebuffers, PFNGLDELETEFRAMEBUFFERSPROC)                                             \
    X(BlitFramebuffer, PFNGLBLITFRAMEBUFFERPROC)                                                   \
    X(Viewport, PFNGLVIEWPORTPROC)                                                                 \
    X(ClearColor, PFNGLCLEARCOLORPROC)                                                             \
    X(Clear, PFNGLCLEARPROC)

struct screen {
    GLuint texture, framebuffer; /* of uploaded pictures */
    GLsizei width, height;       /* of the texture; 0: none yet */
    GLuint shown;                /* framebuffer; 0: none */
    GLint shown_width, shown_height;
    bool turned; /* its first row is the highest */
#define MEMBER(name, type) type name;
    FUNCTIONS(MEMBER)
#undef MEMBER
};

screen *screen_create(void *(*function)(void *user, const char *name)) {
    screen *const s = calloc(1, sizeof *s);
    bool all = s != NULL;
    void *address;
#define LOAD(name, type)                                                                           \
    address = s ? function(NULL, "gl" #name) : NULL;                                               \
    all &= address != NULL;                                                                        \
    if (s) memcpy(&s->name, &address, sizeof address);
    FUNCTIONS(LOAD)
#undef LOAD
    if (!all) {
        free(s);
        return NULL;
    }
    s->GenTextures(1, &s->texture);
    s->BindTexture(GL_TEXTURE_2D, s->texture);
    s->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR); /* there are no levels */
    s->GenFramebuffers(1, &s->framebuffer);
    return s;
}

void screen_destroy(screen *s) {
    if (!s) return;
    s->DeleteFramebuffers(1, &s->framebuffer);
    s->DeleteTextures(1, &s->texture);
    free(s);
}

void screen_upload(screen *s, const uint8_t *rgba, uint32_t width, uint32_t height) {
    const GLsizei w = (GLsizei)width, h = (GLsizei)height;
    s->BindTexture(GL_TEXTURE_2D, s->texture);
    if (s->width == w && s->height == h) {
        s->TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, w, h, GL_RGBA, GL_UNSIGNED_BYTE, rgba);
    } else {
        s->TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, w, h, 0, GL_RGBA, GL_UNSIGNED_BYTE, rgba);
        s->BindFramebuffer(GL_READ_FRAMEBUFFER, s->framebuffer);
        s->FramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D,
                                s->texture, 0);
        s->width = w, s->height = h;
    }
    s->shown = s->framebuffer;
    s->shown_width = w, s->shown_height = h;
    s->turned = true;
}

void screen_borrow(screen *s, uint32_t framebuffer, uint32_t width, uint32_t height) {
    s->shown = framebuffer;
    s->shown_width = (GLint)width, s->shown_height = (GLint)height;
    s->turned = false;
}

void screen_show(const screen *s, int width, int height) {
    s->BindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    s->Viewport(0, 0, width, height);
    if (!s->shown) {
        s->ClearColor(1, 1, 1, 1);
        s->Clear(GL_COLOR_BUFFER_BIT);
        return;
    }
    const bool same = s->shown_width == width && s->shown_height == height;
    s->BindFramebuffer(GL_READ_FRAMEBUFFER, s->shown);
    s->BlitFramebuffer(0, 0, s->shown_width, s->shown_height, 0, s->turned ? height : 0, width,
                       s->turned ? 0 : height, GL_COLOR_BUFFER_BIT, same ? GL_NEAREST : GL_LINEAR);
    s->BindFramebuffer(GL_FRAMEBUFFER, 0);
}
