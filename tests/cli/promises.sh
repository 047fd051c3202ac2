# The table "What the paper promises" of docs/lines.md, for run.sh, which reads this file: each of its commands runs
# without a warning and draws something, what moves is another picture a frame later, and each call and file that it
# names is there.
# shellcheck shell=bash disable=SC2034,SC2086,SC2154

promise_tests="promised_commands promised_calls"

# The rows of the table, without its head.
promises() {
    sed -n '/^### What the paper promises/,/^##* Definitions/p' "$here/../../docs/lines.md" | grep '^|' | tail -n +3
}
# bytes N...: these bytes in base64, without line breaks.
bytes() { printf '%b' "$(printf '\\x%02x' "$@")" | base64 -w 0; }
# list_bytes BASE64 COUNT COMPONENT-TYPE TYPE: a buffer, its bufferView and its accessor are added to the lists.
buffers='' views='' accessors='' listed=0
list_bytes() {
    local comma=${buffers:+, } size
    size=$(base64 -d <<<"$1" | wc -c)
    buffers+="$comma{\"byteLength\": $size, \"uri\": \"data:;base64,$1\"}"
    views+="$comma{\"buffer\": $listed, \"byteLength\": $size}"
    accessors+="$comma{\"bufferView\": $listed, \"count\": $2, \"componentType\": $3, $4}"
    listed=$((listed + 1))
}
# bending_bar: a glTF of a square bar whose skin follows two joints, one of which turns by 90 degrees within a second.
bending_bar() {
    local corners=() joints=() weights=() sides=() ring side next
    for ring in 0 1 2 3; do
        corners+=(255 $((2 * ring)) 255 1 $((2 * ring)) 255 1 $((2 * ring)) 1 255 $((2 * ring)) 1)
        for side in 0 1 2 3; do
            joints+=(0 1 0 0)
            weights+=($((255 - 85 * ring)) $((85 * ring)) 0 0)
            next=$(((side + 1) % 4))
            # the corners: below, and above this ring
            [ $ring = 3 ] || sides+=($((4 * ring + next)) $((4 * ring + side)) $((4 * ring + side + 4))
                $((4 * ring + next)) $((4 * ring + side + 4)) $((4 * ring + next + 4)))
        done
    done
    sides+=(0 1 2 0 2 3 12 14 13 12 15 14)
    buffers='' views='' accessors='' listed=0
    list_bytes "$(bytes "${corners[@]}")" 16 5120 '"type": "VEC3"'
    list_bytes "$(bytes "${joints[@]}")" 16 5121 '"type": "VEC4"'
    list_bytes "$(bytes "${weights[@]}")" 16 5121 '"type": "VEC4", "normalized": true'
    list_bytes "$(bytes "${sides[@]}")" 84 5121 '"type": "SCALAR"'
    list_bytes "$(bytes 0 0 0 0 0 0 128 63)" 2 5126 '"type": "SCALAR"'                       # 0 s, 1 s
    list_bytes "$(bytes 0 0 0 0 0 0 0 0 0 0 0 0 0 0 128 63 0 0 0 0 0 0 0 0 243 4 53 63 243 4 53 63)" 2 5126 \
        '"type": "VEC4"' # none, and 90 degrees about z
    cat <<END
{"asset": {"version": "2.0"}, "nodes": [{"mesh": 0, "skin": 0}, {"children": [2]}, {"name": "arm"}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2}, "indices": 3}]}],
 "skins": [{"joints": [1, 2]}],
 "animations": [{"name": "Bend", "samplers": [{"input": 4, "output": 5}],
   "channels": [{"sampler": 0, "target": {"node": 2, "path": "rotation"}}]}],
 "buffers": [$buffers],
 "bufferViews": [$views],
 "accessors": [$accessors]}
END
}
# The models that its commands name: a bar that bends, a cylinder with a vase of the same polygons, and one on
# another's top.
promised_models() {
    bending_bar >dancer.gltf
    run 0 make cylinder -o cylinder.obj
    awk '$1 == "v" {s = 1 + $3 * $3; print "v", $2 * s, $3, $4 * s; next} {print}' cylinder.obj >vase.obj
    {
        echo "o below"
        grep -E '^[vf] ' cylinder.obj
        echo "o above"
        awk '$1 == "v" {n++; print "v", $2, $3 + 2, $4} $1 == "f" {for (i = 2; i <= NF; i++) $i = int($i) + n; print}' \
            cylinder.obj
    } >engine.obj
}
# drawn FILE: a PNG that is more than paper.
drawn() {
    is_png "$1"
    [ "$(wc -c <"$1")" -gt 400 ] || fail "$1 has $(wc -c <"$1") bytes: is it empty?"
}
promised_commands() {
    promised_models
    promises | grep -oE '`drypoint [^`]+`' | tr -d '`' >commands
    [ "$(wc -l <commands)" -ge 14 ] || fail "only $(wc -l <commands) commands"
    while read -r _ command; do
        rm -f ./*.png
        run 0 $command $small
        silent err
        local name=${command##*-o }
        if [ "$name" = "${name%-%02d.png}" ]; then
            drawn "$name"
            continue
        fi
        drawn "${name%-%02d.png}-00.png"
        drawn "${name%-%02d.png}-01.png"
        cmp -s "${name%-%02d.png}-00.png" "${name%-%02d.png}-01.png" && fail "$command: nothing moves"
    done <commands
}
promised_calls() {
    local include=$here/../../include/drypoint
    promises | grep -oE '`dp_[a-z_.]+`' | tr -d '`' | sort -u >calls
    [ "$(wc -l <calls)" -ge 10 ] || fail "only $(wc -l <calls) calls"
    while read -r call; do
        grep -qE "\b${call##*.}\b" "$include"/*.h || fail "$call is in no header"
    done <calls
    promises | grep -oE '\]\([^)#]+' | cut -c3- | sort -u >links
    while read -r link; do
        [ -f "$here/../../docs/$link" ] || fail "$link is not there"
    done <links
    while read -r row; do
        grep -qE '\]\(' <<<"$row" || fail "described nowhere: $row"
        grep -qE '`(drypoint |dp_)' <<<"$row" || fail "shown by nothing: $row"
    done < <(promises)
}
