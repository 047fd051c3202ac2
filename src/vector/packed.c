/* RunLengthEncode, then ASCII85Encode (PostScript Language Reference, 3.13.3), byte by byte.
 *
 * Runs: a count n below 128 and n + 1 bytes as they are; a count n above 128 and one byte that comes
 * 257 - n times; 128 at the end. */
#include "vector/packed.h"

enum { COLUMNS = 72, END_OF_DATA = 128 };

/* ------- text ------- */

/* Lines must not begin with %: readers of comments would take them for theirs. */
static void put_character(dp_packed *p, char c) {
    if (p->column >= COLUMNS) {
        dp_put_char(p->out, '\n');
        p->column = 0;
    }
    if (!p->column && c == '%') dp_put_char(p->out, ' ');
    dp_put_char(p->out, c);
    p->column++;
}

/* `count` of four bytes make one character more. */
static void put_four(dp_packed *p, int count) {
    static const uint32_t powers[] = {85 * 85 * 85 * 85, 85 * 85 * 85, 85 * 85, 85, 1};
    if (!p->four && count == 4)
        put_character(p, 'z');
    else
        for (int i = 0; i <= count; i++) put_character(p, (char)('!' + p->four / powers[i] % 85));
    p->four = 0;
    p->fours = 0;
}

static void put_byte(dp_packed *p, uint32_t byte) {
    p->four |= byte << (24 - 8 * p->fours);
    if (++p->fours == 4) put_four(p, 4);
}

/* ------- runs ------- */

static void put_literals(dp_packed *p) {
    if (!p->literals) return;
    put_byte(p, (uint32_t)p->literals - 1);
    for (int i = 0; i < p->literals; i++) put_byte(p, p->literal[i]);
    p->literals = 0;
}

static void end_run(dp_packed *p) {
    if (p->repeats > 2) {
        put_literals(p);
        put_byte(p, 257 - (uint32_t)p->repeats);
        put_byte(p, p->repeated);
        p->repeats = 0;
    }
    for (; p->repeats; p->repeats--) {
        if (p->literals == (int)sizeof p->literal) put_literals(p);
        p->literal[p->literals++] = p->repeated;
    }
}

void dp_packed_put(dp_packed *p, uint8_t byte) {
    if (p->repeats && (byte != p->repeated || p->repeats == 128)) end_run(p);
    p->repeated = byte;
    p->repeats++;
}

void dp_packed_end(dp_packed *p) {
    end_run(p);
    put_literals(p);
    put_byte(p, END_OF_DATA);
    if (p->fours) put_four(p, p->fours);
    dp_put_text(p->out, "~>\n");
}
