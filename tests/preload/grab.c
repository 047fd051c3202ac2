/* grab.c: looks at a part of the screen: grab X Y WIDTH HEIGHT [picture.ppm]
 *
 * Says which part of it is paper (white) and which is ink (black), and succeeds if that is a line drawing: more than
 * half paper, and at least one pixel of 500 ink. */
#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <stdio.h>
#include <stdlib.h>

static int write_picture(XImage *image, const char *path) {
    FILE *const file = fopen(path, "wb");
    if (!file) return 1;
    fprintf(file, "P6\n%d %d\n255\n", image->width, image->height);
    for (int i = 0; i < image->width * image->height; i++) {
        const unsigned long rgb = XGetPixel(image, i % image->width, i / image->width);
        for (int shift = 16; shift >= 0; shift -= 8) fputc((int)(rgb >> shift & 255), file);
    }
    return fclose(file) != 0;
}

int main(int argc, char **argv) {
    if (argc < 5) return 2;
    Display *const display = XOpenDisplay(NULL);
    if (!display) return 2;
    XImage *const image =
        XGetImage(display, DefaultRootWindow(display), atoi(argv[1]), atoi(argv[2]),
                  (unsigned)atoi(argv[3]), (unsigned)atoi(argv[4]), AllPlanes, ZPixmap);
    if (!image) return 2;
    long paper = 0, ink = 0;
    const long pixels = (long)image->width * image->height;
    for (long i = 0; i < pixels; i++) {
        const unsigned long rgb =
            XGetPixel(image, (int)(i % image->width), (int)(i / image->width)) & 0xffffff;
        paper += rgb == 0xffffff;
        ink += rgb == 0;
    }
    printf("%.1f %% paper, %.2f %% ink\n", 100.0 * (double)paper / (double)pixels,
           100.0 * (double)ink / (double)pixels);
    const int failed = argc > 5 && write_picture(image, argv[5]);
    XDestroyImage(image);
    XCloseDisplay(display);
    return failed || 2 * paper < pixels || 500 * ink < pixels;
}
