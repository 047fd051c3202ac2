#!/bin/sh
# web.sh: builds the page for browsers into build/web: the core as WebAssembly with and without threads, then the page
# around it (web/build.mjs). Packages of npm are fetched where npm is; only an optional part needs one (web/package.json).
set -eu
cd "$(dirname "$0")/.."

# Debian's emscripten finds its scripts' packages there with Debian's node; others have to be told.
[ ! -d /usr/share/nodejs ] || export NODE_PATH="/usr/share/nodejs${NODE_PATH:+:$NODE_PATH}"

for tool in cmake emcc node; do
    command -v $tool >/dev/null || { echo "web: no $tool; \`scripts/setup.sh web\` installs it" >&2 && exit 1; }
done

# npm's own note of what it installed is older than the list: the list has changed.
if [ -z "$(find web/node_modules/.package-lock.json -newer web/package-lock.json 2>/dev/null)" ]; then
    if ! command -v npm >/dev/null || ! (cd web && npm ci --no-audit --no-fund --ignore-scripts); then
        echo "web: npm has not fetched web/package.json's packages; what needs one is left out" >&2
    fi
fi

for preset in web web-threads; do
    folder=build/$preset
    [ $preset = web-threads ] || folder=build/web-single
    # shellcheck disable=SC2046
    cmake --preset $preset $([ -e "$folder/CMakeCache.txt" ] || scripts/generator.sh)
    cmake --build $folder --parallel "${JOBS:-$(nproc)}" --target drypoint_web
done
node web/build.mjs
