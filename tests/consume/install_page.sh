#!/bin/bash
# install_page.sh CC CMAKE SOURCE PREFIX LIBDIR: docs/install.md as it stands: its C project is built in two ways with what is
# installed in PREFIX, its jobs of CI are run from where they draw on, its targets of make are there, and so are its packages,
# of this version.
set -eu
cc=$1 cmake=$2 source=$3 prefix=$4 libdir=$5
page=$source/docs/install.md
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
export PATH="$prefix/bin:$PATH" PKG_CONFIG_PATH="$prefix/$libdir/pkgconfig" LD_LIBRARY_PATH="$prefix/$libdir"
problems=0
bad() { echo "docs/install.md: $*" >&2 && problems=$((problems + 1)); }

# blocks LANGUAGE: what code blocks of that language hold; each goes to its own file, LANGUAGE-1 and so on, too.
blocks() {
    awk -v language="$1" '
        $0 == "```" language { on = 1; n++; next }
        /^```$/ { on = 0 }
        on { print; print > (language "-" n) }' "$page"
}
blocks sh >commands
blocks cmake >/dev/null
blocks yaml >/dev/null

# ---- what make can do ----

sed -n 's/^make \([a-z]*\).*/\1/p' commands | sort -u >targets
[ "$(wc -l <targets)" -ge 4 ] || bad "only the targets $(paste -sd' ' targets)"
while read -r target; do
    case $target in # parts that a copy of the sources may lack
    web | serve) [ -d "$source/web" ] || continue ;;
    wheel) [ -d "$source/python" ] || continue ;;
    esac
    grep -q "^$target\( [a-z ]*\)*:" "$source/Makefile" || bad "make $target: there is no such target"
done <targets
grep -o '^| `[^|]*' "$page" | tr -d '| `' | tr ',' '\n' | sort >told
sed -n 's/^Package: //p' "$source/debian/control" | sort >packages
cmp -s told packages || bad "its packages are not those of debian/control: $(diff told packages | paste -sd' ')"

version=$(sed -n 's/^#define DP_VERSION_[A-Z]* \([0-9]*\)$/\1/p' "$source/include/drypoint/base.h" | paste -sd.)
head -n 1 "$source/debian/changelog" | grep -qF "drypoint ($version)" || bad "debian/changelog does not begin with $version"

# ---- a program of yours ----

awk '/^```c$/ { n++; on = 1; next } /^```$/ { on = 0 } on && n == 1' "$source/README.md" >bolt.c
mkdir by_cmake
cp bolt.c by_cmake
cp cmake-1 by_cmake/CMakeLists.txt
"$cmake" -S by_cmake -B by_cmake/build -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_C_COMPILER="$cc" >log 2>&1 ||
    bad "its CMake project is not configured: $(tail -n 5 log)"
"$cmake" --build by_cmake/build >log 2>&1 || bad "its CMake project does not build: $(tail -n 5 log)"
(cd by_cmake && build/bolt && [ -s bolt.png ]) || bad "its CMake project does not draw"
command=$(grep '^cc ' commands)
eval "$cc ${command#cc }" || bad "$command"
./bolt
[ -s bolt.png ] || bad "what $command builds does not draw"
while read -r line; do # as tests/consume/add_subdirectory says it
    line=${line//yours/triangle} line=${line//(drypoint)/(\$\{DRYPOINT_SOURCE_DIR\} drypoint)}
    grep -qF "$line" "$source/tests/consume/add_subdirectory/CMakeLists.txt" || bad "add_subdirectory: $line"
done <cmake-2

# ---- in CI ----

if /usr/bin/python3 -c 'import yaml' 2>/dev/null; then
    for file in yaml-*; do
        /usr/bin/python3 -c 'import sys, yaml; yaml.safe_load(open(sys.argv[1]))' "$file" || bad "$file is no YAML"
    done
fi
mkdir parts drawings
for shape in bracket gear; do drypoint make $shape -o parts/$shape.stl; done
# job FILE: what a job does once Drypoint is installed.
job() {
    rm -rf drawn
    sed -nE 's/^ *- (run: )?((mkdir|drypoint|diff) .*)/\2/p' "$1" >steps
    [ "$(wc -l <steps)" -eq 3 ] || bad "$1: $(wc -l <steps) steps"
    bash -e steps >log 2>&1
}
! job yaml-2 || bad "nobody misses drawings"
grep -q '^Only in drawn: gear.svg' log || bad "yaml-2: $(cat log)"
cp steps steps-2
cp drawn/*.svg drawings
job yaml-1 || bad "yaml-1: $(cat log)"
cmp -s steps steps-2 || bad "the jobs are not alike: $(diff steps steps-2 | paste -sd' ')"
while read -r command; do
    bash -e -o pipefail -c "$command" >log 2>&1 || bad "$command: $(cat log)"
done < <(grep '^drypoint ' commands)
sed -i '1s/.*/<!-- another -->/' drawings/gear.svg
! job yaml-1 || bad "a drawing that changed is not noticed"
grep -q 'gear.svg .* differ' log || bad "yaml-1: $(cat log)"
[ "$problems" -eq 0 ]
