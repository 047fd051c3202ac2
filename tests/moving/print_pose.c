/* print_pose MODEL CLIP TIME...: the polygons of a scene at these times, for gltf.py. For each
 * time: the number of corners, as uint64, then of each corner, in the polygons' order, x, y, z
 * and the normal (0 where there is none), as doubles. CLIP 0: at rest. */
#include <drypoint/drypoint.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void put_corner(const dp_batch *b, size_t corner) {
    const uint32_t v = b->indices ? b->indices[corner] : (uint32_t)corner;
    const uint32_t n = b->normals.indices ? b->normals.indices[corner] : v;
    double row[6] = {0};
    if (v < b->vertex_count) {
        const float *const p =
            (const float *)(const void *)((const char *)b->positions + v * b->position_stride);
        for (int k = 0; k < 3; k++) row[k] = b->origin[k] + (double)p[k];
    }
    if (b->normals.values && n < b->normals.count) {
        const float *const p =
            (const float *)(const void *)((const char *)b->normals.values + n * b->normals.stride);
        for (int k = 0; k < 3; k++) row[3 + k] = p[k];
    }
    fwrite(row, sizeof row, 1, stdout);
}

static dp_result print_at(dp_source *source, double time, dp_diag *diag) {
    dp_batch b;
    dp_result result = dp_source_set_time(source, time, diag);
    if (!result) result = dp_source_next(source, &b, diag);
    if (result) return result;
    const uint64_t corners = b.firsts ? b.firsts[b.polygon_count] : 3 * (uint64_t)b.polygon_count;
    fwrite(&corners, sizeof corners, 1, stdout);
    for (size_t c = 0; c < corners; c++) put_corner(&b, c);
    return DP_OK;
}

int main(int count, char **words) {
    dp_source *source = NULL;
    dp_diag diag = {0};
    if (count < 4) return 2;
    dp_result result = dp_source_open(words[1], NULL, &source, &diag);
    if (!result) result = dp_scene_play(source, (uint32_t)atoi(words[2]), &diag);
    for (int k = 3; !result && k < count; k++) result = print_at(source, atof(words[k]), &diag);
    dp_source_destroy(source);
    if (result) fprintf(stderr, "%s: %s\n", words[1], diag.message);
    return result ? 1 : 0;
}
