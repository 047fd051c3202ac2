/* Keeps what another process says on its stderr in a file without a name: a pipe would have to be
 * emptied while there is other work to do. */
#include "words.h"
#include "progress.h"

#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

int words_open(void) {
    FILE *const file = tmpfile();
    const int words = file ? fcntl(fileno(file), F_DUPFD_CLOEXEC, 3) : -1;
    if (file) fclose(file);
    return words;
}

void words_show(int words) {
    char bytes[1024];
    off_t at = 0;
    progress_clear();
    for (ssize_t count; (count = pread(words, bytes, sizeof bytes, at)) > 0; at += count)
        fwrite(bytes, 1, (size_t)count, stderr);
}

enum { TAIL = 480, LINES = 4 };

void words_tail(int words, char *text, size_t size) {
    char tail[TAIL + 1];
    const off_t end = lseek(words, 0, SEEK_END), begin = end > TAIL ? end - TAIL : 0;
    const ssize_t count = end > 0 ? pread(words, tail, TAIL, begin) : 0;
    size_t length = count > 0 ? (size_t)count : 0;
    while (length && strchr(" \t\r\n", tail[length - 1])) length--;
    size_t from = length;
    for (int lines = 0; from > 0; from--)
        if (tail[from - 1] == '\n' && ++lines == LINES) break;
    if (from == 0 && begin > 0) /* the first line is cut */
        while (from < length && tail[from] != '\n') from++;
    *text = 0;
    size_t at = 0;
    for (; from < length && at + 3 < size; from++) {
        const bool line_ends = tail[from] == '\n' || tail[from] == '\r';
        if (line_ends && at && text[at - 1] != ' ') text[at++] = ';', text[at++] = ' ';
        if (!line_ends && ((unsigned char)tail[from] >= ' ' || tail[from] == '\t'))
            text[at++] = tail[from];
    }
    text[at] = 0;
}
