/* Runs a fuzzer's entry point over the files of directories without libFuzzer, so that every
 * compiler checks what was once found. One line per file, as in other tests. */
#include <dirent.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static int replay(const char *directory, const char *name) {
    char path[4096];
    snprintf(path, sizeof path, "%s/%s", directory, name);
    FILE *const file = fopen(path, "rb");
    if (!file) return 1;
    fseek(file, 0, SEEK_END);
    const long size = ftell(file);
    rewind(file);
    uint8_t *const data = size < 0 ? NULL : malloc((size_t)size + 1);
    const int whole = data && fread(data, 1, (size_t)size, file) == (size_t)size;
    fclose(file);
    if (whole) LLVMFuzzerTestOneInput(data, (size_t)size);
    free(data);
    printf("[       %s ] %s\n", whole ? "OK" : "FAILED", name);
    return !whole;
}

int main(int count, char **directories) {
    int failed = 0, files = 0;
    for (int i = 1; i < count; i++) {
        DIR *const directory = opendir(directories[i]);
        if (!directory) return fprintf(stderr, "cannot open %s\n", directories[i]), 1;
        for (const struct dirent *entry; (entry = readdir(directory)); files++)
            if (entry->d_name[0] != '.') failed += replay(directories[i], entry->d_name);
        closedir(directory);
    }
    if (!files) fprintf(stderr, "the corpus is empty\n");
    return failed || !files;
}
