# Sourced by run.sh: glTF, which the library reads itself.
gltf_tests="gltf_files broken_gltf"

# A triangle, its numbers in the text: 1 byte each.
gltf_triangle() {
    cat <<'END'
{"asset": {"version": "2.0"}, "nodes": [{"name": "sail", "mesh": 0, "translation": [5, 0, 0]}],
 "meshes": [{"name": "sail", "primitives": [{"attributes": {"POSITION": 0}}]}],
 "buffers": [{"byteLength": 9, "uri": "data:;base64,AAAAAQAAAAEA"}],
 "bufferViews": [{"buffer": 0, "byteLength": 9}],
 "accessors": [{"bufferView": 0, "componentType": 5120, "count": 3, "type": "VEC3"}]}
END
}
gltf_files() {
    gltf_triangle >a.gltf
    run 0 info a.gltf
    says out 'bounds from                      5 0 0'
    says out 'bounds to                        6 1 0'
    says out 'up                               0 1 0'
    "$program" info - <a.gltf >piped || fail "not read from a pipe"
    says piped 'polygons                         1'
    run 0 a.gltf $small -o out.png
    is_png out.png
    run 0 a.gltf $small --time 3 -o later.png
    cmp -s out.png later.png || fail "what does not move is elsewhere later"
}
broken_gltf() {
    gltf_triangle | sed 's/data:[^"]*/no.bin/' >a.gltf
    bad a.gltf 'a.gltf: buffer 0: no.bin: No such file or directory; copy it beside the model'
    "$program" info - <a.gltf 2>err && fail "read without its buffer"
    says err 'standard input: buffer 0: its bytes are in the file no.bin, which was not given with the model'
    gltf_triangle | sed 's/"count": 3/"count": 300/' >b.gltf
    bad b.gltf 'b.gltf: mesh 0: accessor 0: it needs bytes up to 900 of bufferView 0, which has 9: the file is damaged'
    gltf_triangle | tr -d '\n' | head -c 200 >c.gltf
    bad c.gltf 'the JSON text ends'
    printf 'glTF\2\0\0\0' >d.glb
    bad d.glb 'd.glb: the file ends in its header: it is cut off'
}
