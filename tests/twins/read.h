/* Reads the simple OBJ and STL files of tests/cases, in double precision and with no help of the
 * library. */
#ifndef DP_TEST_READ_H
#define DP_TEST_READ_H

#include "soup.h"

/* Fills *out, which must be empty. False: it cannot be read. */
bool soup_read(const char *path, soup *out);

#endif
