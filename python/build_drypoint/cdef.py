"""The declarations that cffi is given, made of include/drypoint by the C compiler's preprocessor.

What cffi cannot read is taken out: attributes, inline functions, what the standard's headers
    hold, and
functions that take pointers to constant arrays.
Macros that are numbers become `#define NAME ...`, whose values the compiler fills in.
"""

import os
import re
import shlex
import subprocess
import tempfile

STANDARD_HEADERS = ("stdbool.h", "stddef.h", "stdint.h")
NUMBER = re.compile(r"#define (DP_\w+) +\(?(?:[0-9(]|DP_)")
INLINE = re.compile(r"static inline [^{;]*\{[^{}]*\}")
# Functions that take a pointer to a constant array: cffi writes wrong C for them.
CONSTANT_ARRAY = re.compile(r"typedef \w+ (\w+)\([^;]*const \w+ \(\*\w+\)\[[^;]*;")


def preprocess(includes, folder, *flags):
    """What `cc -E` makes of the headers, without those of the standard: cffi knows their types."""
    compiler = shlex.split(os.environ.get("CC", "cc"))
    text = "".join(f"#include <drypoint/{name}>\n" for name in includes)
    with tempfile.TemporaryDirectory() as empty:
        for name in STANDARD_HEADERS:
            open(os.path.join(empty, name), "w").close()
        command = [
            *compiler,
            "-E",
            *flags,
            "-nostdinc",
            "-I",
            empty,
            "-I",
            folder,
            "-D__attribute__(x)=",
            "-x",
            "c",
            "-",
        ]
        return subprocess.run(
            command, input=text, capture_output=True, text=True, check=True
        ).stdout


def constants(includes, folder):
    """Names of the macros that stand for a number."""
    return sorted(NUMBER.findall(preprocess(includes, folder, "-dM")))


def without_constant_arrays(text):
    """The declarations without such function types, and without what takes one."""
    for name in CONSTANT_ARRAY.findall(text):
        text = re.sub(rf"[^;{{}}]*\b{name}\b[^;{{}}]*;", "", text)
    return text


def make(includes, folder):
    """The cdef of some headers of include/drypoint, in the folder that holds drypoint/."""
    declarations = without_constant_arrays(INLINE.sub("", preprocess(includes, folder, "-P")))
    defines = "".join(f"#define {name} ...\n" for name in constants(includes, folder))
    return defines + declarations
