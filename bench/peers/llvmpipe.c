/* llvmpipe MODEL [options]: the same model drawn by OpenGL on the CPU, to measure against.
 *
 * Mesa's llvmpipe draws a mesh in buffer objects into an offscreen framebuffer, without samples or
 * with 4 per pixel: flat white with a depth test, or, with --lines, by a geometry shader after
 * Raskar 2001, sections 2.1 and 2.2: back faces enlarged and black, a black quad at the angle theta
 * on every edge of every front face. Valleys and intersections need a second depth buffer, which
 * OpenGL has not.
 *
 * A frame is: clear, one draw call, the resolve of samples to pixels where there are any, glFinish.
 * Reading the picture back is not counted, nor are the first frames, in which Mesa compiles.
 *
 * --frames N prints JSON with the keys of `drypoint bench`. --serve draws a frame for every line
 * "WIDTH HEIGHT SAMPLES LINES" on standard input and answers with its milliseconds, by the clock
 * and of processor time, so that whoever measures can alternate with other programs. Exit code 3:
 * there is no Mesa here. */
#include "../mesh.h"
#include "gl.h"

#include <drypoint/camera.h>
#include <drypoint/io.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { EXIT_NO_MESA = 3, WARM_UP = 2, FRAMES_MAX = 10000 };

typedef struct settings {
    const char *model, *output;
    unsigned width, height, samples, frames;
    bool lines, serve;
    double line_width; /* px */
    double theta;      /* degrees */
} settings;

typedef struct surface {
    unsigned width, height, samples; /* what is there; width 0: nothing */
    GLuint framebuffer, color, depth;
} surface;

typedef struct peer {
    gl_functions gl;
    float min[3], max[3];
    GLsizei corners;
    GLuint flat, lines; /* programs */
    surface plain;      /* where samples are resolved to, or what is drawn to without them */
    surface sampled;
} peer;

static const char vertex_shader[] = "#version 450 core\n"
                                    "layout(location = 0) in vec3 position;\n"
                                    "uniform mat4 view, projection;\n"
                                    "flat out vec3 color;\n"
                                    "void main() {\n"
                                    "    color = vec3(1);\n"
                                    "    gl_Position = projection * (view * vec4(position, 1));\n"
                                    "}\n";

/* Camera space, for the geometry shader. */
static const char vertex_shader_of_lines[] =
    "#version 450 core\n"
    "layout(location = 0) in vec3 position;\n"
    "uniform mat4 view;\n"
    "out vec3 p;\n"
    "void main() { p = (view * vec4(position, 1)).xyz; }\n";

/* The eye is the origin and looks along -z, so V . C = z / |P|. widths: world units per unit of
 * depth that a pixel covers, times the visible width; half of it for ridges, which get a quad from
 * both sides. The one thing not as printed: 1 / (V . N) is kept below LIMIT, else outlines grow
 * hairs. */
static const char geometry_shader[] =
    "#version 450 core\n"
    "layout(triangles) in;\n"
    "layout(triangle_strip, max_vertices = 15) out;\n"
    "in vec3 p[];\n"
    "uniform mat4 projection;\n"
    "uniform vec2 widths;\n" /* silhouette, ridge */
    "uniform vec2 theta;\n"  /* cos, sin */
    "flat out vec3 color;\n"
    "const float LIMIT = 16;\n"
    "void emit(vec3 q, vec3 c) {\n"
    "    color = c;\n"
    "    gl_Position = projection * vec4(q, 1);\n"
    "    EmitVertex();\n"
    "}\n"
    "float enlargement(vec3 q, vec3 edge, vec3 normal) {\n"
    "    vec3 v = normalize(q);\n"
    "    float along = dot(v, edge);\n"
    "    float facing = max(abs(dot(v, normal)), 1 / LIMIT);\n"
    "    return -q.z * sqrt(max(1 - along * along, 0)) * -v.z / facing;\n"
    "}\n"
    "void silhouette(vec3 n) {\n"
    "    vec3 a[3], b[3];\n"
    "    for (int i = 0; i < 3; i++) {\n"
    "        vec3 e = normalize(p[(i + 1) % 3] - p[i]);\n"
    "        vec3 away = cross(e, n) * widths.x;\n"
    "        a[i] = p[i] + away * enlargement(p[i], e, n);\n"
    "        b[i] = p[(i + 1) % 3] + away * enlargement(p[(i + 1) % 3], e, n);\n"
    "    }\n"
    "    emit(a[0], vec3(0));\n" /* a strip over the hexagon a0 b0 a1 b1 a2 b2 */
    "    emit(b[0], vec3(0));\n"
    "    emit(b[2], vec3(0));\n"
    "    emit(a[1], vec3(0));\n"
    "    emit(a[2], vec3(0));\n"
    "    emit(b[1], vec3(0));\n"
    "    EndPrimitive();\n"
    "}\n"
    "void ridges(vec3 n) {\n"
    "    for (int i = 0; i < 3; i++) {\n"
    "        vec3 p1 = p[(i + 1) % 3], e = normalize(p1 - p[i]), m = cross(e, n);\n"
    "        vec3 r = -n * theta.x + m * theta.y;\n"
    "        vec3 q = (-n * theta.y - m * theta.x) * widths.y;\n"
    "        emit(p[i], vec3(0));\n"
    "        emit(p1, vec3(0));\n"
    "        emit(p[i] + q * enlargement(p[i], e, r), vec3(0));\n"
    "        emit(p1 + q * enlargement(p1, e, r), vec3(0));\n"
    "        EndPrimitive();\n"
    "    }\n"
    "}\n"
    "void main() {\n"
    "    vec3 n = cross(p[1] - p[0], p[2] - p[0]);\n"
    "    if (dot(n, n) == 0) return;\n"
    "    n = normalize(n);\n"
    "    if (dot(p[0], n) >= 0) {\n"
    "        silhouette(n);\n"
    "    } else {\n"
    "        for (int i = 0; i < 3; i++) emit(p[i], vec3(1));\n"
    "        EndPrimitive();\n"
    "        ridges(n);\n"
    "    }\n"
    "}\n";

static const char fragment_shader[] = "#version 450 core\n"
                                      "flat in vec3 color;\n"
                                      "out vec4 pixel;\n"
                                      "void main() { pixel = vec4(color, 1); }\n";

static bool attach(const gl_functions *gl, GLuint program, GLenum kind, const char *text) {
    if (!text) return true;
    const GLuint shader = gl->CreateShader(kind);
    GLint compiled = 0;
    gl->ShaderSource(shader, 1, &text, NULL);
    gl->CompileShader(shader);
    gl->GetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    gl->AttachShader(program, shader);
    if (compiled) return true;
    char log[2000] = "";
    gl->GetShaderInfoLog(shader, sizeof log, NULL, log);
    fprintf(stderr, "llvmpipe: %s\n", log);
    return false;
}

/* 0: said why. geometry may be NULL. */
static GLuint make_program(const gl_functions *gl, const char *vertex, const char *geometry) {
    const GLuint program = gl->CreateProgram();
    if (!attach(gl, program, GL_VERTEX_SHADER, vertex) ||
        !attach(gl, program, GL_GEOMETRY_SHADER, geometry) ||
        !attach(gl, program, GL_FRAGMENT_SHADER, fragment_shader))
        return 0;
    GLint linked = 0;
    gl->LinkProgram(program);
    gl->GetProgramiv(program, GL_LINK_STATUS, &linked);
    if (!linked) fprintf(stderr, "llvmpipe: a program does not link\n");
    return linked ? program : 0;
}

static void measure_box(peer *p, const mesh *m) {
    for (int k = 0; k < 3; k++) p->min[k] = INFINITY, p->max[k] = -INFINITY;
    for (size_t c = 0; c < 3 * m->triangle_count; c++) {
        const float *const v = m->positions + 3 * (size_t)m->indices[c];
        for (int k = 0; k < 3; k++) {
            p->min[k] = fminf(p->min[k], v[k]);
            p->max[k] = fmaxf(p->max[k], v[k]);
        }
    }
}

static void upload(peer *p, const mesh *m) {
    const gl_functions *const gl = &p->gl;
    GLuint array, buffers[2];
    gl->GenVertexArrays(1, &array);
    gl->BindVertexArray(array);
    gl->GenBuffers(2, buffers);
    gl->BindBuffer(GL_ARRAY_BUFFER, buffers[0]);
    gl->BufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(m->vertex_count * sizeof(float[3])), m->positions,
                   GL_STATIC_DRAW);
    gl->BindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers[1]);
    gl->BufferData(GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)(m->triangle_count * sizeof(uint32_t[3])),
                   m->indices, GL_STATIC_DRAW);
    gl->VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, NULL);
    gl->EnableVertexAttribArray(0);
    p->corners = (GLsizei)(3 * m->triangle_count);
}

static bool make_surface(const gl_functions *gl, surface *s, unsigned width, unsigned height,
                         unsigned samples) {
    if (s->width == width && s->height == height && s->samples == samples) return true;
    gl->DeleteFramebuffers(1, &s->framebuffer); /* name 0 is passed over */
    gl->DeleteRenderbuffers(1, &s->color);
    gl->DeleteRenderbuffers(1, &s->depth);
    gl->GenFramebuffers(1, &s->framebuffer);
    gl->GenRenderbuffers(1, &s->color);
    gl->GenRenderbuffers(1, &s->depth);
    gl->BindFramebuffer(GL_FRAMEBUFFER, s->framebuffer);
    gl->BindRenderbuffer(GL_RENDERBUFFER, s->color);
    gl->RenderbufferStorageMultisample(GL_RENDERBUFFER, (GLsizei)samples, GL_RGBA8, (GLsizei)width,
                                       (GLsizei)height);
    gl->FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, s->color);
    gl->BindRenderbuffer(GL_RENDERBUFFER, s->depth);
    gl->RenderbufferStorageMultisample(GL_RENDERBUFFER, (GLsizei)samples, GL_DEPTH_COMPONENT24,
                                       (GLsizei)width, (GLsizei)height);
    gl->FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, s->depth);
    if (gl->CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        fprintf(stderr, "llvmpipe: no framebuffer of %u x %u with %u samples\n", width, height,
                samples);
        return false;
    }
    s->width = width;
    s->height = height;
    s->samples = samples;
    return true;
}

static void set_matrix(const gl_functions *gl, GLuint program, const char *name,
                       const double m[16]) {
    float single[16];
    for (int k = 0; k < 16; k++) single[k] = (float)m[k];
    gl->UniformMatrix4fv(gl->GetUniformLocation(program, name), 1, GL_FALSE, single);
}

/* The camera that the program fits to the box; the same for every size of the same aspect. */
static void set_uniforms(const peer *p, const settings *s, GLuint program) {
    const gl_functions *const gl = &p->gl;
    dp_camera camera;
    dp_fit fit = {.aspect = (double)s->width / s->height};
    memcpy(fit.min, p->min, sizeof fit.min);
    memcpy(fit.max, p->max, sizeof fit.max);
    dp_camera_fit(&camera, &fit);
    gl->UseProgram(program);
    set_matrix(gl, program, "view", camera.view);
    set_matrix(gl, program, "projection", camera.projection);
    const double pixel = 2 / camera.projection[5] / s->height; /* per unit of depth */
    const double angle = s->theta * acos(-1) / 180;
    gl->Uniform2f(gl->GetUniformLocation(program, "widths"), (float)(s->line_width * pixel),
                  (float)(s->line_width * pixel / 2));
    gl->Uniform2f(gl->GetUniformLocation(program, "theta"), (float)cos(angle), (float)sin(angle));
}

static double now_ms(clockid_t clock) {
    struct timespec t;
    clock_gettime(clock, &t);
    return 1e3 * (double)t.tv_sec + 1e-6 * (double)t.tv_nsec;
}

static void draw(const peer *p, const settings *s) {
    const gl_functions *const gl = &p->gl;
    const GLsizei w = (GLsizei)s->width, h = (GLsizei)s->height;
    gl->BindFramebuffer(GL_FRAMEBUFFER, s->samples ? p->sampled.framebuffer : p->plain.framebuffer);
    gl->Viewport(0, 0, w, h);
    gl->Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    gl->DrawElements(GL_TRIANGLES, p->corners, GL_UNSIGNED_INT, NULL);
    if (s->samples) {
        gl->BindFramebuffer(GL_READ_FRAMEBUFFER, p->sampled.framebuffer);
        gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, p->plain.framebuffer);
        gl->BlitFramebuffer(0, 0, w, h, 0, 0, w, h, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    }
    gl->Finish();
}

/* Milliseconds of one frame, or -1; cpu_ms may be NULL. What a new size or program needs is
 * prepared before the clock starts. */
static double time_frame(peer *p, const settings *s, double *cpu_ms) {
    if (!make_surface(&p->gl, &p->plain, s->width, s->height, 0)) return -1;
    if (s->samples && !make_surface(&p->gl, &p->sampled, s->width, s->height, s->samples))
        return -1;
    set_uniforms(p, s, s->lines ? p->lines : p->flat);
    const double start = now_ms(CLOCK_MONOTONIC), cpu_start = now_ms(CLOCK_PROCESS_CPUTIME_ID);
    draw(p, s);
    const double time = now_ms(CLOCK_MONOTONIC) - start;
    if (cpu_ms) *cpu_ms = now_ms(CLOCK_PROCESS_CPUTIME_ID) - cpu_start;
    return p->gl.GetError() ? -1 : time;
}

static int by_value(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static int bench(peer *p, const settings *s) {
    static double times[FRAMES_MAX];
    for (unsigned k = 0; k < WARM_UP; k++)
        if (time_frame(p, s, NULL) < 0) return EXIT_FAILURE;
    for (unsigned k = 0; k < s->frames; k++) times[k] = time_frame(p, s, NULL);
    qsort(times, s->frames, sizeof *times, by_value);
    printf("{\"frames\": %u, \"frame_ms\": %.3f, \"frame_ms_min\": %.3f, \"frame_ms_max\": %.3f, "
           "\"triangles\": %d, \"width\": %u, \"height\": %u, \"samples\": %u, \"lines\": %s, "
           "\"renderer\": \"%s\", \"version\": \"%s\"}\n",
           s->frames, 0.5 * (times[(s->frames - 1) / 2] + times[s->frames / 2]), times[0],
           times[s->frames - 1], p->corners / 3, s->width, s->height, s->samples,
           s->lines ? "true" : "false", (const char *)p->gl.GetString(GL_RENDERER),
           (const char *)p->gl.GetString(GL_VERSION));
    return EXIT_SUCCESS;
}

static int serve(peer *p, settings s) {
    char line[100];
    while (fgets(line, sizeof line, stdin)) {
        int lines = 0;
        if (sscanf(line, "%u %u %u %d", &s.width, &s.height, &s.samples, &lines) != 4) return 2;
        s.lines = lines != 0;
        double cpu_ms = -1;
        const double ms = time_frame(p, &s, &cpu_ms);
        printf("%.4f %.4f\n", ms, cpu_ms);
        fflush(stdout);
    }
    return EXIT_SUCCESS;
}

/* Of the last frame; OpenGL's rows run from bottom to top. */
static int write_picture(const peer *p, const settings *s) {
    const size_t row = (size_t)4 * s->width;
    uint8_t *const rgba = malloc(2 * row * s->height);
    if (!rgba) return EXIT_FAILURE;
    uint8_t *const turned = rgba + row * s->height;
    dp_diag diag = {0};
    p->gl.BindFramebuffer(GL_FRAMEBUFFER, p->plain.framebuffer);
    p->gl.ReadPixels(0, 0, (GLsizei)s->width, (GLsizei)s->height, GL_RGBA, GL_UNSIGNED_BYTE, rgba);
    for (size_t y = 0; y < s->height; y++)
        memcpy(turned + y * row, rgba + (s->height - 1 - y) * row, row);
    const dp_result result = dp_io_write_png(s->output, turned, s->width, s->height, row, &diag);
    if (result) fprintf(stderr, "llvmpipe: %s\n", diag.message);
    free(rgba);
    return result ? EXIT_FAILURE : EXIT_SUCCESS;
}

static bool prepare(peer *p, const settings *s) {
    mesh m;
    if (!mesh_read(s->model, &m)) return false;
    measure_box(p, &m);
    upload(p, &m);
    mesh_free(&m);
    p->flat = make_program(&p->gl, vertex_shader, NULL);
    p->lines = make_program(&p->gl, vertex_shader_of_lines, geometry_shader);
    p->gl.Enable(GL_DEPTH_TEST);
    p->gl.DepthFunc(GL_LEQUAL);
    p->gl.ClearColor(1, 1, 1, 1);
    return p->flat && p->lines && !p->gl.GetError();
}

static bool parse(settings *s, int argc, char **argv) {
    for (int k = 1; k < argc; k++) {
        const char *const name = argv[k], *const value = k + 1 < argc ? argv[k + 1] : "";
        bool takes_value = true, good = true;
        if (!strcmp(name, "--size"))
            good = sscanf(value, "%ux%u", &s->width, &s->height) == 2;
        else if (!strcmp(name, "--samples"))
            good = sscanf(value, "%u", &s->samples) == 1;
        else if (!strcmp(name, "--frames"))
            good = sscanf(value, "%u", &s->frames) == 1;
        else if (!strcmp(name, "--width"))
            good = sscanf(value, "%lf", &s->line_width) == 1;
        else if (!strcmp(name, "--ridge-angle"))
            good = sscanf(value, "%lf", &s->theta) == 1;
        else if (!strcmp(name, "--output"))
            s->output = value;
        else
            takes_value = false;
        if (!takes_value && !strcmp(name, "--lines"))
            s->lines = true;
        else if (!takes_value && !strcmp(name, "--serve"))
            s->serve = true;
        else if (!takes_value && name[0] != '-')
            s->model = name;
        else if (!takes_value)
            good = false;
        if (!good) return false;
        k += takes_value;
    }
    return s->model && s->width && s->height && s->frames && s->frames <= FRAMES_MAX;
}

int main(int argc, char **argv) {
    settings s = {.width = 1680, .height = 1050, .frames = 10, .line_width = 2, .theta = 150};
    static peer p;
    if (!parse(&s, argc, argv))
        return fprintf(stderr, "usage: llvmpipe MODEL [--size WxH] [--samples 0|4] [--lines] "
                               "[--width PX] [--ridge-angle DEG] [--frames N | --serve] "
                               "[--output FILE.png]\n"),
               2;
    if (!gl_open(&p.gl)) return EXIT_NO_MESA;
    int code = prepare(&p, &s) ? EXIT_SUCCESS : EXIT_FAILURE;
    if (!code) code = s.serve ? serve(&p, s) : bench(&p, &s);
    if (!code && s.output) code = write_picture(&p, &s);
    gl_close();
    return code;
}
