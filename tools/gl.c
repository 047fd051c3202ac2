/* Drawing by OpenGL: the mesh of one source, and a framebuffer that is as large as the picture.
 *
 * Invariant: mesh is that of the source last taken, or NULL; texture and framebuffer are of width x height, or 0.
 *
 * Without the component drypoint_gl (DRYPOINT_GL off, or no OpenGL header where it was built) all of this fails and says
 * so. */
#include "gl.h"
#include "options.h"
#include "report.h"

#ifdef DRYPOINT_HAS_GL

#include "egl.h"

#include <GL/glcorearb.h>

#include <drypoint/gl.h>

#include <stdlib.h>
#include <string.h>

/* X(name, type of the pointer): what is called of OpenGL itself. */
#define FUNCTIONS(X)                                                                               \
    X(GenTextures, PFNGLGENTEXTURESPROC)                                                           \
    X(BindTexture, PFNGLBINDTEXTUREPROC)                                                           \
    X(TexStorage2D, PFNGLTEXSTORAGE2DPROC)                                                         \
    X(DeleteTextures, PFNGLDELETETEXTURESPROC)                                                     \
    X(GenFramebuffers, PFNGLGENFRAMEBUFFERSPROC)                                                   \
    X(BindFramebuffer, PFNGLBINDFRAMEBUFFERPROC)                                                   \
    X(FramebufferTexture, PFNGLFRAMEBUFFERTEXTUREPROC)                                             \
    X(CheckFramebufferStatus, PFNGLCHECKFRAMEBUFFERSTATUSPROC)                                     \
    X(DeleteFramebuffers, PFNGLDELETEFRAMEBUFFERSPROC)

struct tool_gl {
    egl_context *egl; /* NULL: the context is another's */
    dp_gl *gl;
    dp_gl_mesh *mesh;
    GLuint texture, framebuffer;
    uint32_t width, height;
#define MEMBER(name, type) type name;
    FUNCTIONS(MEMBER)
#undef MEMBER
};

static bool load(tool_gl *g, void *(*function)(void *user, const char *name), void *user) {
    bool all = true;
    void *address;
#define LOAD(name, type)                                                                           \
    address = function(user, "gl" #name);                                                          \
    all &= address != NULL;                                                                        \
    memcpy(&g->name, &address, sizeof address);
    FUNCTIONS(LOAD)
#undef LOAD
    return all;
}

static dp_result fail(dp_diag *diag, dp_result result, const char *text) {
    *diag = (dp_diag){.result = result};
    snprintf(diag->message, sizeof diag->message, "%s", text);
    return result;
}

dp_result gl_adopt(void *(*function)(void *user, const char *name), void *user, tool_gl **out,
                   dp_diag *diag) {
    const dp_gl_desc desc = {.get_proc_address = function, .user = user};
    tool_gl *const g = *out = calloc(1, sizeof *g);
    if (!g) return fail(diag, DP_ERR_MEMORY, "out of memory");
    dp_result result = dp_gl_create(&desc, &g->gl, diag);
    if (!result && !load(g, function, user))
        result = fail(diag, DP_ERR_UNSUPPORTED, "OpenGL lacks framebuffers");
    if (!result) return DP_OK;
    gl_close(g);
    *out = NULL;
    return result;
}

int gl_open(tool_gl **out) {
    dp_diag diag = {0};
    egl_context *const egl = egl_open(4, 3);
    *out = NULL;
    if (!egl) return EXIT_FAILED;
    if (gl_adopt(egl_function, egl, out, &diag)) {
        egl_close(egl);
        report_failure("--gl", &diag);
        return EXIT_FAILED;
    }
    (*out)->egl = egl;
    return 0;
}

static void drop_framebuffer(tool_gl *g) {
    if (g->framebuffer) g->DeleteFramebuffers(1, &g->framebuffer);
    if (g->texture) g->DeleteTextures(1, &g->texture);
    g->framebuffer = g->texture = 0;
    g->width = g->height = 0;
}

void gl_close(tool_gl *g) {
    if (!g) return;
    if (g->DeleteFramebuffers && g->DeleteTextures) drop_framebuffer(g);
    dp_gl_mesh_destroy(g->mesh);
    dp_gl_destroy(g->gl);
    egl_close(g->egl);
    free(g);
}

const char *gl_device(const tool_gl *g) { return dp_gl_device(g->gl); }
uint32_t gl_framebuffer(const tool_gl *g) { return g->framebuffer; }

/* The library refers to its own function; who reads this has a program. */
static dp_result without_functions(dp_diag *diag) {
    char *const advice = strstr(diag->message, "; dp_draw does");
    if (advice) *advice = 0;
    return diag->result;
}

dp_result gl_take(tool_gl *g, dp_source *source, bool moved, dp_diag *diag) {
    if (moved && g->mesh) return dp_gl_mesh_update(g->mesh, source, diag);
    dp_gl_mesh_destroy(g->mesh);
    g->mesh = NULL;
    const dp_result result = dp_gl_mesh_from_source(g->gl, source, &g->mesh, diag);
    return result ? without_functions(diag) : DP_OK;
}

static dp_result make_framebuffer(tool_gl *g, uint32_t width, uint32_t height, dp_diag *diag) {
    if (g->framebuffer && g->width == width && g->height == height) return DP_OK;
    drop_framebuffer(g);
    g->GenTextures(1, &g->texture);
    g->BindTexture(GL_TEXTURE_2D, g->texture);
    g->TexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA8, (GLsizei)width, (GLsizei)height);
    g->BindTexture(GL_TEXTURE_2D, 0);
    g->GenFramebuffers(1, &g->framebuffer);
    g->BindFramebuffer(GL_FRAMEBUFFER, g->framebuffer);
    g->FramebufferTexture(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, g->texture, 0);
    const GLenum status = g->CheckFramebufferStatus(GL_FRAMEBUFFER);
    g->BindFramebuffer(GL_FRAMEBUFFER, 0);
    g->width = width, g->height = height;
    if (status == GL_FRAMEBUFFER_COMPLETE) return DP_OK;
    drop_framebuffer(g);
    return fail(diag, DP_ERR_MEMORY,
                "OpenGL has no framebuffer of that size; give a smaller --size");
}

dp_result gl_draw(tool_gl *g, const dp_camera *camera, const dp_style *style,
                  const dp_target *target, dp_diag *diag) {
    if (target->depth || target->line_class || target->normal || target->eye_normal ||
        target->distance || target->id || target->edge_map)
        return fail(diag, DP_ERR_UNSUPPORTED,
                    "OpenGL gives pixels and lines, no planes of the G-buffer");
    dp_result result = make_framebuffer(g, target->width, target->height, diag);
    if (result) return result;
    const dp_gl_target to = {.framebuffer = g->framebuffer,
                             .width = target->width,
                             .height = target->height,
                             .samples = target->samples};
    result = dp_gl_draw(g->gl, &g->mesh, 1, camera, style, &to, diag);
    if (!result && target->rgba)
        result = dp_gl_read(g->gl, &to, target->rgba, target->rgba_stride, diag);
    return result ? without_functions(diag) : DP_OK;
}

dp_result gl_hand_over(tool_gl *g, dp_context *context, dp_diag *diag) {
    return dp_gl_hand_over(g->gl, context, diag);
}

/* ------- what is told ------- */

void gl_time(tool_gl *g) { dp_gl_time_stages(g->gl, true); }

dp_result gl_stats(tool_gl *g, dp_stats *stats, dp_diag *diag) {
    dp_gl_stats s;
    const dp_result result = dp_gl_stats_of(g->gl, &s, diag);
    if (result) return result;
    *stats = (dp_stats){.polygons = s.triangles,
                        .triangles = s.triangles,
                        .segments = s.segments,
                        .bytes = s.bytes};
    for (int k = 0; k < DP_GL_STAGE_COUNT; k++) stats->frame_ms += s.stage_ms[k];
    return DP_OK;
}

static dp_gl_stats stats_now(tool_gl *g) {
    dp_gl_stats s = {0};
    dp_diag diag;
    if (dp_gl_stats_of(g->gl, &s, &diag)) s = (dp_gl_stats){0};
    return s;
}

uint32_t gl_samples(tool_gl *g) { return stats_now(g).samples; }

void gl_print_table(FILE *out, tool_gl *g) {
    const dp_gl_stats s = stats_now(g);
    double sum = 0;
    fprintf(out, "%-24s %s\n", "device", gl_device(g));
    fprintf(out, "%-24s %llu\n", "triangles", (unsigned long long)s.triangles);
    fprintf(out, "%-24s %llu\n", "vertices", (unsigned long long)s.vertices);
    fprintf(out, "%-24s %u\n", "samples of a pixel", s.samples);
    fprintf(out, "%-24s %llu\n", "edges that may be lines", (unsigned long long)s.candidates);
    fprintf(out, "%-24s %llu\n", "segments", (unsigned long long)s.segments);
    fprintf(out, "%-24s %.1f MB\n", "memory of the device", (double)s.bytes * 1e-6);
    for (int k = 0; k < DP_GL_STAGE_COUNT; k++) {
        fprintf(out, "%-24s %.2f ms\n", dp_gl_stage_name((dp_gl_stage)k), s.stage_ms[k]);
        sum += s.stage_ms[k];
    }
    fprintf(out, "%-24s %.2f ms\n", "frame, by the device", sum);
}

void gl_print_json(FILE *out, tool_gl *g) {
    const dp_gl_stats s = stats_now(g);
    double sum = 0;
    fputs(", \"device\": ", out);
    print_json_string(out, gl_device(g));
    fprintf(out,
            ", \"vertices\": %llu, \"candidates\": %llu, \"device_bytes\": %llu, \"stages\": {",
            (unsigned long long)s.vertices, (unsigned long long)s.candidates,
            (unsigned long long)s.bytes);
    for (int k = 0; k < DP_GL_STAGE_COUNT; k++) {
        fprintf(out, "%s\"%s\": %.3f", k ? ", " : "", dp_gl_stage_name((dp_gl_stage)k),
                s.stage_ms[k]);
        sum += s.stage_ms[k];
    }
    fprintf(out, "}, \"frame_ms\": %.3f", sum);
}

#else

static const char missing[] = "this drypoint was built without OpenGL (DRYPOINT_GL off, or no "
                              "libgl-dev)";

static dp_result refuse(dp_diag *diag) {
    *diag = (dp_diag){.result = DP_ERR_UNSUPPORTED};
    snprintf(diag->message, sizeof diag->message, "%s", missing);
    return DP_ERR_UNSUPPORTED;
}

int gl_open(tool_gl **out) {
    *out = NULL;
    wrong_usage("--gl: %s; leave it out", missing);
    return EXIT_FAILED;
}
dp_result gl_adopt(void *(*function)(void *user, const char *name), void *user, tool_gl **out,
                   dp_diag *diag) {
    (void)function, (void)user;
    *out = NULL;
    return refuse(diag);
}
void gl_close(tool_gl *gl) { (void)gl; }
const char *gl_device(const tool_gl *gl) { return (void)gl, "none"; }
dp_result gl_take(tool_gl *gl, dp_source *source, bool moved, dp_diag *diag) {
    (void)gl, (void)source, (void)moved;
    return refuse(diag);
}
dp_result gl_draw(tool_gl *gl, const dp_camera *camera, const dp_style *style,
                  const dp_target *target, dp_diag *diag) {
    (void)gl, (void)camera, (void)style, (void)target;
    return refuse(diag);
}
dp_result gl_hand_over(tool_gl *gl, dp_context *context, dp_diag *diag) {
    (void)gl, (void)context;
    return refuse(diag);
}
uint32_t gl_framebuffer(const tool_gl *gl) { return (void)gl, 0; }
dp_result gl_stats(tool_gl *gl, dp_stats *stats, dp_diag *diag) {
    (void)gl, (void)stats;
    return refuse(diag);
}
void gl_time(tool_gl *gl) { (void)gl; }
uint32_t gl_samples(tool_gl *gl) { return (void)gl, 0; }
void gl_print_table(FILE *out, tool_gl *gl) { (void)out, (void)gl; }
void gl_print_json(FILE *out, tool_gl *gl) { (void)out, (void)gl; }

#endif
