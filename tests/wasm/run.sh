#!/usr/bin/env bash
# Draws the same under Node, as WebAssembly with and without threads, as natively; and the kernels give the bits of plain C
# there. Usage: run.sh PATH/TO/wasm_pictures [MODEL...]. With models, only their drawings are compared. The modules are
# built first, by the presets `web` and `web-threads`. Prints TAP; 77: skipped.
set -u
native=$(realpath "$1")
shift
models=()
for model; do models+=("$(realpath "$model")"); done
cd "$(dirname "$0")/../.." || exit
for tool in emcc node cmake; do
    command -v $tool >/dev/null || { echo "skipped: there is no $tool"; exit 77; }
done
work=$(mktemp -d "${TMPDIR:-/tmp}/drypoint-wasm-XXXXXX")
trap 'rm -rf "$work"' EXIT

number=0 failed=0
# ok NAME COMMAND...: one test, which prints why it failed.
ok() {
    local name=$1
    shift
    number=$((number + 1))
    if "$@" >"$work/why" 2>&1; then
        echo "ok $number - $name"
    else
        echo "not ok $number - $name"
        head -n 20 "$work/why" | sed 's/^/# /'
        failed=1
    fi
}

# build PRESET FOLDER: its tests.
build() {
    # shellcheck disable=SC2046
    cmake --preset "$1" $([ -e "build/$2/CMakeCache.txt" ] || scripts/generator.sh) >"$work/build" 2>&1 &&
        cmake --build "build/$2" --parallel "${JOBS:-2}" --target wasm_tests >>"$work/build" 2>&1 ||
        { tail -n 15 "$work/build"; return 1; }
}

# in_node FOLDER PROGRAM ARGUMENT...: this Node must not fetch, as Emscripten takes that for a browser's.
in_node() {
    local program=build/$1/tests/wasm/$2.js
    shift 2
    timeout 300 node --no-experimental-fetch "$program" "$@"
}

# same COMMAND...: it prints what the native program does.
same() {
    "$@" "${models[@]}" >"$work/other" && diff "$work/native" "$work/other"
}

"$native" --threads 1 "${models[@]}" >"$work/native" || exit
lines=$(wc -l <"$work/native")
echo "# $lines drawings"
refused() { ! grep -vE '( [0-9a-f]{16}){3}$' "$work/native"; }
[ ${#models[@]} -gt 0 ] || ok 'no drawing is refused' refused

ok 'the core builds as WebAssembly, with one thread' build web web-single
ok 'the core builds as WebAssembly, with threads' build web-threads web-threads
[ $failed -eq 0 ] || exit 1
for test in kernels kernels_ink kernels_lines elementary; do
    [ ${#models[@]} -gt 0 ] || ok "test_$test holds in WebAssembly" in_node web-single wasm_test_$test
done
ok 'the pictures of one thread are the native ones' same in_node web-single wasm_pictures
ok 'so are those of more threads than the pool has' same in_node web-threads wasm_pictures --threads 64
[ ${#models[@]} -gt 0 ] || ok 'so are those of a thread per processor' same in_node web-threads wasm_pictures --threads 0
echo "1..$number"
exit $failed
