#!/bin/bash
# deb.sh: builds Debian packages in build/deb, has lintian look at them, and lists them. What they need is installed by
# `scripts/setup.sh deb`.
#
# They are built in a copy of the files that git knows, as these are now; the tree itself stays as it is. Files' dates are
# those of debian/changelog, so that one source gives the same bytes each time.
set -euo pipefail
umask 022 # folders of the copy have no other rights for being made here
cd "$(dirname "$0")/.."
jobs=${JOBS:-$(nproc)}
out=build/deb
log=$out/build.log
say() { echo "deb: $*"; }

# The version is written once, in include/drypoint/base.h; dpkg takes it from debian/changelog.
version=$(sed -n 's/^#define DP_VERSION_[A-Z]* \([0-9]*\)$/\1/p' include/drypoint/base.h | paste -sd.)
logged=$(dpkg-parsechangelog -S Version)
if [ "$version" != "$logged" ]; then
    say "debian/changelog has $logged, include/drypoint/base.h $version: add an entry (dch -v $version)" >&2
    exit 1
fi
minor=${version%.*}
if ! grep -q "^Package: libdrypoint$minor$" debian/control; then
    say "debian/ has no libdrypoint$minor: packages of libraries are named after the minor version" >&2
    exit 1
fi

if ! git rev-parse --git-dir >/dev/null 2>&1; then
    say "this is no git checkout, which says what belongs to the source: here dpkg-buildpackage -b does without" >&2
    exit 1
fi
rm -rf "$out"
source=$out/drypoint-$version
mkdir -p "$source"
# What git ignores or does not know yet is no part of the source; what is deleted here is not either.
git ls-files -z --deduplicate | while IFS= read -r -d '' file; do
    [ ! -e "$file" ] && [ ! -L "$file" ] || printf '%s\0' "$file"
done | tar --create --null --files-from=- --mode=u=rwX,go=rX --mtime="@$(dpkg-parsechangelog -S Timestamp)" | tar --extract -C "$source"

say "building in $source, which takes some minutes; $log tells more"
if ! (cd "$source" && DEB_BUILD_OPTIONS="parallel=$jobs noautodbgsym ${DEB_BUILD_OPTIONS:-}" dpkg-buildpackage -us -uc) >"$log" 2>&1; then
    grep -nE 'error:|Error|missing' "$log" | tail -n 10 >&2
    tail -n 20 "$log" >&2
    exit 1
fi
say "lintian"
as_root=
[ "$(id -u)" -ne 0 ] || as_root=--allow-root
lintian $as_root --fail-on error,warning "$out"/*.changes
(cd "$out" && du -b -- *.deb)
