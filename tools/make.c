/* drypoint make SHAPE -o FILE: writes a generated model to a file, batch by batch. */
#include "commands.h"
#include "files.h"
#include "output.h"
#include "progress.h"
#include "report.h"

#include <drypoint/io.h>

/* The format by the ending; PLY for standard output, devices and pipes. */
static bool file_kind(const char *path, dp_mesh_file *kind) {
    static const struct {
        const char *ending;
        dp_mesh_file kind;
    } endings[] = {
        {".ply", DP_MESH_FILE_PLY}, {".stl", DP_MESH_FILE_STL}, {".obj", DP_MESH_FILE_OBJ}};
    for (size_t k = 0; k < sizeof endings / sizeof *endings; k++) {
        *kind = endings[k].kind;
        if (output_has_ending(path, endings[k].ending)) return true;
    }
    *kind = DP_MESH_FILE_PLY;
    if (output_in_place(path)) return true;
    const int stem = output_stem(path);
    return wrong_usage(
        "-o %s: models are written as PLY, STL or OBJ; name it %.*s.ply, %.*s.stl or "
        "%.*s.obj",
        path, stem, path, stem, path, stem, path);
}

static int write_model(const tool_settings *s, dp_mesh_file kind, dp_source *source) {
    dp_diag diag = {0};
    progress_begin("writing", s->quiet);
    interrupt_hold();
    const dp_result result =
        dp_io_write_mesh(s->output, kind, source, progress_report, NULL, &diag);
    interrupt_release();
    progress_end();
    return result ? report_failure(NULL, &diag) : 0;
}

int command_make(const tool_settings *s) {
    dp_mesh_file kind;
    if (!files_no_folder(s, s->output, "ply") || !file_kind(s->output, &kind)) return EXIT_USAGE;
    if (!output_possible(s->output)) return EXIT_FAILED;
    const dp_shape shape = {
        .name = s->model, .triangles = s->triangles, .size = s->shape_size, .seed = s->seed};
    dp_source *source = NULL;
    dp_diag diag = {0};
    if (dp_source_from_shape(&shape, &source, &diag)) return report_failure(NULL, &diag);
    const int code = write_model(s, kind, source);
    dp_source_destroy(source);
    return code;
}
