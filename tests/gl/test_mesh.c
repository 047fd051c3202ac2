/* Where polygons come from: buffers that an application's shaders write, sources that change, several meshes in a
 * picture, each in its place; and where lines go: the application's own shaders. */
#include "gl/figure.h"
#include "gl/gl.h"
#include "gl/strokes.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 160, HEIGHT = 120, BYTES = 4 * WIDTH * HEIGHT };

static const dp_style look = {.surface = DP_RGB(200, 40, 40), .paper = DP_RGB(255, 255, 255)},
                      flat = {.lines = DP_NO_LINES,
                              .surface = DP_RGB(200, 40, 40),
                              .paper = DP_RGB(255, 255, 255)};

static void draw(gl_test *t, dp_gl_mesh *const *meshes, size_t count, const dp_style *style,
                 uint32_t samples, uint8_t *rgba) {
    const dp_gl_target target = gl_test_target(t, WIDTH, HEIGHT, samples);
    const dp_camera camera = figure_camera(false, 20);
    dp_diag diag = {0};
    dp_result result = dp_gl_draw(t->gl, meshes, count, &camera, style, &target, &diag);
    if (!result) result = dp_gl_read(t->gl, &target, rgba, 0, &diag);
    if (result) fail_msg("%s", diag.message);
}

static dp_gl_mesh *mesh_of(gl_test *t, dp_source *source) {
    dp_gl_mesh *mesh = NULL;
    dp_diag diag;
    if (dp_gl_mesh_from_source(t->gl, source, &mesh, &diag)) fail_msg("%s", diag.message);
    return mesh;
}

static void draw_figure(gl_test *t, const figure *f, const dp_style *style, uint8_t *rgba) {
    dp_source *const source = figure_source(f);
    dp_gl_mesh *const mesh = mesh_of(t, source);
    draw(t, &mesh, 1, style, 1, rgba);
    dp_gl_mesh_destroy(mesh);
    dp_source_destroy(source);
}

/* ------- buffers of the application's ------- */

enum { STRIDE = 20, OFFSET = 8, INDEX_OFFSET = 16 };

/* Bends the figure as a vertex shader would. */
static const char bending[] =
    "#version 430 core\n"
    "layout(local_size_x = 32) in;\n"
    "layout(std430, binding = 5) readonly buffer From { float from[]; };\n"
    "layout(std430, binding = 6) writeonly buffer To { float to[]; };\n"
    "uniform float lift;\n"
    "void main() {\n"
    "    uint i = gl_GlobalInvocationID.x;\n"
    "    if (i >= uint(from.length()) / 3u) return;\n"
    "    to[2u + 5u * i] = from[3u * i];\n"
    "    to[3u + 5u * i] = from[3u * i + 1u] + lift * from[3u * i];\n"
    "    to[4u + 5u * i] = from[3u * i + 2u];\n"
    "}\n";

static GLuint program_of(const dp_gl_api *a, int count, const GLenum *stages,
                         const char *const *texts) {
    const GLuint program = a->CreateProgram();
    GLint good = 0;
    for (int i = 0; i < count; i++) {
        const GLuint shader = a->CreateShader(stages[i]);
        a->ShaderSource(shader, 1, &texts[i], NULL);
        a->CompileShader(shader);
        a->AttachShader(program, shader);
        a->DeleteShader(shader);
    }
    a->LinkProgram(program);
    a->GetProgramiv(program, GL_LINK_STATUS, &good);
    assert_true(good);
    return program;
}

static GLuint buffer_of(const dp_gl_api *a, const void *data, size_t size) {
    GLuint name;
    a->GenBuffers(1, &name);
    a->BindBuffer(GL_ARRAY_BUFFER, name);
    a->BufferData(GL_ARRAY_BUFFER, (GLsizeiptr)size, data, GL_DYNAMIC_DRAW);
    a->BindBuffer(GL_ARRAY_BUFFER, 0);
    return name;
}

static void bend(const dp_gl_api *a, GLuint program, GLuint from, GLuint to, float lift) {
    a->UseProgram(program);
    a->Uniform1f(a->GetUniformLocation(program, "lift"), lift);
    a->BindBufferBase(GL_SHADER_STORAGE_BUFFER, 5, from);
    a->BindBufferBase(GL_SHADER_STORAGE_BUFFER, 6, to);
    a->DispatchCompute((FIGURE_VERTICES + 31) / 32, 1, 1);
    a->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

/* Indices behind 16 bytes of something else. */
static GLuint index_buffer(const dp_gl_api *a, const figure *f) {
    uint8_t bytes[INDEX_OFFSET + sizeof f->indices];
    memset(bytes, 0xee, INDEX_OFFSET);
    memcpy(bytes + INDEX_OFFSET, f->indices, sizeof f->indices);
    return buffer_of(a, bytes, sizeof bytes);
}

static void draws_what_shaders_write(void **state) {
    static uint8_t own[BYTES], read[BYTES];
    gl_test *const t = *state;
    dp_gl_mesh *mesh;
    dp_diag diag;
    figure f;
    if (!t->gl) skip();
    const dp_gl_api *const a = &t->gl->api;
    figure_make(&f, 0);
    const GLuint program =
        program_of(a, 1, (GLenum[]){GL_COMPUTE_SHADER}, (const char *[]){bending});
    GLuint from = buffer_of(a, f.positions, sizeof f.positions),
           to = buffer_of(a, NULL, OFFSET + STRIDE * FIGURE_VERTICES),
           indices = index_buffer(a, &f);
    const dp_gl_buffers buffers = {.positions = to,
                                   .positions_offset = OFFSET,
                                   .positions_stride = STRIDE,
                                   .vertex_count = FIGURE_VERTICES,
                                   .indices = indices,
                                   .indices_offset = INDEX_OFFSET,
                                   .triangle_count = FIGURE_TRIANGLES};
    if (dp_gl_mesh_from_buffers(t->gl, &buffers, &mesh, &diag)) fail_msg("%s", diag.message);
    for (int frame = 0; frame < 3; frame++) {
        const float lift = 0.25f * (float)frame;
        figure bent = f;
        bend(a, program, from, to, lift);
        draw(t, &mesh, 1, &look, 1, own);
        for (int i = 0; i < FIGURE_VERTICES; i++)
            bent.positions[i][1] += lift * bent.positions[i][0];
        draw_figure(t, &bent, &look, read);
        assert_true(gl_test_alike(own, read, WIDTH, HEIGHT, 0) > 0.999);
    }
    dp_gl_mesh_destroy(mesh);
    a->UseProgram(0);
    a->DeleteProgram(program);
    a->DeleteBuffers(1, &from), a->DeleteBuffers(1, &to), a->DeleteBuffers(1, &indices);
}

/* Without indices; and indices that change, or lie beyond the vertices. */
static void follows_indices(void **state) {
    static uint8_t whole[BYTES], loose[BYTES], part[BYTES];
    static float corners[FIGURE_TRIANGLES][3][3];
    gl_test *const t = *state;
    dp_gl_mesh *mesh;
    figure f;
    if (!t->gl) skip();
    const dp_gl_api *const a = &t->gl->api;
    figure_make(&f, 0);
    draw_figure(t, &f, &flat, whole);
    for (int i = 0; i < FIGURE_TRIANGLES; i++)
        for (int k = 0; k < 3; k++)
            memcpy(corners[i][k], f.positions[f.indices[i][k]], sizeof corners[i][k]);
    GLuint positions = buffer_of(a, corners, sizeof corners), indices;
    dp_gl_buffers buffers = {.positions = positions,
                             .vertex_count = 3 * FIGURE_TRIANGLES,
                             .triangle_count = FIGURE_TRIANGLES};
    assert_int_equal(dp_gl_mesh_from_buffers(t->gl, &buffers, &mesh, NULL), DP_OK);
    draw(t, &mesh, 1, &flat, 1, loose);
    assert_memory_equal(loose, whole, BYTES);
    dp_gl_mesh_destroy(mesh);
    a->DeleteBuffers(1, &positions);

    positions = buffer_of(a, f.positions, sizeof f.positions);
    for (int i = 0; i < FIGURE_TRIANGLES / 2; i++)
        f.indices[i][i % 3] = i % 2 ? UINT32_MAX : FIGURE_VERTICES;
    indices = buffer_of(a, f.indices, sizeof f.indices);
    buffers = (dp_gl_buffers){.positions = positions,
                              .vertex_count = FIGURE_VERTICES,
                              .indices = indices,
                              .triangle_count = FIGURE_TRIANGLES};
    assert_int_equal(dp_gl_mesh_from_buffers(t->gl, &buffers, &mesh, NULL), DP_OK);
    draw(t, &mesh, 1, &look, 1, part);
    const double left = gl_test_alike(part, whole, WIDTH, HEIGHT, 0);
    assert_true(left > 0.6 && left < 0.95);
    figure_make(&f, 0);
    a->BindBuffer(GL_ARRAY_BUFFER, indices);
    a->BufferSubData(GL_ARRAY_BUFFER, 0, sizeof f.indices, f.indices);
    dp_gl_mesh_topology_changed(mesh);
    draw(t, &mesh, 1, &flat, 1, part);
    assert_memory_equal(part, whole, BYTES);
    dp_gl_mesh_destroy(mesh);
    a->DeleteBuffers(1, &positions), a->DeleteBuffers(1, &indices);
}

/* ------- several meshes ------- */

/* Two figures that cross, one of them in a place of its own: as the CPU draws them from one source. */
static void draws_several(void **state) {
    static uint8_t gpu[BYTES], alone[BYTES];
    static const char *const names[2] = {"a", "b"};
    gl_test *const t = *state;
    figure f[2], second;
    dp_source *sources[2], *joined, *unplaced;
    dp_gl_mesh *meshes[2];
    double matrix[16];
    if (!t->gl) skip();
    figure_make(&f[0], -0.4f), figure_make(&f[1], 0.1f);
    second = f[1];
    unplaced = figure_source(&second);
    figure_turn_matrix(matrix, 75, 0.3);
    figure_place(&f[1], matrix);
    for (int i = 0; i < 2; i++) sources[i] = figure_source(&f[i]);
    meshes[0] = mesh_of(t, sources[0]), meshes[1] = mesh_of(t, unplaced);
    assert_int_equal(dp_gl_mesh_place(meshes[1], matrix, NULL), DP_OK);
    assert_int_equal(dp_source_join(sources, names, 2, NULL, &joined, NULL), DP_OK);
    const dp_camera camera = figure_camera(false, 20);
    for (uint32_t samples = 1; samples <= 4; samples += 3) {
        draw(t, meshes, 2, &flat, samples, gpu);
        gl_test_keep("mesh-several", gpu, WIDTH, HEIGHT);
        uint8_t *const cpu = gl_test_draw_cpu(joined, &camera, &flat, WIDTH, HEIGHT, samples);
        assert_true(gl_test_alike(gpu, cpu, WIDTH, HEIGHT, 2) > 0.995);
        free(cpu);
    }
    /* and as the device draws one mesh of both; one mesh twice is no more than once */
    dp_gl_mesh *const one = mesh_of(t, joined);
    draw(t, meshes, 2, &look, 1, gpu);
    draw(t, &one, 1, &look, 1, alone);
    assert_true(gl_test_alike(gpu, alone, WIDTH, HEIGHT, 2) > 0.995);
    dp_gl_mesh *const twice[2] = {meshes[0], meshes[0]};
    draw(t, twice, 2, &flat, 1, gpu);
    draw(t, twice, 1, &flat, 1, alone);
    assert_memory_equal(gpu, alone, BYTES);
    /* back where it was */
    assert_int_equal(dp_gl_mesh_place(meshes[1], NULL, NULL), DP_OK);
    draw(t, meshes + 1, 1, &look, 1, gpu);
    draw_figure(t, &second, &look, alone);
    assert_memory_equal(gpu, alone, BYTES);
    for (int i = 0; i < 2; i++) dp_gl_mesh_destroy(meshes[i]);
    dp_gl_mesh_destroy(one);
    dp_source_destroy(joined), dp_source_destroy(unplaced);
}

/* A source whose positions, or topology, have changed. */
static void updates(void **state) {
    static uint8_t updated[BYTES], anew[BYTES];
    gl_test *const t = *state;
    figure f;
    double matrix[16];
    if (!t->gl) skip();
    figure_make(&f, 0);
    dp_source *const source = figure_source(&f);
    dp_gl_mesh *const mesh = mesh_of(t, source);
    draw(t, &mesh, 1, &look, 1, updated);
    const uint64_t topology = mesh->topology;
    figure_turn_matrix(matrix, 30, 0.1);
    figure_place(&f, matrix);
    assert_int_equal(dp_gl_mesh_update(mesh, source, NULL), DP_OK);
    assert_int_equal(mesh->topology, topology);
    draw(t, &mesh, 1, &look, 1, updated);
    draw_figure(t, &f, &look, anew);
    assert_memory_equal(updated, anew, BYTES);
    for (int i = 0; i < 40; i++) memset(f.indices[3 * i], 0, sizeof f.indices[0]);
    assert_int_equal(dp_gl_mesh_update(mesh, source, NULL), DP_OK);
    assert_int_not_equal(mesh->topology, topology);
    draw(t, &mesh, 1, &flat, 1, updated);
    draw_figure(t, &f, &flat, anew);
    assert_memory_equal(updated, anew, BYTES);
    dp_gl_mesh_destroy(mesh);
    dp_source_destroy(source);
}

/* ------- the application draws the lines ------- */

static const char line_vertex[] =
    "#version 430 core\n"
    "struct Segment { vec3 a; uint line; vec3 b; uint more[9]; };\n"
    "layout(std430, binding = 0) readonly buffer Segments { Segment segments[]; };\n"
    "uniform vec2 size;\n"
    "void main() {\n"
    "    Segment s = segments[gl_InstanceID];\n"
    "    vec2 p = (gl_VertexID & 1) == 0 ? s.a.xy : s.b.xy;\n"
    "    gl_Position = vec4(p.x / size.x * 2.0 - 1.0, 1.0 - p.y / size.y * 2.0, 0.0, 1.0);\n"
    "}\n";
static const char line_fragment[] = "#version 430 core\n"
                                    "layout(location = 0) out vec4 color;\n"
                                    "void main() { color = vec4(0.0, 0.0, 0.0, 1.0); }\n";

/* As GL_LINES, from the buffer that they lie in: their number never comes to the host. */
static void draw_lines(gl_test *t, const dp_gl_target *target) {
    static const GLfloat white[4] = {1, 1, 1, 1};
    const dp_gl_api *const a = &t->gl->api;
    dp_gl_lines lines;
    GLuint vertices;
    assert_int_equal(dp_gl_lines_of(t->gl, &lines, NULL), DP_OK);
    assert_true(lines.count_offset >= 4);
    const GLuint program = program_of(a, 2, (GLenum[]){GL_VERTEX_SHADER, GL_FRAGMENT_SHADER},
                                      (const char *[]){line_vertex, line_fragment});
    a->GenVertexArrays(1, &vertices);
    a->BindVertexArray(vertices);
    a->BindFramebuffer(GL_FRAMEBUFFER, target->framebuffer);
    a->Viewport(0, 0, (GLsizei)target->width, (GLsizei)target->height);
    a->ClearBufferfv(GL_COLOR, 0, white);
    a->UseProgram(program);
    a->Uniform2f(a->GetUniformLocation(program, "size"), (float)target->width,
                 (float)target->height);
    a->BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, lines.buffer);
    a->BindBuffer(GL_DRAW_INDIRECT_BUFFER, lines.count_buffer);
    a->MemoryBarrier(GL_COMMAND_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
    a->DrawArraysIndirect(GL_LINES, (const void *)(lines.count_offset - 4));
    a->BindFramebuffer(GL_FRAMEBUFFER, 0);
    a->BindBuffer(GL_DRAW_INDIRECT_BUFFER, 0);
    a->BindVertexArray(0);
    a->UseProgram(0);
    a->DeleteVertexArrays(1, &vertices);
    a->DeleteProgram(program);
    assert_int_equal(a->GetError(), GL_NO_ERROR);
}

/* Thin lines of the application's lie along our ink. */
static void gives_lines(void **state) {
    static uint8_t thin[BYTES];
    gl_test *const t = *state;
    uint8_t *cpu, *ink;
    dp_gl_mesh *mesh;
    figure f;
    if (!t->gl) skip();
    figure_make(&f, 0);
    dp_source *const source = figure_source(&f);
    const dp_gl_target target = gl_test_target(t, WIDTH, HEIGHT, 1);
    const dp_camera camera = figure_camera(false, 20);
    dp_style style = {.lines = DP_SILHOUETTE | DP_RIDGE, .ridge_angle = 165};
    for (int i = 0; i < 2; i++) style.line[i] = (dp_line_style){4, DP_RGB(0, 0, 0)};
    strokes_draw_both(t, source, &camera, &style, &target, &cpu, &ink, &mesh);
    draw_lines(t, &target);
    assert_int_equal(dp_gl_read(t->gl, &target, thin, 0, NULL), DP_OK);
    gl_test_keep("mesh-lines", thin, WIDTH, HEIGHT);
    int drawn = 0, beside = 0;
    for (int i = 0; i < BYTES; i += 4) {
        drawn += thin[i] == 0;
        beside += thin[i] == 0 && ink[i] > 60;
    }
    assert_true(drawn > 300);
    assert_int_equal(beside, 0);
    free(cpu), free(ink);
    dp_gl_mesh_destroy(mesh);
    dp_source_destroy(source);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(draws_what_shaders_write), cmocka_unit_test(follows_indices),
        cmocka_unit_test(draws_several), cmocka_unit_test(updates), cmocka_unit_test(gives_lines)};
    return cmocka_run_group_tests(tests, gl_test_setup, gl_test_teardown);
}
