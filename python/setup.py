"""Builds the wheel: the libraries by CMake unless DRYPOINT_BUILD names a folder that has them,
the rest here."""

import glob
import os
import re
import subprocess
import sys

from setuptools import setup
from setuptools.command.build_py import build_py

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(HERE)
INCLUDE = os.path.join(ROOT, "include", "drypoint")
sys.path.insert(0, HERE)  # for build_drypoint
ABI = "cp311"  # the oldest Python whose stable ABI is asked for


def read(*path):
    """The text of a file of the project."""
    with open(os.path.join(*path), encoding="utf-8") as file:
        return file.read()


def version():
    """(major, minor, patch), of base.h."""
    return tuple(
        int(n) for n in re.findall(r"#define DP_VERSION_\w+ (\d+)", read(INCLUDE, "base.h"))
    )


def libraries():
    """The folder that holds libdrypoint.a, and libdrypoint_io.a where there is one."""
    folder = os.environ.get("DRYPOINT_BUILD")
    if not folder:
        folder = os.path.join(ROOT, "build")
        if not os.path.exists(os.path.join(folder, "CMakeCache.txt")):
            subprocess.run(["cmake", "--preset", "release"], cwd=ROOT, check=True)
        subprocess.run(
            ["cmake", "--build", folder, "--parallel", "--target", "drypoint_io"], check=True
        )
    if not os.path.exists(os.path.join(folder, "libdrypoint.a")):
        raise SystemExit(
            f"there is no libdrypoint.a in {folder}: build the target drypoint there first"
        )
    return os.path.abspath(folder)


class BuildPython(build_py):
    """Writes the module that is made from the headers into the package."""

    def run(self):
        from build_drypoint import classes, headers

        super().run()
        types = {}
        for path in sorted(glob.glob(os.path.join(INCLUDE, "*.h"))):
            if not os.path.basename(path).startswith("gl"):
                types.update(headers.parse(read(path)))
        colors = classes.colors_of(read(ROOT, "tools", "colors.c"))
        target = os.path.join(self.build_lib, "drypoint", "_generated.py")
        with open(target, "w", encoding="utf-8") as file:
            file.write(classes.Writer(types).module(version(), colors))


def extensions():
    """What cffi's hook builds: names of functions without arguments, in this file."""
    found = ["setup.py:core_extension"]
    if os.path.exists(os.path.join(FOLDER, "libdrypoint_io.a")):
        found.append("setup.py:io_extension")
    return found


def core_extension():
    """The core alone: libc, libm and pthreads."""
    from build_drypoint import extension

    return extension.builder(
        "drypoint._native", ["drypoint.h"], [os.path.join(FOLDER, "libdrypoint.a")], ["m"]
    )


def io_extension():
    """The core and what needs libpng, zlib and Assimp."""
    from build_drypoint import extension

    archives = [os.path.join(FOLDER, name) for name in ("libdrypoint_io.a", "libdrypoint.a")]
    return extension.builder(
        "drypoint._native_io", ["drypoint.h", "io.h"], archives, ["png", "z", "assimp", "m"]
    )


FOLDER = libraries()

if __name__ == "__main__":
    setup(
        version=".".join(str(n) for n in version()),
        cffi_modules=extensions(),
        cmdclass={"build_py": BuildPython},
        options={"bdist_wheel": {"py_limited_api": ABI}},
    )
