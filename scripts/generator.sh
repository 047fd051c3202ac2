#!/bin/sh
# Prints the CMake options that choose the generator: Ninja where it is installed.
if command -v ninja >/dev/null 2>&1; then echo "-GNinja"; fi
