#!/bin/bash
# install.sh CMAKE BUILD SOURCE LIBDIR: installs below DESTDIR, looks at what came there, and uninstalls: nothing is left.
# What other programs say of manual pages and desktop files is asked where these are.
set -eu
cmake=$1 build=$2 source=$3 libdir=$4
stage=$(mktemp -d)
trap 'rm -rf "$stage"' EXIT
export DESTDIR=$stage/root
root=$DESTDIR/opt/drypoint
problems=0
bad() { echo "install: $*" >&2 && problems=$((problems + 1)); }
has() { command -v "$1" >/dev/null; }

"$cmake" --install "$build" --prefix /opt/drypoint >"$stage/log"

# ---- what is there ----

for path in bin/drypoint "$libdir/libdrypoint.a" "$libdir/libdrypoint.so" "$libdir/libdrypoint_io.so" \
    "$libdir/pkgconfig/drypoint.pc" "$libdir/cmake/drypoint/drypointConfig.cmake" include/drypoint/drypoint.h \
    share/man/man1/drypoint.1 share/bash-completion/completions/drypoint share/zsh/site-functions/_drypoint \
    share/fish/vendor_completions.d/drypoint.fish share/doc/drypoint/README.md share/doc/drypoint/docs/lines.md \
    share/doc/drypoint/docs/gallery/hero.png share/doc/drypoint/examples/find_package/CMakeLists.txt; do
    [ -s "$root/$path" ] || bad "there is no $path"
done
[ ! -e "$build/drypoint-view" ] || [ -x "$root/bin/drypoint-view" ] || bad "the viewer was built, but not installed"
[ "$(find "$stage/root" -type f | grep -cv "^$root/")" -eq 0 ] || bad "files lie outside the prefix"
# Everything but what was copied for reading knows nothing of the places where it was built and staged.
if grep -rIlF --exclude-dir=doc -e "$build" -e "$source" -e "$stage" "$root"; then bad "those name where they were built"; fi

# ---- as others see it ----

if has man && has groff; then
    for page in "$root"/share/man/man1/*; do # .so is looked up from the folder above
        (cd "$root/share/man" && LC_ALL=C.UTF-8 MANROFFSEQ='' man --warnings=w -E UTF-8 -l "man1/${page##*/}") \
            >"$stage/page" 2>"$stage/warnings" || bad "man does not show ${page##*/}"
        [ ! -s "$stage/warnings" ] || bad "${page##*/}: $(head -n 3 "$stage/warnings")"
        grep -q -e '--output' "$stage/page" || bad "${page##*/} does not tell of --output"
    done
fi
for entry in "$root"/share/applications/*.desktop; do
    [ -e "$entry" ] || continue
    if has desktop-file-validate; then
        desktop-file-validate "$entry" >"$stage/said" 2>&1 || true
        [ ! -s "$stage/said" ] || bad "$(cat "$stage/said")"
    fi
    started=$(sed -n 's/^Exec=\([^ ]*\).*/\1/p' "$entry")
    [ -x "$root/bin/$started" ] || bad "$entry starts $started, which is not installed"
    icon=$(sed -n 's/^Icon=//p' "$entry")
    [ -s "$root/share/icons/hicolor/scalable/apps/$icon.svg" ] || bad "$entry has no icon $icon"
done
if has xmllint; then
    find "$root" \( -name '*.metainfo.xml' -o -name drypoint.svg \) -exec xmllint --noout {} + || bad "that is no XML"
fi

# ---- and gone again ----

mkdir -p "$root/share/doc/another"
touch "$root/share/doc/another/file" "$root/bin/another"
"$cmake" -DBUILD="$build" -P "$source/cmake/Uninstall.cmake" >"$stage/log"
left=$(cd "$root" && find . ! -type d | sort | paste -sd' ')
[ "$left" = "./bin/another ./share/doc/another/file" ] || bad "uninstalling leaves other files than those of others: $left"
left=$(find "$root" -mindepth 1 -type d -empty)
[ -z "$left" ] || bad "uninstalling leaves empty directories: $left"
if "$cmake" -DBUILD="$build" -P "$source/cmake/Uninstall.cmake" 2>"$stage/log"; then
    bad "there is nothing to uninstall, and nobody says so"
fi
[ "$problems" -eq 0 ]
