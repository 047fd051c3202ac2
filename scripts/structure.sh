#!/bin/bash
# structure.sh: do arrows between the folders of src/ point one way? Prints each include that does not, each file
# of over 600 lines and each header that more than 12 files of a library include (but for base and core, and gl.h), and fails if there
# is any. src/gl is a library of its own. docs/architecture.md draws the arrows.
set -u
cd "$(dirname "$0")/../src" || exit

# Who may include whom; a folder may always include itself. From the bottom up: nobody names a later one.
rules='
base
mesh     base
texture  base
write    base
scene    base mesh
io       base mesh scene
core     base mesh texture
features base mesh texture core
raster   base mesh core
find     base mesh core features raster
printed  base mesh texture core features raster
strokes  base mesh texture core features
gbuffer  base mesh core raster
shade    base mesh texture core raster gbuffer
sink     base mesh texture core raster strokes
vector   base mesh texture core strokes sink
stream   base mesh core features raster find
draw     base mesh texture core features raster find printed strokes gbuffer shade sink stream vector
gl       base mesh texture core features strokes gbuffer shade draw
'
find . -name '*.[ch]' -o -name '*.inc' | sed 's|^\./||' | sort | xargs awk -v rules="$rules" '
BEGIN {
    n = split(rules, line, "\n")
    for (i = 1; i <= n; i++) {
        m = split(line[i], word, " ")
        for (k = 2; k <= m; k++) {
            if (!(word[k] in known)) { print "structure: the rule of " word[1] " names " word[k] ", which comes later"; bad++ }
            may[word[1], word[k]] = 1
        }
        if (m) known[word[1]] = 1
    }
}
FNR == 1 { split(FILENAME, part, "/"); folder = part[1]; file = FILENAME
    if (!(folder in known)) { print "structure: no rule for src/" folder; bad++ } }
{ lines[FILENAME]++ }
match($0, /^#include "[^"]+"/) {
    path = substr($0, 11, RLENGTH - 11)
    split(path, part, "/")
    if (!index(path, "/")) { print "structure: src/" file ": " path " is named without its folder"; bad++ }
    else if (part[1] != folder && !((folder, part[1]) in may)) {
        print "structure: src/" file " includes " path ", but " folder " may not use " part[1]; bad++ }
    if (path ~ /\.h$/) users[(folder == "gl" ? "gl: " : "") path]++
}
END {
    for (f in lines) if (lines[f] > 600) { print "structure: src/" f " has " lines[f] " lines; 600 are the most"; bad++ }
    for (h in users) if (users[h] > 12 && h !~ /^(gl: )?(base|core)\// && h != "gl: gl/gl.h") {
        print "structure: " h " is included by " users[h] " files; 12 are the most"; bad++ }
    exit bad > 0
}'
