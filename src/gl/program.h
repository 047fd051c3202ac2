/* Programs of the device, made of the shaders in src/gl/shaders/. */
#ifndef DP_GL_PROGRAM_H
#define DP_GL_PROGRAM_H

#include "gl/buffer.h"

/* Names of files in src/gl/shaders/; NULL: no such stage. In these files `#include "other.glsl"` takes
 * another one in, once. */
typedef struct dp_gl_program_desc {
    const char *compute, *vertex, *geometry, *fragment;
    const char *defines; /* lines such as "#define SAMPLES 4\n"; NULL: none */
    bool any_samples;    /* its shaders do not use SAMPLES, and one program serves all */
} dp_gl_program_desc;

typedef struct dp_gl_program_entry {
    uint64_t key;
    uint32_t name;
} dp_gl_program_entry;

typedef struct dp_gl_programs {
    dp_gl_program_entry *entries;
    size_t count, entries_cap;
} dp_gl_programs;

/* The program, made when it is first asked for and kept. `SAMPLES` is defined as the picture's number
 * of samples. DP_ERR_UNSUPPORTED: a compiler refused it; the message begins with the file and what the
 * compiler said, all of which goes to dp_gl_desc.message. */
dp_result dp_gl_program(dp_gl *gl, const dp_gl_program_desc *desc, uint32_t *program,
                        dp_diag *diag);
/* Would this compute program have no groups to run, by the arguments of an indirect dispatch in a buffer, and is it not made
 * yet? Then it need not be: compilers take seconds for what only some models need. The device is waited for until the
 * program is made, and never after that. */
bool dp_gl_program_is_spared(dp_gl *gl, const dp_gl_program_desc *desc,
                             const dp_gl_buffer *arguments, size_t offset);
void dp_gl_programs_free(dp_gl *gl);

/* Sets a uniform of the bound program by name; nothing if it has none such. For what is not in the picture's
 * block. */
void dp_gl_uniform_u(dp_gl *gl, uint32_t program, const char *name, uint32_t value);
void dp_gl_uniform_i(dp_gl *gl, uint32_t program, const char *name, int32_t value);
void dp_gl_uniform_f(dp_gl *gl, uint32_t program, const char *name, float value);
void dp_gl_uniform_4f(dp_gl *gl, uint32_t program, const char *name, const float value[4]);

/* One file of src/gl/shaders/. The list is made when the library is built (cmake/EmbedShaders.cmake); it ends
 * with a NULL name. */
typedef struct dp_gl_shader_file {
    const char *name, *text;
} dp_gl_shader_file;
extern const dp_gl_shader_file dp_gl_shader_files[];

#endif
