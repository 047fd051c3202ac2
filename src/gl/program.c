/* Programs: shaders are put together from files, compiled and kept.
 *
 * A file's `#include "other.glsl"` lines are replaced by that file, the first time that it is named; `#line N F`
 * tells the compiler where a line came from, F being the file's number in the list, so that its messages can
 * be told by name. Data structure: a list of (hash of files and defines, program), looked through one by one:
 * there are a few dozen. Invariant: a program in the list has been linked. */
#include "gl/gl.h"

#include <stdio.h>
#include <string.h>

/* A text that grows. */
typedef struct text {
    const dp_allocator *memory;
    char *at;
    size_t length, cap;
    bool failed;
} text;

static void put_bytes(text *t, const char *from, size_t n) {
    if (t->failed || !dp_reserve(t->memory, &t->at, &t->cap, t->length + n + 1, 1)) {
        t->failed = true;
        return;
    }
    memcpy(t->at + t->length, from, n);
    t->at[t->length += n] = 0;
}
static void put(text *t, const char *from) { put_bytes(t, from, strlen(from)); }

static int file_number(const char *name, size_t length) {
    for (int i = 0; dp_gl_shader_files[i].name; i++)
        if (strlen(dp_gl_shader_files[i].name) == length &&
            !memcmp(dp_gl_shader_files[i].name, name, length))
            return i;
    return -1;
}

enum { FILES_MOST = 128 };

/* Appends a file and what it includes. */
static void put_file(text *t, int number, bool taken[FILES_MOST]) {
    static const char include[] = "#include \"";
    char mark[48];
    if (number < 0 || number >= FILES_MOST) {
        t->failed = true;
        return;
    }
    taken[number] = true;
    snprintf(mark, sizeof mark, "#line 1 %d\n", number);
    put(t, mark);
    int line = 1;
    for (const char *at = dp_gl_shader_files[number].text; *at; line++) {
        const char *const end = strchr(at, '\n');
        const size_t length = end ? (size_t)(end - at) + 1 : strlen(at);
        if (!strncmp(at, include, sizeof include - 1)) {
            const char *const name = at + sizeof include - 1, *const close = strchr(name, '"');
            const int other = close ? file_number(name, (size_t)(close - name)) : -1;
            if (other < 0 || !taken[other]) put_file(t, other, taken);
            snprintf(mark, sizeof mark, "#line %d %d\n", line + 1, number);
            put(t, mark);
        } else {
            put_bytes(t, at, length);
        }
        at += length;
    }
}

static dp_result source_of(dp_gl *gl, const char *file, const dp_gl_program_desc *desc, text *t,
                           dp_diag *diag) {
    bool taken[FILES_MOST] = {false};
    char head[160];
    const int number = file_number(file, strlen(file));
    snprintf(head, sizeof head, "#version %s core\n#define SAMPLES %u\n%s",
             gl->version >= 450 ? "450" : "430", gl->samples ? gl->samples : 1,
             gl->has_clip_control ? "#define ZERO_TO_ONE\n" : "");
    put(t, head);
    if (desc->defines) put(t, desc->defines);
    if (number < 0)
        return dp_fail(diag, DP_ERR_ARGUMENT, "there is no shader file %s in the library", file);
    put_file(t, number, taken);
    return t->failed ? dp_fail(diag, DP_ERR_MEMORY, "out of memory for shader %s", file) : DP_OK;
}

/* If a line of a compiler's begins with a file's number, as in "3:12(8): error: …" (Mesa), "3(12) : error …" (NVIDIA) or
 * "ERROR: 3:12: …" (others), that number's place, and how long it is; else NULL. */
static const char *file_in_line(const char *line, int *number, size_t *length) {
    static const char *const before[] = {"ERROR: ", "WARNING: "};
    for (size_t i = 0; i < sizeof before / sizeof *before; i++)
        if (!strncmp(line, before[i], strlen(before[i]))) line += strlen(before[i]);
    *length = strspn(line, "0123456789");
    const char *const rest = line + *length;
    if (!*length || *length > 3 || !(*rest == ':' || *rest == '(')) return NULL;
    if (rest[1] < '0' || rest[1] > '9') return NULL;
    *number = 0;
    for (size_t i = 0; i < *length; i++) *number = 10 * *number + (line[i] - '0');
    return line;
}

static int file_count(void) {
    int count = 0;
    while (dp_gl_shader_files[count].name) count++;
    return count;
}

/* A compiler's words, with files' names in place of their numbers. */
static void put_named(text *t, const char *log) {
    while (*log) {
        const char *const end = strchr(log, '\n');
        const size_t size = end ? (size_t)(end - log) + 1 : strlen(log);
        size_t length;
        int number;
        const char *const at = file_in_line(log, &number, &length);
        if (at && number < file_count()) {
            put_bytes(t, log, (size_t)(at - log));
            put(t, dp_gl_shader_files[number].name);
            put_bytes(t, at + length, size - (size_t)(at - log) - length);
        } else {
            put_bytes(t, log, size);
        }
        log += size;
    }
}

/* What a compiler or linker said: to the application whole, and its beginning as an error. */
static dp_result refused(dp_gl *gl, const char *file, const char *log, dp_diag *diag) {
    text t = {.memory = &gl->memory};
    put_named(&t, log[0] ? log : "its compiler says nothing");
    const char *const said = t.failed ? log : t.at;
    if (gl->desc.message) gl->desc.message(gl->desc.user, said);
    dp_fail(diag, DP_ERR_UNSUPPORTED, "%s does not compile on this device (%s): %.120s", file,
            gl->device, said);
    dp_free(&gl->memory, t.at);
    return DP_ERR_UNSUPPORTED;
}

static dp_result compile(dp_gl *gl, GLenum stage, const char *file, const dp_gl_program_desc *desc,
                         GLuint program, dp_diag *diag) {
    const dp_gl_api *const a = &gl->api;
    text t = {.memory = &gl->memory};
    char log[2048] = "";
    GLint good = 0;
    dp_result result = source_of(gl, file, desc, &t, diag);
    if (!result) {
        const GLuint shader = a->CreateShader(stage);
        const GLchar *const source = t.at;
        a->ShaderSource(shader, 1, &source, NULL);
        a->CompileShader(shader);
        a->GetShaderiv(shader, GL_COMPILE_STATUS, &good);
        if (!good) {
            a->GetShaderInfoLog(shader, sizeof log, NULL, log);
            result = refused(gl, file, log, diag);
        }
        a->AttachShader(program, shader);
        a->DeleteShader(shader); /* when the program is */
    }
    dp_free(&gl->memory, t.at);
    return result;
}

static dp_result link_program(dp_gl *gl, GLuint program, const char *file, dp_diag *diag) {
    char log[2048] = "";
    GLint good = 0;
    gl->api.LinkProgram(program);
    gl->api.GetProgramiv(program, GL_LINK_STATUS, &good);
    if (good) return DP_OK;
    gl->api.GetProgramInfoLog(program, sizeof log, NULL, log);
    return refused(gl, file, log, diag);
}

static dp_result build(dp_gl *gl, const dp_gl_program_desc *d, GLuint *program, dp_diag *diag) {
    const GLenum stages[4] = {GL_COMPUTE_SHADER, GL_VERTEX_SHADER, GL_GEOMETRY_SHADER,
                              GL_FRAGMENT_SHADER};
    const char *const files[4] = {d->compute, d->vertex, d->geometry, d->fragment};
    const char *last = NULL;
    dp_result result = DP_OK;
    *program = gl->api.CreateProgram();
    for (int i = 0; i < 4 && !result; i++) {
        if (!files[i]) continue;
        last = files[i];
        result = compile(gl, stages[i], files[i], d, *program, diag);
    }
    if (!result) result = link_program(gl, *program, last, diag);
    if (result) gl->api.DeleteProgram(*program);
    return result;
}

static uint64_t hash_text(uint64_t hash, const char *s) {
    for (; s && *s; s++) hash = (hash ^ (unsigned char)*s) * 0x100000001b3u; /* FNV-1a */
    return (hash ^ 0xff) * 0x100000001b3u;
}

static uint64_t key_of(const dp_gl *gl, const dp_gl_program_desc *d) {
    uint64_t hash = 0xcbf29ce484222325u ^ (d->any_samples ? 0 : gl->samples);
    const char *const parts[5] = {d->compute, d->vertex, d->geometry, d->fragment, d->defines};
    for (int i = 0; i < 5; i++) hash = hash_text(hash, parts[i]);
    return hash;
}

/* The program in the list, 0: it is not made yet. */
static uint32_t find(const dp_gl *gl, uint64_t key) {
    const dp_gl_programs *const p = &gl->programs;
    for (size_t i = 0; i < p->count; i++)
        if (p->entries[i].key == key) return p->entries[i].name;
    return 0;
}

bool dp_gl_program_is_spared(dp_gl *gl, const dp_gl_program_desc *desc,
                             const dp_gl_buffer *arguments, size_t offset) {
    uint32_t groups = 0;
    if (find(gl, key_of(gl, desc))) return false;
    dp_gl_buffer_read(gl, arguments, offset, sizeof groups, &groups);
    return groups == 0;
}

dp_result dp_gl_program(dp_gl *gl, const dp_gl_program_desc *desc, uint32_t *program,
                        dp_diag *diag) {
    dp_gl_programs *const p = &gl->programs;
    const uint64_t key = key_of(gl, desc);
    if ((*program = find(gl, key))) return DP_OK;
    if (!dp_reserve(&gl->memory, &p->entries, &p->entries_cap, p->count + 1, sizeof *p->entries))
        return dp_fail(diag, DP_ERR_MEMORY, "out of memory for a shader program");
    const dp_result result = build(gl, desc, program, diag);
    if (!result) p->entries[p->count++] = (dp_gl_program_entry){key, *program};
    return result;
}

void dp_gl_programs_free(dp_gl *gl) {
    dp_gl_programs *const p = &gl->programs;
    for (size_t i = 0; i < p->count && !gl->is_lost; i++) gl->api.DeleteProgram(p->entries[i].name);
    dp_free(&gl->memory, p->entries);
    *p = (dp_gl_programs){0};
}

void dp_gl_uniform_u(dp_gl *gl, uint32_t program, const char *name, uint32_t value) {
    gl->api.Uniform1ui(gl->api.GetUniformLocation(program, name), value);
}
void dp_gl_uniform_i(dp_gl *gl, uint32_t program, const char *name, int32_t value) {
    gl->api.Uniform1i(gl->api.GetUniformLocation(program, name), value);
}
void dp_gl_uniform_f(dp_gl *gl, uint32_t program, const char *name, float value) {
    gl->api.Uniform1f(gl->api.GetUniformLocation(program, name), value);
}
void dp_gl_uniform_4f(dp_gl *gl, uint32_t program, const char *name, const float value[4]) {
    gl->api.Uniform4fv(gl->api.GetUniformLocation(program, name), 1, value);
}
