/* lines.c: one pass of lines over the finished surfaces.
 *
 *     copy the window's depth buffer into a texture
 *     into a picture of our own: for each kind of line how much of each pixel it covers, by the
 *       geometry shader over all triangles; where lines overlap the most counts (GL_MAX)
 *     lay that picture over the window, once, in the kinds' inks
 *
 * The detour over a picture of coverages gives smooth rims and joints that do not show: two lines that meet
 * in a corner never add up. The depth buffer is only read.
 * The program's state is pushed as a whole; what no attribute group holds (program, framebuffers, vertex
 * arrays) is asked and put back.
 *
 * Not handled: multisampled windows whose depth cannot be copied, and attribute stacks that the program has
 * filled to the top: no lines then. */
#include "lines.h"
#include "shaders.h"

#include <math.h>
#include <pthread.h>
#include <stddef.h>

/* Meshes of display lists are shared between contexts; where they are in the buffer is written in them. */
static pthread_mutex_t upload_lock = PTHREAD_MUTEX_INITIALIZER;
static size_t last_upload;

/* ---- programs ---- */

static GLuint compile(GLenum type, const char *const *text) {
    GLsizei parts = 0;
    while (parts < SHADER_PARTS && text[parts]) parts++;
    const GLuint shader = gl.glCreateShader(type);
    gl.glShaderSource(shader, parts, text, NULL);
    gl.glCompileShader(shader);
    GLint good = 0;
    gl.glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
    if (good) return shader;
    char log[400] = "";
    gl.glGetShaderInfoLog(shader, sizeof log, NULL, log);
    say_once(SAY_COMPILE, "no lines: a shader of ours does not compile: %s", log);
    gl.glDeleteShader(shader);
    return 0;
}

/* geometry: may be NULL. 0 when it does not link. */
static GLuint link_program(const char *const *vertex, const char *const *geometry,
                           const char *const *fragment) {
    const GLuint program = gl.glCreateProgram();
    const struct {
        GLenum type;
        const char *const *text;
    } parts[] = {
        {GL_VERTEX_SHADER, vertex}, {GL_GEOMETRY_SHADER, geometry}, {GL_FRAGMENT_SHADER, fragment}};
    for (int i = 0; i < 3; i++) {
        if (!parts[i].text) continue;
        const GLuint shader = compile(parts[i].type, parts[i].text);
        if (!shader) return 0;
        gl.glAttachShader(program, shader);
        gl.glDeleteShader(shader);
    }
    gl.glBindAttribLocation(program, 0, "corner");
    gl.glLinkProgram(program);
    GLint good = 0;
    gl.glGetProgramiv(program, GL_LINK_STATUS, &good);
    if (good) return program;
    char log[400] = "";
    gl.glGetProgramInfoLog(program, sizeof log, NULL, log);
    say_once(SAY_COMPILE, "no lines: a program of ours does not link: %s", log);
    return 0;
}

void lines_set_constants(struct painter *painter) {
    if (painter->constants) return;
    painter->constants = true;
    const struct settings *const set = settings();
    const float degree = 3.14159265f / 180;
    const float theta = set->ridge_angle * degree, phi = set->valley_angle * degree;
    gl.glUseProgram(painter->paper);
    gl.glUniform4f(gl.glGetUniformLocation(painter->paper, "paper"), set->paper[0], set->paper[1],
                   set->paper[2], 1);
    gl.glUseProgram(painter->lines);
    const GLuint lines = painter->lines;
    gl.glUniform1i(gl.glGetUniformLocation(lines, "depth"), 0);
    gl.glUniform1f(gl.glGetUniformLocation(lines, "half_width"), set->width / 2);
    gl.glUniform1f(gl.glGetUniformLocation(lines, "reach"), set->width / 2 + 0.6f);
    gl.glUniform4f(gl.glGetUniformLocation(lines, "angles"), cosf(theta), sinf(theta), cosf(phi),
                   sinf(phi));
    gl.glUniform3f(gl.glGetUniformLocation(lines, "kinds"), (set->lines & LINES_SILHOUETTE) != 0,
                   (set->lines & LINES_RIDGE) != 0, (set->lines & LINES_VALLEY) != 0);
    gl.glUseProgram(painter->cover);
    gl.glUniform1i(gl.glGetUniformLocation(painter->cover, "coverage"), 0);
    gl.glUniformMatrix3fv(gl.glGetUniformLocation(painter->cover, "inks"), 1, GL_FALSE,
                          &set->ink[0][0]);
    gl.glUseProgram(0);
}

bool lines_create_programs(struct painter *painter) {
    painter->paper = link_program(shader_paper_vertex, NULL, shader_paper_fragment);
    if (painter->paper)
        painter->lines =
            link_program(shader_lines_vertex, shader_lines_geometry, shader_lines_fragment);
    if (painter->lines)
        painter->cover = link_program(shader_cover_vertex, NULL, shader_cover_fragment);
    if (!painter->cover) return false;
    painter->u_modelview = gl.glGetUniformLocation(painter->lines, "modelview");
    painter->u_projection = gl.glGetUniformLocation(painter->lines, "projection");
    painter->u_viewport = gl.glGetUniformLocation(painter->lines, "viewport");
    painter->u_range = gl.glGetUniformLocation(painter->lines, "range");
    painter->u_viewpoint = gl.glGetUniformLocation(painter->lines, "viewpoint");
    painter->u_facing = gl.glGetUniformLocation(painter->lines, "facing");
    painter->u_step = gl.glGetUniformLocation(painter->lines, "step_depth");
    return true;
}

/* ---- the program's state ---- */

struct saved {
    GLint program, draw_framebuffer, read_framebuffer, array, buffer;
};

/* False: there is no room on the attribute stack. */
static bool save_state(struct saved *saved) {
    GLint depth = 0, most = 0;
    gl.glGetIntegerv(GL_ATTRIB_STACK_DEPTH, &depth);
    gl.glGetIntegerv(GL_MAX_ATTRIB_STACK_DEPTH, &most);
    if (depth >= most) return false;
    gl.glGetIntegerv(GL_CURRENT_PROGRAM, &saved->program);
    gl.glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &saved->draw_framebuffer);
    gl.glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &saved->read_framebuffer);
    gl.glGetIntegerv(GL_VERTEX_ARRAY_BINDING, &saved->array);
    gl.glGetIntegerv(GL_ARRAY_BUFFER_BINDING, &saved->buffer);
    gl.glPushAttrib(GL_ALL_ATTRIB_BITS);
    return true;
}

static void restore_state(const struct saved *saved) {
    gl.glBindFramebuffer(GL_DRAW_FRAMEBUFFER, (GLuint)saved->draw_framebuffer);
    gl.glBindFramebuffer(GL_READ_FRAMEBUFFER, (GLuint)saved->read_framebuffer);
    gl.glBindVertexArray((GLuint)saved->array);
    gl.glBindBuffer(GL_ARRAY_BUFFER, (GLuint)saved->buffer);
    gl.glUseProgram((GLuint)saved->program);
    gl.glPopAttrib();
}

/* Nothing may come between our triangles and the pixels. */
static void set_plain_state(void) {
    static const GLenum off[] = {
        GL_DEPTH_TEST,
        GL_STENCIL_TEST,
        GL_ALPHA_TEST,
        GL_CULL_FACE,
        GL_DITHER,
        GL_SCISSOR_TEST,
        GL_COLOR_LOGIC_OP,
        GL_POLYGON_STIPPLE,
        GL_CLIP_PLANE0,
        GL_CLIP_PLANE1,
        GL_CLIP_PLANE2,
        GL_CLIP_PLANE3,
        GL_CLIP_PLANE4,
        GL_CLIP_PLANE5,
        GL_POLYGON_SMOOTH,
        GL_POLYGON_OFFSET_FILL,
        GL_DEPTH_CLAMP,
        GL_RASTERIZER_DISCARD,
        GL_SAMPLE_ALPHA_TO_COVERAGE,
    };
    for (size_t i = 0; i < sizeof off / sizeof off[0]; i++) gl.glDisable(off[i]);
    gl.glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    gl.glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl.glPixelTransferf(GL_DEPTH_SCALE, 1);
    gl.glPixelTransferf(GL_DEPTH_BIAS, 0);
    gl.glEnable(GL_BLEND);
    gl.glActiveTexture(GL_TEXTURE0);
}

/* ---- pictures ---- */

static void create_objects(struct painter *painter) {
    GLuint textures[2];
    gl.glGenVertexArrays(1, &painter->array);
    gl.glGenBuffers(1, &painter->buffer);
    gl.glGenFramebuffers(1, &painter->target);
    gl.glGenTextures(2, textures);
    painter->depth = textures[0];
    painter->coverage = textures[1];
    gl.glBindVertexArray(painter->array);
    gl.glBindBuffer(GL_ARRAY_BUFFER, painter->buffer);
    gl.glEnableVertexAttribArray(0);
    gl.glVertexAttribPointer(0, 4, GL_FLOAT, GL_FALSE, sizeof(struct corner), NULL);
}

static void size_texture(GLuint texture, GLint inner, GLenum format, GLenum type, int width,
                         int height) {
    gl.glBindTexture(GL_TEXTURE_2D, texture);
    gl.glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl.glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl.glTexImage2D(GL_TEXTURE_2D, 0, inner, width, height, 0, format, type, NULL);
}

/* Without bound pixel buffer: a null pointer would mean its first byte. */
static void size_textures(struct painter *painter, int width, int height, int depth_bits) {
    GLint unpack = 0;
    gl.glGetIntegerv(GL_PIXEL_UNPACK_BUFFER_BINDING, &unpack);
    gl.glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    const GLint inner = depth_bits <= 16   ? GL_DEPTH_COMPONENT16
                        : depth_bits <= 24 ? GL_DEPTH_COMPONENT24
                                           : GL_DEPTH_COMPONENT32;
    size_texture(painter->depth, inner, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, width, height);
    size_texture(painter->coverage, GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, width, height);
    gl.glBindBuffer(GL_PIXEL_UNPACK_BUFFER, (GLuint)unpack);
    painter->width = width;
    painter->height = height;
}

/* The window's lower left part that all viewports of the frame lie in. */
static void frame_extent(const struct frame *frame, int *width, int *height) {
    int most[2] = {1, 1};
    for (size_t i = 0; i < frame->count; i++)
        for (int k = 0; k < 2; k++) {
            const long end =
                (long)frame->draws[i].state.viewport[k] + frame->draws[i].state.viewport[k + 2];
            if (end > most[k]) most[k] = end < 16384 ? (int)end : 16384;
        }
    *width = most[0];
    *height = most[1];
}

/* z1 of the whole window, and an empty picture of coverages, bound. */
static bool prepare_pictures(struct painter *painter, int width, int height) {
    GLint bits = 0;
    gl.glBindFramebuffer(GL_FRAMEBUFFER, 0);
    gl.glGetIntegerv(GL_DEPTH_BITS, &bits);
    if (!bits) return false;
    if (width > painter->width || height > painter->height)
        size_textures(painter, width > painter->width ? width : painter->width,
                      height > painter->height ? height : painter->height, bits);
    gl.glBindTexture(GL_TEXTURE_2D, painter->depth);
    gl.glCopyTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 0, 0, width, height);
    gl.glBindFramebuffer(GL_FRAMEBUFFER, painter->target);
    gl.glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D,
                              painter->coverage, 0);
    if (gl.glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) return false;
    gl.glClearColor(0, 0, 0, 0);
    gl.glClear(GL_COLOR_BUFFER_BIT);
    gl.glUseProgram(painter->lines);
    gl.glUniform1f(painter->u_step, ldexpf(1, -(bits < 24 ? bits : 24)));
    return gl.glGetError() == GL_NO_ERROR;
}

/* ---- triangles ---- */

static struct mesh *mesh_of(const struct frame *frame, const struct draw *draw) {
    return draw->mesh ? draw->mesh : frame->own;
}

/* Gives each mesh its place in the buffer, once however often it is drawn; returns the bytes needed. */
static size_t place_meshes(const struct frame *frame, size_t upload) {
    size_t corners = 0;
    for (size_t i = 0; i < frame->count; i++) {
        struct mesh *const mesh = mesh_of(frame, &frame->draws[i]);
        if (mesh->upload == upload) continue;
        mesh->upload = upload;
        mesh->place = corners;
        corners += mesh->count;
    }
    return corners * sizeof(struct corner);
}

static void upload_meshes(struct painter *painter, const struct frame *frame) {
    const size_t upload = ++last_upload;
    const size_t bytes = place_meshes(frame, upload);
    gl.glBindBuffer(GL_ARRAY_BUFFER, painter->buffer);
    if (bytes > painter->buffer_room) painter->buffer_room = bytes + bytes / 2;
    gl.glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)painter->buffer_room, NULL, GL_STREAM_DRAW);
    size_t end = 0; /* all before it is there */
    for (size_t i = 0; i < frame->count; i++) {
        const struct mesh *const mesh = mesh_of(frame, &frame->draws[i]);
        if (mesh->place < end || !mesh->count) continue;
        gl.glBufferSubData(GL_ARRAY_BUFFER, (GLintptr)(mesh->place * sizeof(struct corner)),
                           (GLsizeiptr)(mesh->count * sizeof(struct corner)), mesh->corners);
        end = mesh->place + mesh->count;
    }
}

static void draw_lines_of(const struct painter *painter, const struct frame *frame,
                          const struct draw *draw) {
    const struct draw_state *const s = &draw->state;
    gl.glViewport(s->viewport[0], s->viewport[1], s->viewport[2], s->viewport[3]);
    gl.glScissor(s->scissor[0], s->scissor[1], s->scissor[2], s->scissor[3]);
    gl.glUniformMatrix4fv(painter->u_modelview, 1, GL_FALSE, s->modelview);
    gl.glUniformMatrix4fv(painter->u_projection, 1, GL_FALSE, s->projection);
    gl.glUniform4f(painter->u_viewport, (float)s->viewport[0], (float)s->viewport[1],
                   (float)s->viewport[2], (float)s->viewport[3]);
    gl.glUniform4fv(painter->u_viewpoint, 1, s->viewpoint);
    gl.glUniform2f(painter->u_range, s->range[0], s->range[1]);
    gl.glUniform2f(painter->u_facing, (float)s->culled, (float)s->fronts);
    gl.glDrawArrays(GL_TRIANGLES, (GLint)(mesh_of(frame, draw)->place + draw->first),
                    (GLsizei)draw->count);
}

static void draw_coverage(struct painter *painter, const struct frame *frame) {
    gl.glBlendEquation(GL_MAX);
    gl.glEnable(GL_SCISSOR_TEST);
    for (size_t i = 0; i < frame->count; i++) draw_lines_of(painter, frame, &frame->draws[i]);
    gl.glDisable(GL_SCISSOR_TEST);
}

static void cover_window(struct painter *painter, int width, int height) {
    gl.glBindFramebuffer(GL_FRAMEBUFFER, 0);
    gl.glUseProgram(painter->cover);
    gl.glBindTexture(GL_TEXTURE_2D, painter->coverage);
    gl.glBlendEquation(GL_FUNC_ADD);
    gl.glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
    gl.glViewport(0, 0, width, height);
    gl.glDrawArrays(GL_TRIANGLES, 0, 3);
}

static bool draw_all(struct painter *painter, const struct frame *frame) {
    int width, height;
    lines_set_constants(painter);
    set_plain_state();
    if (!painter->array) create_objects(painter);
    frame_extent(frame, &width, &height);
    if (!prepare_pictures(painter, width, height)) return false;
    gl.glBindVertexArray(painter->array);
    pthread_mutex_lock(&upload_lock);
    upload_meshes(painter, frame);
    draw_coverage(painter, frame);
    pthread_mutex_unlock(&upload_lock);
    cover_window(painter, width, height);
    return true;
}

void lines_draw(struct context *context) {
    struct saved saved;
    if (!context->frame.count) return;
    context_errors_begin(context);
    if (save_state(&saved)) {
        const bool good = draw_all(&context->painter, &context->frame);
        restore_state(&saved);
        if (!good) {
            say_once(SAY_DEPTH, "no lines: the window's depth buffer cannot be read");
            context->ability = NOT_CAPABLE;
        }
    }
    context_errors_end();
}
