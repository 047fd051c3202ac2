/* camera MODEL [ASPECT]: the options with which the program sees other models as it sees this one by default.
 *
 * Models that are compared, one with noise and one without, say, have boxes that differ a little,
 * and so would the views that are fitted to them. ASPECT is the picture's width / height (4/3). */
#include <drypoint/camera.h>
#include <drypoint/io.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Of the view's matrix, whose upper left is a rotation and whose last column is -(rotation of the
 * eye). */
static void print_options(const double view[16]) {
    double eye[3] = {0}, target[3];
    for (int k = 0; k < 3; k++)
        for (int row = 0; row < 3; row++) eye[k] -= view[4 * k + row] * view[12 + row];
    for (int k = 0; k < 3; k++) target[k] = eye[k] - view[4 * k + 2]; /* it looks along -z */
    printf("--eye=%.17g,%.17g,%.17g --target=%.17g,%.17g,%.17g\n", eye[0], eye[1], eye[2],
           target[0], target[1], target[2]);
}

static dp_result fit(const char *model, double aspect, dp_camera *camera, dp_diag *diag) {
    dp_source *source = NULL;
    dp_extent extent;
    dp_result result = dp_io_open(model, NULL, &source, diag);
    if (!result) result = dp_source_extent(source, &extent, diag);
    dp_source_destroy(source);
    if (result) return result;
    dp_fit box = {.aspect = aspect};
    memcpy(box.exact_min, extent.exact_min, sizeof box.exact_min);
    memcpy(box.exact_max, extent.exact_max, sizeof box.exact_max);
    return dp_camera_fit(camera, &box);
}

int main(int argc, char **argv) {
    const double aspect = argc == 3 ? atof(argv[2]) : 4.0 / 3;
    if (argc < 2 || argc > 3 || !(aspect > 0))
        return fprintf(stderr, "usage: camera MODEL [ASPECT]\n"), 2;
    dp_camera camera;
    dp_diag diag = {.message = "it cannot be seen"};
    if (fit(argv[1], aspect, &camera, &diag))
        return fprintf(stderr, "camera: %s: %s\n", argv[1], diag.message), EXIT_FAILURE;
    print_options(camera.view);
    return EXIT_SUCCESS;
}
