"""The extensions: `_native`, the core alone, and `_native_io`, with all formats of the program.

Each is whole. The package loads the second where the libraries that it needs are, else the first.
"""

import os

import cffi

from . import cdef

HERE = os.path.dirname(os.path.abspath(__file__))
INCLUDE = os.path.join(os.path.dirname(os.path.dirname(HERE)), "include")

# The package's own: what C calls in Python (src/drypoint), and native.c.
TYPES = """
typedef struct drypoint_progress {
    void *handle; /* of the Python object that is told; NULL: nobody is */
    double last;  /* s: when it was told */
} drypoint_progress;
"""
CALLBACKS = """
extern "Python" {
    int drypoint_report(void *handle, double fraction);
    bool drypoint_open_beside(void *handle, const char *name, const void **data, size_t *size);
    dp_result drypoint_compress(const void *bytes, size_t size, dp_text_writer *write, void *user,
                                dp_diag *diag);
}
void drypoint_progress_begin(drypoint_progress *progress);
int drypoint_progress_call(void *user, double fraction);
"""


def builder(name, headers, libraries, needed):
    """An ffi builder for cffi's setuptools hook. libraries: archives; needed: shared ones."""
    ffi = cffi.FFI()
    ffi.cdef(cdef.make(headers, INCLUDE) + TYPES + CALLBACKS)
    with open(os.path.join(HERE, "native.c"), encoding="utf-8") as file:
        native = file.read()
    includes = "".join(f"#include <drypoint/{header}>\n" for header in headers)
    callback = "static int drypoint_report(void *handle, double fraction);\n"
    ffi.set_source(
        name,
        includes + TYPES + callback + native,
        include_dirs=[INCLUDE],
        extra_objects=libraries,
        libraries=needed,
        extra_compile_args=["-std=gnu17", "-O1", "-g0"],
        extra_link_args=["-pthread", "-Wl,--exclude-libs,ALL"],
        py_limited_api=True,
    )
    return ffi
