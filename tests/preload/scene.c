/* scene.c: a program of the fixed-function kind that knows nothing of Drypoint, but for one scene that asks.
 *
 *     scene NAME picture.ppm [repeat]
 *
 * opens a window, draws one scene, and writes what the window shows after glXSwapBuffers. What it has to
 * say of GL (errors, state) goes to stdout, to be compared with and without the library preloaded. */
#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/glext.h>
#include <GL/glx.h>
#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <drypoint/gl_preload.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bracket.h"

static Display *display;
static Window window;
static XVisualInfo *visual;
static GLXContext context;

/* ---- the bracket ---- */

/* Quads: 3 in front, 3 at the back, 8 at the sides; 4 corners each, and again by index. */
enum { QUADS = 14 };
static float corners[4 * QUADS][3];
static GLubyte order[4 * QUADS];
static float normals[QUADS][3];

static void set_quad(int quad, const float p[4][3], float nx, float ny, float nz) {
    memcpy(corners[4 * quad], p, 12 * sizeof(float));
    memcpy(normals[quad], (const float[3]){nx, ny, nz}, 3 * sizeof(float));
    for (int i = 0; i < 4; i++) order[4 * quad + i] = (GLubyte)(4 * quad + i);
}

static void make_bracket(void) {
    float p[4][3];
    for (int c = 0; c < 6; c++) {
        const int back = c / 3;
        for (int i = 0; i < 4; i++) {
            const float *const at = bracket_profile[bracket_cap[c % 3][back ? 3 - i : i]];
            memcpy(p[i], (const float[3]){at[0], at[1], back ? 0 : 2}, sizeof p[i]);
        }
        set_quad(c, (const float(*)[3])p, 0, 0, back ? -1 : 1);
    }
    for (int s = 0; s < BRACKET_SIDES; s++) {
        const float *const a = bracket_profile[s], *const b =
                                                       bracket_profile[(s + 1) % BRACKET_SIDES];
        const float side[4][3] = {
            {b[0], b[1], 2}, {a[0], a[1], 2}, {a[0], a[1], 0}, {b[0], b[1], 0}};
        const float length = (a[0] == b[0]) ? (b[1] > a[1] ? b[1] - a[1] : a[1] - b[1])
                                            : (b[0] > a[0] ? b[0] - a[0] : a[0] - b[0]);
        set_quad(6 + s, side, (b[1] - a[1]) / length, (a[0] - b[0]) / length, 0);
    }
}

static void send_quads(int from, int to) {
    glBegin(GL_QUADS);
    for (int q = from; q < to; q++) {
        glNormal3fv(normals[q]);
        for (int i = 0; i < 4; i++) glVertex3fv(corners[4 * q + i]);
    }
    glEnd();
}

static void look_at_bracket(void) {
    const float half = PICTURE / 2 / bracket_scale;
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glOrtho(-half, half, -half, half, 1, 20);
    glMatrixMode(GL_MODELVIEW);
    glLoadMatrixf(bracket_modelview);
}

static void draw_begin(void) { send_quads(0, QUADS); }

/* Other kinds of vertices and of primitives, and some that are not drawn to the end. */
static void draw_strips(void) {
    send_quads(0, 6);
    glBegin(GL_QUAD_STRIP);
    for (int s = 0; s <= BRACKET_SIDES; s++) {
        const float *const p = bracket_profile[s % BRACKET_SIDES];
        glVertex3d(p[0], p[1], 2);
        glVertex4f(2 * p[0], 2 * p[1], 0, 2);
    }
    glVertex2i(7, 7);
    glEnd();
}

static void draw_list(void) {
    const GLuint list = glGenLists(1);
    glNewList(list, GL_COMPILE);
    send_quads(0, QUADS);
    glEndList();
    glCallList(list);
    glDeleteLists(list, 1);
}

/* Moves, lists in lists, and glCallLists, with names that nobody was asked for. */
static void draw_nested(void) {
    glNewList(7, GL_COMPILE);
    send_quads(0, 6);
    glTranslatef(0, 0, 5);
    send_quads(6, 8);
    glTranslatef(0, 0, -5);
    glEndList();
    glNewList(8, GL_COMPILE);
    send_quads(8, QUADS);
    glEndList();
    glNewList(9, GL_COMPILE);
    glPushMatrix();
    glTranslatef(1, 0, 0);
    const GLubyte names[] = {7, 8};
    glCallLists(2, GL_UNSIGNED_BYTE, names);
    glPopMatrix();
    glTranslatef(0, 0, -5);
    glCallList(10);
    glEndList();
    glNewList(10, GL_COMPILE);
    send_quads(6, 8);
    glEndList();
    glTranslatef(-1, 0, 0);
    glPushMatrix();
    glTranslatef(0, 0, -5);
    glCallList(9);
    glPopMatrix();
    glTranslatef(1, 0, 0);
    /* What list 7 drew five units off, and where it belongs. */
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glTranslatef(-1, 0, 0);
    glNewList(11, GL_COMPILE_AND_EXECUTE);
    glTranslatef(1, 0, 0);
    send_quads(0, 6);
    glCallList(8);
    glEndList();
    glCallList(10);
}

static void draw_arrays(void) {
    glEnableClientState(GL_VERTEX_ARRAY);
    glVertexPointer(3, GL_FLOAT, 0, corners);
    glDrawArrays(GL_QUADS, 0, 4 * QUADS);
    glDisableClientState(GL_VERTEX_ARRAY);
}

static void draw_elements(void) {
    glEnableClientState(GL_VERTEX_ARRAY);
    glVertexPointer(3, GL_FLOAT, sizeof corners[0], corners);
    glDrawElements(GL_QUADS, 4 * 6, GL_UNSIGNED_BYTE, order);
    glDrawRangeElements(GL_QUADS, 0, 4 * QUADS - 1, 4 * (QUADS - 6), GL_UNSIGNED_BYTE, order + 24);
    glDisableClientState(GL_VERTEX_ARRAY);
}

/* Vertices and indices in buffer objects, the vertex buffer no longer bound at the draw call. */
static void draw_buffers(void) {
    GLuint buffers[2];
    glGenBuffers(2, buffers);
    glBindBuffer(GL_ARRAY_BUFFER, buffers[0]);
    glBufferData(GL_ARRAY_BUFFER, sizeof corners, corners, GL_STATIC_DRAW);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers[1]);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, sizeof order, order, GL_STATIC_DRAW);
    glEnableClientState(GL_VERTEX_ARRAY);
    glVertexPointer(3, GL_FLOAT, 0, NULL);
    glBindBuffer(GL_ARRAY_BUFFER, 0);
    glDrawElements(GL_QUADS, 4 * QUADS, GL_UNSIGNED_BYTE, NULL);
    glDisableClientState(GL_VERTEX_ARRAY);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, 0);
    glDeleteBuffers(2, buffers);
}

/* Inverted winding, and no face culled: the picture is the same. */
static void draw_inside_out(void) {
    glFrontFace(GL_CW);
    glEnable(GL_CULL_FACE);
    glCullFace(GL_FRONT); /* counter-clockwise is back: nothing that shows is culled */
    draw_begin();
    glCullFace(GL_BACK);
    glFrontFace(GL_CCW);
    glDisable(GL_CULL_FACE);
}

/* Raskar's Figure 3. */
static void draw_asking(void) {
    static const float sun[4] = {1, 2, 3, 0};
    while (glGetError() != GL_NO_ERROR) continue;
    glEnable(GL_LIGHTING);
    glEnable(GL_LIGHT0);
    glLightfv(GL_LIGHT0, GL_POSITION, sun);
    glEnable(GL_SIL_RIDGE_VALLEY);
    printf("asked: error 0x%x, enabled %d\n", glGetError(), glIsEnabled(GL_SIL_RIDGE_VALLEY));
    draw_begin();
    glDisable(GL_SIL_RIDGE_VALLEY);
    while (glGetError() != GL_NO_ERROR) continue;
    glDisable(GL_LIGHTING);
    glLoadIdentity();
    glTranslatef(-2.4f, -2.4f, -10);
    glScalef(0.2f, 0.2f, 0.2f);
    draw_begin(); /* no lines */
}

/* Another context, found by name, that shares the display lists; the first is destroyed meanwhile, with a list
 * half compiled. */
static void draw_contexts(void) {
    typedef GLXContext create_context(Display *, XVisualInfo *, GLXContext, Bool);
    typedef void call_list(GLuint);
    create_context *const create =
        (create_context *)glXGetProcAddress((const GLubyte *)"glXCreateContext");
    call_list *const call = (call_list *)glXGetProcAddressARB((const GLubyte *)"glCallList");
    glNewList(1, GL_COMPILE);
    send_quads(0, QUADS);
    glEndList();
    glNewList(2, GL_COMPILE);
    send_quads(0, 2);
    const GLXContext other = create(display, visual, context, True);
    glXMakeCurrent(display, window, other);
    glXDestroyContext(display, context);
    context = other;
    glClearColor(1, 1, 1, 0);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glEnable(GL_DEPTH_TEST);
    look_at_bracket();
    call(1);
}

/* ---- what is to be left as it is ---- */

static void square(float x, float y, float z) {
    glBegin(GL_QUADS);
    glTexCoord2f(0, 0);
    glVertex3f(x, y, z);
    glTexCoord2f(1, 0);
    glVertex3f(x + 1, y, z);
    glTexCoord2f(1, 1);
    glVertex3f(x + 1, y + 1, z);
    glTexCoord2f(0, 1);
    glVertex3f(x, y + 1, z);
    glEnd();
}

static void textured_square(void) {
    static const GLubyte pixels[2][2][4] = {{{255, 0, 0, 255}, {0, 255, 0, 255}},
                                            {{0, 0, 255, 255}, {255, 255, 0, 255}}};
    GLuint texture;
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 2, 2, 0, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
    glEnable(GL_TEXTURE_2D);
    square(-2, -2, -5);
    glDisable(GL_TEXTURE_2D);
}

static void blended_square(void) {
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    glColor4f(0.2f, 0.4f, 0.8f, 0.5f);
    square(-1.5f, -0.5f, -4);
    glDisable(GL_BLEND);
}

static void shader_square(void) {
    static const char *text =
        "void main() { gl_FragColor = vec4(0.1, 0.7, gl_FragCoord.x / 200.0, 1.0); }";
    const GLuint program = glCreateProgram(), shader = glCreateShader(GL_FRAGMENT_SHADER);
    glShaderSource(shader, 1, &text, NULL);
    glCompileShader(shader);
    glAttachShader(program, shader);
    glLinkProgram(program);
    glUseProgram(program);
    square(0.5f, -1, -5);
    glUseProgram(0);
}

/* Also wire frames, lines, points, and what is not depth-tested. */
static void draw_untouched(void) {
    glLoadIdentity();
    textured_square();
    blended_square();
    shader_square();
    glColor3f(0.5f, 0, 0.5f);
    glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
    square(0.2f, 1.2f, -5);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    glBegin(GL_LINES);
    glVertex3f(-2, 2, -6);
    glVertex3f(2, -2, -6);
    glEnd();
    glDisable(GL_DEPTH_TEST);
    square(-2, 1, -5);
    glRectf(1.5f, 1.5f, 2, 2);
    glEnable(GL_DEPTH_TEST);
}

/* ---- state and errors ---- */

/* Much of what a program can ask, after its bracket was drawn and the buffers were swapped. */
static void print_state(void) {
    for (GLenum name = 0x0B00; name < 0x0E00; name++) {
        GLint value[16] = {0};
        glGetIntegerv(name, value);
        const GLenum error = glGetError();
        printf("%x: %x", name, error);
        for (int i = 0; i < 16 && error == GL_NO_ERROR; i++) printf(" %d", value[i]);
        printf("\n");
    }
    static const GLenum others[] = {GL_CURRENT_PROGRAM,
                                    GL_VERTEX_ARRAY_BINDING,
                                    GL_ARRAY_BUFFER_BINDING,
                                    GL_ACTIVE_TEXTURE,
                                    GL_DRAW_FRAMEBUFFER_BINDING,
                                    GL_READ_FRAMEBUFFER_BINDING,
                                    GL_TEXTURE_BINDING_2D,
                                    GL_BLEND_EQUATION_RGB,
                                    GL_BLEND_SRC_RGB,
                                    GL_ATTRIB_STACK_DEPTH,
                                    GL_MODELVIEW_STACK_DEPTH,
                                    GL_DRAW_BUFFER,
                                    GL_READ_BUFFER,
                                    GL_MATRIX_MODE,
                                    GL_VIEWPORT,
                                    GL_CLIENT_ACTIVE_TEXTURE};
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++) {
        GLint value[4] = {0};
        glGetIntegerv(others[i], value);
        printf("%x: %d %d %d %d\n", others[i], value[0], value[1], value[2], value[3]);
    }
}

static void draw_state(void) {
    glEnable(GL_SCISSOR_TEST);
    glScissor(0, 0, PICTURE, PICTURE);
    glEnable(GL_FOG);
    glEnable(GL_CLIP_PLANE1);
    glClearColor(0.1f, 0.2f, 0.3f, 0.4f);
    draw_begin();
    glXSwapBuffers(display, window);
    print_state();
    glDisable(GL_CLIP_PLANE1);
    glDisable(GL_FOG);
}

static void print_errors(const char *after) {
    printf("%s:", after);
    for (int i = 0; i < 8; i++) {
        const GLenum error = glGetError();
        printf(" %x", error);
        if (error == GL_NO_ERROR) break;
    }
    printf("\n");
}

static void wild_begins(void) {
    glEnd();
    print_errors("end alone");
    glVertex3f(1, 2, 3);
    glBegin(GL_TRIANGLES);
    glBegin(GL_QUADS);
    glVertex3f(1, 2, 3);
    glEnable(GL_BLEND);
    glClear(GL_COLOR_BUFFER_BIT);
    glCallList(4711);
    glEnd();
    print_errors("begin in begin");
    glBegin(99);
    glEnd();
    print_errors("bad mode");
    glBegin(GL_POLYGON);
    glVertex4f(1, 2, 3, 0);
    glVertex4f(1, 2, 3, -1);
    glVertex3f(1e38f, -1e38f, 1e38f);
    glEnd();
    print_errors("vertices far away");
    glBegin(GL_TRIANGLE_STRIP);
    for (int i = 0; i < 400000; i++) glVertex3f((float)(i % 7) / 1000, (float)(i % 5) / 1000, -5);
    glEnd();
    print_errors("many vertices");
}

static void wild_lists(void) {
    glEndList();
    print_errors("end list alone");
    glNewList(0, GL_COMPILE);
    glNewList(3, 77);
    print_errors("bad lists");
    glNewList(3, GL_COMPILE);
    glNewList(4, GL_COMPILE);
    print_errors("list in list");
    glColor3f(0, 1, 0);
    glVertex3f(0, 0, 0);
    glEndList();
    glBegin(GL_TRIANGLES);
    for (int i = 0; i < 3; i++) glCallList(3);
    glCallLists(2, GL_UNSIGNED_BYTE, "\3\3");
    glEnd();
    print_errors("lists in begin");
    glNewList(5, GL_COMPILE);
    glPushMatrix();
    glCallList(5);
    square(0, 0, 0);
    glPopMatrix();
    glEndList();
    glCallList(5);
    while (glGetError() != GL_NO_ERROR) continue; /* how deep it went is GL's own */
    glCallLists(-1, GL_INT, NULL);
    glCallLists(1, 12345, "");
    print_errors("bad call lists");
    glDeleteLists(1, 10000);
    glDeleteLists(1, -3);
    print_errors("deleted");
}

static void wild_arrays(void) {
    GLuint buffer;
    static const GLuint far_index[3] = {0, 1, 0x7fffff};
    glDrawArrays(GL_TRIANGLES, 0, -5);
    glDrawArrays(GL_TRIANGLES, -1, 3);
    glDrawElements(GL_TRIANGLES, 3, GL_FLOAT, far_index);
    print_errors("bad arrays");
    glDrawArrays(GL_TRIANGLES, 0, 3); /* no array is enabled */
    glGenBuffers(1, &buffer);
    glBindBuffer(GL_ARRAY_BUFFER, buffer);
    glBufferData(GL_ARRAY_BUFFER, 36, corners, GL_STATIC_DRAW);
    glEnableClientState(GL_VERTEX_ARRAY);
    glVertexPointer(3, GL_FLOAT, 0, NULL);
    glDrawArrays(GL_TRIANGLES, 0, 30000);
    glDrawElements(GL_TRIANGLES, 3, GL_UNSIGNED_INT, far_index);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffer);
    glDrawElements(GL_TRIANGLES, 3000, GL_UNSIGNED_INT, (const void *)1000);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, 0);
    glVertexPointer(3, GL_FLOAT, 0, (const void *)100000);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glBindBuffer(GL_ARRAY_BUFFER, 0);
    glDisableClientState(GL_VERTEX_ARRAY);
    glDeleteBuffers(1, &buffer);
    print_errors("buffers too short");
}

static void wild_matrices(void) {
    static const float nothing[16] = {0};
    static const float projective[16] = {1, 0, 0, 0.5f, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -5, 1};
    glLoadMatrixf(nothing);
    square(0, 0, 0);
    glLoadMatrixf(projective);
    square(0, 0, 0);
    glMatrixMode(GL_PROJECTION);
    glLoadMatrixf(nothing);
    square(0, 0, 0);
    glFrustum(-1, 1, -1, 1, 1, 100);
    glViewport(0, 0, 0, 0);
    square(0, 0, -5);
    glViewport(-50000, -50000, 100000, 100000);
    square(0, 0, -5);
    glViewport(0, 0, PICTURE, PICTURE);
    print_errors("matrices");
    for (int i = 0; i < 20; i++) glPushAttrib(GL_ENABLE_BIT);
    look_at_bracket();
    square(0, 0, -5);
    glXSwapBuffers(display, window);
    for (int i = 0; i < 20; i++) glPopAttrib();
    print_errors("a full attribute stack");
}

static void draw_wild(void) {
    wild_begins();
    wild_lists();
    wild_arrays();
    wild_matrices();
    glBegin(GL_TRIANGLES);
    glVertex3f(0, 0, 0);
    glXSwapBuffers(display, window);
    glEnd();
    while (glGetError() != GL_NO_ERROR) continue;
    glNewList(1, GL_COMPILE);
    glXSwapBuffers(display, window);
    glEndList();
    while (glGetError() != GL_NO_ERROR) continue;
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    look_at_bracket();
    glDisable(GL_BLEND);
    draw_begin(); /* and all is well */
}

/* ---- the program ---- */

static const struct scene {
    const char *name;
    void (*draw)(void);
} scenes[] = {
    {"begin", draw_begin},     {"strips", draw_strips},         {"list", draw_list},
    {"nested", draw_nested},   {"arrays", draw_arrays},         {"elements", draw_elements},
    {"buffers", draw_buffers}, {"inside-out", draw_inside_out}, {"contexts", draw_contexts},
    {"asking", draw_asking},   {"untouched", draw_untouched},   {"state", draw_state},
    {"wild", draw_wild},
};

static int open_window(void) {
    int wanted[] = {GLX_RGBA, GLX_DOUBLEBUFFER, GLX_RED_SIZE, 8, GLX_DEPTH_SIZE, 16, None};
    display = XOpenDisplay(NULL);
    visual = display ? glXChooseVisual(display, DefaultScreen(display), wanted) : NULL;
    if (!visual) return 0;
    XSetWindowAttributes attributes = {0};
    const Window root = RootWindow(display, visual->screen);
    attributes.colormap = XCreateColormap(display, root, visual->visual, AllocNone);
    attributes.override_redirect = True;
    window =
        XCreateWindow(display, root, 0, 0, PICTURE, PICTURE, 0, visual->depth, InputOutput,
                      visual->visual, CWColormap | CWBorderPixel | CWOverrideRedirect, &attributes);
    XMapWindow(display, window);
    XSync(display, False);
    context = glXCreateContext(display, visual, NULL, True);
    return context && glXMakeCurrent(display, window, context);
}

/* What the X server shows, so that GL is not asked. */
static int write_picture(const char *path) {
    XSync(display, False);
    XImage *const image = XGetImage(display, window, 0, 0, PICTURE, PICTURE, AllPlanes, ZPixmap);
    FILE *const file = image ? fopen(path, "wb") : NULL;
    if (!file) return 1;
    fprintf(file, "P6\n%d %d\n255\n", PICTURE, PICTURE);
    for (int y = 0; y < PICTURE; y++)
        for (int x = 0; x < PICTURE; x++) {
            const unsigned long rgb = XGetPixel(image, x, y);
            for (int shift = 16; shift >= 0; shift -= 8) fputc((int)(rgb >> shift & 255), file);
        }
    XDestroyImage(image);
    return fclose(file) != 0;
}

static void draw_frame(const struct scene *scene) {
    glClearColor(1, 1, 1, 0);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glEnable(GL_DEPTH_TEST);
    glColor3f(0.6f, 0.5f, 0.4f);
    look_at_bracket();
    scene->draw();
    glXSwapBuffers(display, window);
    glFinish();
}

int main(int argc, char **argv) {
    if (argc < 3) return 2;
    for (size_t i = 0; i < sizeof scenes / sizeof scenes[0]; i++) {
        if (strcmp(argv[1], scenes[i].name) != 0) continue;
        if (!open_window()) {
            fprintf(stderr, "scene: no window for OpenGL\n");
            return 77;
        }
        make_bracket();
        for (int frame = argc > 3 ? atoi(argv[3]) : 1; frame > 0; frame--) draw_frame(&scenes[i]);
        const int failed = write_picture(argv[2]);
        glXMakeCurrent(display, None, NULL);
        glXDestroyContext(display, context);
        XFree(visual);
        XCloseDisplay(display);
        return failed;
    }
    fprintf(stderr, "scene: no scene %s\n", argv[1]);
    return 2;
}
