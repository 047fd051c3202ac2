/* alike A.png B.png: 0 if the pictures are of one size and no more than one pixel in two thousand differs
 * by more than 30 % in a channel; 1 if not; 2 if one cannot be read. */
#include <drypoint/io.h>

#include <stdio.h>
#include <stdlib.h>

int main(int argc, char **argv) {
    dp_io_pixels a = {0}, b = {0};
    if (argc != 3 || dp_io_read_png(argv[1], &a, NULL) || dp_io_read_png(argv[2], &b, NULL)) {
        fputs("alike A.png B.png: cannot be read\n", stderr);
        return 2;
    }
    const size_t pixels = (size_t)a.width * a.height;
    size_t different = a.width == b.width && a.height == b.height ? 0 : SIZE_MAX;
    for (size_t i = 0; i < pixels && different != SIZE_MAX; i++) {
        int most = 0;
        for (size_t k = 4 * i; k < 4 * i + 4; k++) {
            const int off = abs(a.rgba[k] - b.rgba[k]);
            most = off > most ? off : most;
        }
        different += most > 76;
    }
    dp_io_free_pixels(&a);
    dp_io_free_pixels(&b);
    if (different > pixels / 2000) printf("%zu of %zu pixels differ\n", different, pixels);
    return different > pixels / 2000;
}
