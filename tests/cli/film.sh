# Tests of films, for run.sh, which reads this file: frames as pictures, as raw pixels and through ffmpeg, cameras that
# move, what is left on disk when something ends too soon. ffmpeg itself is used where it is installed.
# shellcheck shell=bash disable=SC2034,SC2086,SC2154

film_tests="frames_as_pictures frames_alone_and_in_any_order turning_cameras turns_fit films_of_motion film_paths wrong_paths films_of_each
    film_sheets_and_pages raw_films resumed_films wrong_films film_statistics ffmpeg_missing ffmpeg_fails ffmpeg_is_slow
    interrupted_films films_by_ffmpeg films_from_a_pipe films_that_fail film_progress"

film_cube="shape:cube --size 64x48"

# fake_ffmpeg: a program of that name, first on PATH, of the commands that are read.
fake_ffmpeg() {
    mkdir -p bin
    { echo '#!/bin/bash'; cat; } >bin/ffmpeg
    chmod +x bin/ffmpeg
}
# same_bytes A B: two files are the same.
same_bytes() { cmp -s "$1" "$2" || fail "$1 and $2 differ"; }
files_like() { find . -maxdepth 1 -name "$1" | wc -l; }

# ---- frames ----

frames_as_pictures() {
    run 0 $film_cube --turn 360 --frames 12 -o out-%04d.png -o out-%d.svg -o trace=lines-%02d.txt -o normals=n-%d.png -q
    silent out
    silent err
    [ "$(files_like 'out-*.png')" = 12 ] || fail "$(files_like 'out-*.png') pictures"
    [ "$(files_like 'out-*.svg')" = 12 ] || fail "$(files_like 'out-*.svg') SVGs"
    [ "$(files_like 'lines-*.txt')" = 12 ] || fail "$(files_like 'lines-*.txt') traces"
    [ "$(files_like 'n-*.png')" = 12 ] || fail "$(files_like 'n-*.png') normals"
    is_png out-0000.png
    is_png out-0011.png
    [ "$(png_size out-0005.png)" = 64x48 ] || fail "size $(png_size out-0005.png)"
    cmp -s out-0000.png out-0001.png && fail "nothing moves"
    # %% is a percent sign, and a cube has turned once in a quarter of the frames
    run 0 $film_cube --turn 360 --frames 4 -o '%%%d%%.png' -q
    [ -e '%3%.png' ] || fail "no %3%.png: $(ls)"
    mkdir '100%'
    run 0 $film_cube --turn 360 --frames 2 -o '100%%/%d.png' -o 'normals=100%%/n%d.png' -q
    [ -e '100%/n1.png' ] || fail "no 100%/n1.png"
    run 0 $film_cube --turn 360 --frames 4 --frame 2 -o - -q
    same_bytes out '%2%.png'
    # a film of what does not move is its picture
    run 0 $film_cube -o still.png
    run 0 $film_cube --frames 2 -o still-%d.png
    same_bytes still.png still-0.png
    same_bytes still.png still-1.png
    no_temporary
}
# A frame is the same bytes alone, whatever is drawn beside it, by however many processes and threads.
frames_alone_and_in_any_order() {
    local film="shape:bracket shape:bolt --turn 360 --frames 9 --size 160x120 --style gooch --stroke pencil -q"
    run 0 $film -o a-%d.png -o a-%d.svg --jobs 1
    run 0 $film -o b-%d.png -o b-%d.svg --jobs 3 --threads 2
    run 0 $film -o c-%d.png -o c-%d.svg --jobs 20 --threads 1
    run 0 $film -o film.rgba --jobs 4 -o d-%d.png -o d-%d.svg
    for k in 0 4 8; do
        run 0 $film -o alone-%d.png -o alone-%d.svg --frame $k
        for ending in png svg; do
            same_bytes a-$k.$ending b-$k.$ending
            same_bytes a-$k.$ending c-$k.$ending
            same_bytes a-$k.$ending alone-$k.$ending
        done
        same_bytes a-$k.png d-$k.png
    done
    [ "$(files_like 'alone-*.png')" = 3 ] || fail "--frame draws others, too"
    run 0 $film -o one.png -o one.svg --frame 4
    same_bytes a-4.png one.png
    # with a camera of its own a frame is the picture
    run 0 shape:bolt $small --eye 3,2,4 --target 0,0,0 -o own.png -q
    run 0 shape:bolt $small --eye 3,2,4 --target 0,0,0 --time 0:1 --frames 3 -o own-%d.png -q
    same_bytes own.png own-2.png
}

# ---- cameras ----

# A turn goes the way --azimuth does, and ends with its last frame unless it loops.
turning_cameras() {
    run 0 shape:bracket $small --eye 0,0,5 --target 0,0,0 --turn 90 --frames 3 -o turn-%d.png -q
    run 0 shape:bracket $small --eye 0,0,5 --target 0,0,0 -o front.png -q
    run 0 shape:bracket $small --eye 5,0,0 --target 0,0,0 -o right.png -q
    same_bytes turn-0.png front.png
    same_bytes turn-2.png right.png
    run 0 shape:bracket $small --eye 0,0,5 --target 0,0,0 --turn 360 --frames 4 -o round-%d.png -q
    same_bytes round-0.png front.png
    same_bytes round-1.png right.png
    cmp -s round-3.png front.png && fail "the last frame repeats the first"
    # about what is up, and about --target
    run 0 shape:bracket $small --eye 1,-5,1 --target 1,0,1 --up z --turn 360 --frames 4 -o up-%d.png -q
    run 0 shape:bracket $small --eye 6,0,1 --target 1,0,1 --up z -o up.png -q
    same_bytes up-1.png up.png
    run 0 shape:cube $small --turn 360 -o all-%d.png -q
    [ "$(files_like 'all-*.png')" = 120 ] || fail "$(files_like 'all-*.png') frames of a turn"
}
# What moves is drawn at each frame's time; the camera shows all of it and stands still.
films_of_motion() {
    local wave="shape:torus --deform wave" k left top right bottom
    # an animation plays as long as it lasts, and a moving camera alone does not start it
    sliding # 2 s of a square (animations.sh)
    local view='--eye 5,0,30 --target 5,0,0 --size 64x48 -q'
    run 0 sliding.x $view -o slide-%d.png --fps 5
    [ "$(files_like 'slide-*.png')" = 10 ] || fail "$(files_like 'slide-*.png') frames of 2 s"
    run 0 sliding.x $view --time 1 -o later.png
    same_bytes later.png slide-5.png
    run 0 sliding.x $view --turn 360 --frames 8 -o turn-%d.png
    run 0 sliding.x $view -o rest.png
    same_bytes rest.png turn-0.png
    run 0 sliding.x $view --animation Return --fps 5 -o back-%d.png
    [ "$(files_like 'back-*.png')" = 5 ] || fail "$(files_like 'back-*.png') frames of 1 s"
    # the fitted camera shows all of the way
    run 0 sliding.x --view front --size 64x48 --frames 5 -q --format rgba -o film.bin --time 0:2
    for k in 0 4; do
        dd if=film.bin of=frame bs=12288 skip=$k count=1 2>/dev/null
        read -r left top right bottom < <(ink_box frame)
        [ $((right - left)) -lt 12 ] || fail "frame $k is fitted alone: $left $top $right $bottom"
    done
    run 0 $wave $small --eye 4,3,5 --target 0,0,0 --time 0:1 --frames 8 -o w-%d.png -o w-%d.svg -q --jobs 3
    for k in 0 1 5; do
        run 0 $wave $small --eye 4,3,5 --target 0,0,0 --time "$(awk "BEGIN { print $k / 8 }")" -o still.png -o still.svg -q
        same_bytes still.png w-$k.png
        same_bytes still.svg w-$k.svg
    done
    cmp -s w-0.png w-4.png && fail "nothing moves"
    run 0 $wave --size 32x24 --time 0:1 --fps 10 -o count-%d.png -q
    [ "$(files_like 'count-*.png')" = 10 ] || fail "$(files_like 'count-*.png') frames of 1 s"
    run 0 $wave $small --time 1:0 --frames 8 --eye 4,3,5 --target 0,0,0 -o back-%d.png -o back-%d.svg -q
    same_bytes back-3.png w-5.png
    # a chest rises: its lowest point, which does not move, stands still in the picture
    printf 'v -1 -1 -1\nv 1 -1 -1\nv 1 -1 1\nv -1 -1 1\nv 0 1 0\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\nf 4 3 2 1\n' >tent.obj
    run 0 tent.obj --deform wave:axis=y,across=x --size 64x48 --view front --time 0:1 --frames 8 -q --format rgba -o film.bin
    for k in $(seq 0 7); do
        dd if=film.bin of=frame bs=12288 skip=$k count=1 2>/dev/null
        read -r left top right bottom < <(ink_box frame)
        { [ "$left" -ge 1 ] && [ "$right" -le 62 ]; } || fail "frame $k is cut off: $left $top $right $bottom"
        echo "$bottom"
    done | sort -u >bottoms
    [ "$(wc -l <bottoms)" = 1 ] || fail "the camera jumps: $(tr '\n' ' ' <bottoms)"
}
# ink_box FILE: the inked rows and columns of a raw picture of 64x48, as LEFT TOP RIGHT BOTTOM.
ink_box() {
    od -An -v -tu1 -w256 "$1" | awk -v l=99 -v t=99 '{ for (x = 0; x < 64; x++) if ($(4 * x + 1) < 128) {
        if (x < l) l = x; if (x > r) r = x; if (NR - 1 < t) t = NR - 1; b = NR - 1 } } END { print l, t, r, b }'
}
# No frame is cut off, and at least one reaches the margin.
turns_fit() {
    local left top right bottom widest=0 tallest=0
    printf 'v -3 0 -.5\nv 3 0 -.5\nv 3 0 .5\nv -3 0 .5\nv 0 1 0\nf 1 2 3 4\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n' >roof.obj
    run 0 roof.obj --size 64x48 --view right --turn 360 --frames 12 -q --format rgba -o film.bin
    [ "$(wc -c <film.bin)" = $((64 * 48 * 4 * 12)) ] || fail "$(wc -c <film.bin) bytes"
    for k in $(seq 0 11); do
        dd if=film.bin of=frame bs=12288 skip=$k count=1 2>/dev/null
        read -r left top right bottom < <(ink_box frame)
        { [ "$left" -ge 1 ] && [ "$top" -ge 1 ] && [ "$right" -le 62 ] && [ "$bottom" -le 46 ]; } ||
            fail "frame $k is cut off: $left $top $right $bottom"
        [ $((right - left)) -gt $widest ] && widest=$((right - left))
    done
    [ $widest -ge 55 ] || fail "the widest frame is $widest px wide"
    # a mirror turns with the model, and its corners come nearest in a frame that is not the first
    run 0 shape:cube --size 64x48 --view front --elevation 30 --mirror 0,1,0 --paper '#FFFFFF' --surface '#000000' \
        --mirror-tint '#000000' --mirror-tint-share 1 --turn 360 --frames 8 -q --format rgba -o film.bin
    for k in 0 1 2 3; do
        dd if=film.bin of=frame bs=12288 skip=$k count=1 2>/dev/null
        read -r left top right bottom < <(ink_box frame)
        { [ "$left" -ge 1 ] && [ "$top" -ge 1 ] && [ "$right" -le 62 ] && [ "$bottom" -le 46 ]; } ||
            fail "the mirror is cut off in frame $k: $left $top $right $bottom"
    done
}
film_paths() {
    cat >path.json <<'PATH'
{"views": [
  {"time": 0, "eye": [0, 0, 5], "target": [0, 0, 0], "fov": 40},
  {"time": 1, "eye": [4, 1, 3], "target": [0, 0, 0], "fov": 30},
  {"time": 2, "eye": [5, 0, 0], "target": [0, 0, 0], "fov": 40}]}
PATH
    run 0 shape:bracket $small --path path.json --frames 3 -o path-%d.png -q
    run 0 shape:bracket $small --eye 4,1,3 --target 0,0,0 --fov 30 -o key.png -q
    same_bytes path-1.png key.png
    run 0 shape:bracket $small --eye 5,0,0 --target 0,0,0 --fov 40 -o key.png -q
    same_bytes path-2.png key.png
    run 0 shape:cube --size 16x12 --path path.json --fps 10 -o count-%d.png -q # both ends are shown
    [ "$(files_like 'count-*.png')" = 21 ] || fail "$(files_like 'count-*.png') frames of 2 s"
    echo '[{"eye": [0,0,5], "target": [0,0,0], "height": 3}, {"eye": [5,0,0], "target": [0,0,0], "height": 2},
           {"eye": [0,0,5], "target": [0,0,0], "height": 3}]' >loop.json
    run 0 shape:cube --size 16x12 --path loop.json --fps 10 -o loop-%d.png -q # and the first one once
    [ "$(files_like 'loop-*.png')" = 20 ] || fail "$(files_like 'loop-*.png') frames of a loop of 2 s"
    run 0 shape:bracket $small --eye 0,0,5 --target 0,0,0 --ortho 3 -o key.png -q
    run 0 shape:bracket $small --path loop.json --frame 0 -o first.png -q
    same_bytes first.png key.png
}
wrong_paths() {
    printf '{"views": [\n  {"eye": [1, 2, 3], "target": [0, 0, 0],\n   "fow": 3}]}' >bad.json
    run 1 $film_cube --path bad.json -o out-%d.png
    one_line
    says err 'bad.json:3: view 1 of the path has a "fow"'
    printf '[{"eye": [1, 2, 3], "target": [0, 0, 0]},\n' >cut.json
    run 1 $film_cube --path cut.json -o out-%d.png
    one_line
    says err 'cut.json:'
    run 1 $film_cube --path none.json -o out-%d.png
    one_line
    says err '--path none.json: cannot be read'
    run 1 $film_cube --path . -o out-%d.png
    one_line
    echo '[{"eye": [0,0,1], "target": [0,0,0]}, {"eye": [0,0,-1], "target": [0,0,0]}]' >through.json
    run 1 $film_cube --path through.json --frames 3 -o out-%d.png
    one_line
    says err "at 0.5 s the path's eye meets its target"
    no_temporary
}

# ---- outputs ----

films_of_each() {
    run 0 shape:cube shape:torus --size 32x24 --turn 360 --frames 3 -o '%s-%d.png' -o %s.rgba -q
    [ "$(files_like '*.png')" = 6 ] || fail "$(files_like '*.png') pictures"
    [ "$(wc -c <torus.rgba)" = 9216 ] || fail "$(wc -c <torus.rgba) bytes"
    run 0 shape:cube --size 32x24 --turn 360 --frames 3 -o alone.rgba -q
    same_bytes cube.rgba alone.rgba
    run 0 make cube -o '100%d.stl'
    run 0 '100%d.stl' --size 32x24 --turn 360 --frames 2 -o '%s-%d.png' -q
    [ -e '100%d-1.png' ] || fail "a model's name is taken for a pattern: $(ls)"
}
film_sheets_and_pages() {
    run 0 shape:gear --frames 2 --sheet front,top --dpi 30 -o sheet-%d.png -o sheet-%d.pdf -q
    run 0 shape:gear --sheet front,top --dpi 30 -o sheet.png -q
    same_bytes sheet.png sheet-1.png
    [ "$(head -c 5 sheet-1.pdf)" = %PDF- ] || fail "no PDF"
    run 0 shape:gear --turn 360 --frames 3 --page 60x40mm -o page-%d.png -q
    run 0 shape:gear --frames 1 --page 60x40mm -o whole-%d.svg -q
    run 0 shape:gear --page 60x40mm -o whole.svg -q
    same_bytes whole.svg whole-0.svg
}
raw_films() {
    run 0 $film_cube --turn 360 --frames 5 -o film.rgba -o frame-%d.png -q
    [ "$(wc -c <film.rgba)" = $((64 * 48 * 4 * 5)) ] || fail "$(wc -c <film.rgba) bytes"
    run 0 $film_cube --turn 360 --frames 5 --format rgba -o - -q
    same_bytes film.rgba out
    mkfifo pipe.rgba
    cat pipe.rgba >through &
    run 0 $film_cube --turn 360 --frames 5 -o pipe.rgba -q
    wait $!
    same_bytes film.rgba through
    [ -p pipe.rgba ] || fail "the pipe was replaced"
    ln -s film.rgba link.rgba
    run 0 $film_cube --turn 360 --frames 6 -o link.rgba -q
    [ -L link.rgba ] && [ "$(wc -c <film.rgba)" = $((64 * 48 * 4 * 6)) ] || fail "the link was replaced"
    # whoever reads no further is no crash
    "$program" $film_cube --turn 360 --frames 500 --format rgba -o - 2>err | head -c 100 >/dev/null
    [ "${PIPESTATUS[0]}" -lt 139 ] || fail "exit code ${PIPESTATUS[0]}"
    no_temporary
}
# Only what is missing is drawn, and what is there stays as it is.
resumed_films() {
    local film="$film_cube --turn 360 --frames 6 -o f-%d.png -o trace=t-%d.txt"
    run 0 $film -q
    cp f-3.png good.png
    rm f-3.png t-4.txt
    echo mine >f-1.png
    run 0 $film --resume --stats
    says err '4 of 6 frames are there already'
    says err 'frames drawn                                2'
    same_bytes f-3.png good.png
    [ -s t-4.txt ] || fail "a frame that is there in part is not drawn"
    [ "$(cat f-1.png)" = mine ] || fail "a frame that is there is drawn"
    run 0 $film --resume
    says err '6 of 6 frames are there already'
    run 0 $film --resume -q
    silent err
}
wrong_films() {
    wrong $film_cube --frames 10 -o out.png -- '-o out.png is one picture, and a film has many: name it -o out-%04d.png, or -o out.mp4'
    wrong $film_cube --turn 90 -o out.pdf -- 'name it -o out-%04d.pdf'
    wrong $film_cube --time 0:2 -o out.png -- 'a film has many'
    wrong $film_cube --frames 10 -o out-%d.png -o trace=out.txt -- '-o trace=out-%04d.txt'
    wrong $film_cube --frames 10 -o - -- 'give --format rgba'
    wrong $film_cube -o out-%d.png -- 'how long is the film? The model does not say: add --frames N'
    wrong $film_cube -o out.rgba -- 'how long is the film?'
    wrong $film_cube --frames 4 --frame 4 -o out.png -- '--frame 4: the film has 4 frames, 0 to 3'
    wrong $film_cube --frames 4 --frame 1 -o out.rgba -- '-o out.rgba is a film'
    wrong $film_cube --frames 4 --resume -o out.rgba -- '--resume is for pictures'
    wrong $film_cube --frames 4 --resume --frame 1 -o out-%d.png -- 'leave one out'
    wrong $film_cube --turn 90 --path p.json -o out-%d.png -- 'leave one out'
    wrong $film_cube --path p.json --azimuth 3 -o out-%d.png -- '--path already says where from'
    wrong $film_cube --path p.json --zoom 3 -o out-%d.png -- '--path already says how much is seen'
    wrong shape:cube --sheet front --turn 90 -o out-%d.png -- '--sheet already says where from'
    wrong $film_cube --frames 0 -o out-%d.png -- '--frames'
    wrong $film_cube --time 0:1e9 -q -o out-%d.png -- 'is too long'
    wrong $film_cube --frames 3 -o out-%d.mp3 -- 'drawings are written as'
    wrong shape:cube shape:gear --frames 3 -o out.rgba -o '%s-%d.png' -- 'put %s into its name'
    run 0 $film_cube -o out.png --jobs 2 --fps 30
    says err '--fps, --jobs change nothing'
    run 1 $film_cube --frames 3 -o none/out-%d.png
    one_line
    run 1 $film_cube --frames 3 -o none/out.rgba
    one_line
    run 1 missing.obj --frames 3 -o missing.rgba
    absent missing.rgba
}
film_statistics() {
    run 0 $film_cube --turn 360 --frames 5 -o film.rgba --stats=json --jobs 2 -q
    silent err
    python3 -c 'import json, sys
s = json.load(open("out"))
assert s["frames"] == 5 and s["width"] == 64 and s["jobs"] == 2 and s["triangles"] == 12, s
assert s["frame_ms_min"] <= s["frame_ms"] <= s["frame_ms_max"] and s["frames_per_second"] > 0, s' 2>json || fail "$(cat json)"
    # what is to be said is said once
    printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 9\n' >bad.obj
    run 0 bad.obj --size 64x48 --turn 360 --frames 5 -o out-%d.png
    [ "$(grep -c 'index out of range' err)" = 1 ] || fail "not said once: $(cat err)"
}
films_from_a_pipe() {
    run 0 make cube -o cube.stl
    run 0 cube.stl --size 64x48 --turn 360 --frames 4 -o file.rgba -q --jobs 3
    cat cube.stl | "$program" - --size 64x48 --turn 360 --frames 4 -o piped.rgba -q 2>err || fail "a pipe: $(cat err)"
    same_bytes file.rgba piped.rgba
    "$program" - --size 64x48 --turn 360 --frames 4 -o given.rgba -q 2>err <cube.stl || fail "redirected: $(cat err)"
    same_bytes file.rgba given.rgba
    [ -z "${SANITIZED:-}" ] || return
    # a file that is read in parts, by several processes at once
    run 0 make terrain -o hills.stl --triangles 1200000
    run 0 hills.stl --size 64x48 --turn 360 --frames 3 -o one.rgba -q --jobs 1 --memory 48M
    run 0 hills.stl --size 64x48 --turn 360 --frames 3 -o three.rgba -q --jobs 3 --memory 48M
    same_bytes one.rgba three.rgba
}

# ---- ffmpeg, and what goes wrong ----

ffmpeg_missing() {
    echo old >out.mp4
    mkdir empty
    PATH=$PWD/empty run 1 $film_cube --turn 360 -o out.mp4
    one_line
    says err '-o out.mp4: such films are made by ffmpeg, and there is none on PATH; install it'
    says err '-o out-%04d.png'
    [ "$(cat out.mp4)" = old ] || fail "the old file is gone"
    PATH='' run 1 $film_cube --turn 360 --format webm -o -
    says err 'there is none on PATH'
    PATH=$PWD/empty run 0 $film_cube --turn 360 --frames 2 -o out.rgba -q
}
ffmpeg_fails() {
    echo old >out.mp4
    printf 'echo "[libx264 @ 0x55] boom" >&2\necho "Conversion failed!" >&2\nexit 69\n' | fake_ffmpeg
    PATH=$PWD/bin:$PATH run 1 $film_cube --turn 360 --frames 50 -o out.mp4
    one_line
    says err 'out.mp4: ffmpeg failed with exit code 69: [libx264 @ 0x55] boom; Conversion failed!'
    printf 'cat >/dev/null\nfor k in $(seq 1000); do echo "line $k" >&2; done\nexit 1\n' | fake_ffmpeg
    PATH=$PWD/bin:$PATH run 1 $film_cube --turn 360 --frames 50 -o out.mp4
    one_line
    says err 'exit code 1: line 997; line 998; line 999; line 1000'
    printf 'kill -9 $$\n' | fake_ffmpeg
    PATH=$PWD/bin:$PATH run 1 $film_cube --turn 360 --frames 50 -o out.mp4
    says err 'was ended by a signal'
    printf 'cat >/dev/null\n' | fake_ffmpeg
    PATH=$PWD/bin:$PATH run 1 $film_cube --turn 360 --frames 5 -o out.mp4
    one_line
    says err 'out.mp4: ffmpeg wrote nothing'
    printf 'head -c 1000 >/dev/null\n' | fake_ffmpeg
    PATH=$PWD/bin:$PATH run 1 $film_cube --turn 360 --frames 50 -o out.mp4
    says err 'ended before the film did'
    # of two films the whole one is not put there either, and pictures beside them stay
    PATH=$PWD/bin:$PATH run 1 $film_cube --turn 360 --frames 50 -o out.rgba -o out.mp4
    absent out.rgba
    [ "$(cat out.mp4)" = old ] || fail "the old file is gone"
    no_temporary
}
# What is written appears when ffmpeg is done with it, however long that takes.
ffmpeg_is_slow() {
    printf 'cat >frames\nsleep 0.3\nfor last; do :; done\necho "a film" >"${last#file:}"\n' | fake_ffmpeg
    PATH=$PWD/bin:$PATH run 0 $film_cube --turn 360 --frames 50 -o ./-out.mp4 -q
    silent err
    [ "$(cat ./-out.mp4)" = 'a film' ] || fail "$(cat ./-out.mp4)"
    [ "$(wc -c <frames)" = $((64 * 48 * 4 * 50)) ] || fail "$(wc -c <frames) bytes of frames"
    # it reads slowly
    printf 'while head -c 4096 | grep -qc .; do sleep 0.01; done\nfor last; do :; done\necho "a film" >"${last#file:}"\n' |
        fake_ffmpeg
    PATH=$PWD/bin:$PATH run 0 $film_cube --turn 360 --frames 20 -o out.mp4 -q
    no_temporary
}
# Ctrl-C: nothing is left, neither files nor processes.
interrupted_films() {
    local signal
    echo old >out.mp4
    printf 'echo $$ >pid\nexec sleep 60\n' | fake_ffmpeg
    for signal in INT TERM HUP; do
        PATH=$PWD/bin:$PATH interrupt $signal 0.7 $film_cube --turn 360 --frames 2000 -o out.mp4
        case $signal:$code in INT:130 | TERM:143 | HUP:129) ;; *) fail "SIG$signal: exit code $code" ;; esac
        [ "$(cat out.mp4)" = old ] || fail "the old file is gone"
        no_temporary
        kill -0 "$(cat pid)" 2>/dev/null && fail "ffmpeg is left after SIG$signal"
    done
    # ffmpeg has all frames, and does not end
    printf 'cat >/dev/null\necho $$ >pid\nexec sleep 60\n' | fake_ffmpeg
    PATH=$PWD/bin:$PATH interrupt INT 0.7 $film_cube --turn 360 --frames 2 -o out.mp4
    [ "$code" = 130 ] || fail "while waiting for ffmpeg: exit code $code"
    kill -0 "$(cat pid)" 2>/dev/null && fail "ffmpeg is left"
    interrupt INT 0.7 shape:terrain:300000 --turn 360 --frames 1000 --size 1600x1200 -o big-%d.png -o film.rgba --jobs 3
    [ "$code" = 130 ] || fail "pictures: exit code $code"
    absent film.rgba
    no_temporary
    for picture in big-*.png; do [ ! -e "$picture" ] || is_png "$picture"; done
}
# A frame that cannot be written, or a process that is ended, ends the film.
films_that_fail() {
    [ ! -w /dev/full ] || run 1 $film_cube --turn 360 --frames 9 -o /dev/full --format rgba
    [ ! -w /dev/full ] || says err 'No space left on device'
    mkdir f-3.png
    run 1 $film_cube --turn 360 --frames 9 -o f-%d.png --jobs 3
    one_line
    says err 'f-3.png'
    "$program" $film_cube --turn 360 --frames 1000000 -o film.rgba --jobs 1 >out 2>err &
    local main=$! job='' tries=0
    while [ -z "$job" ] && [ $tries -lt 100 ]; do
        sleep 0.05
        tries=$((tries + 1))
        job=$(pgrep -P $main | head -n 1)
    done
    if [ -n "$job" ]; then
        kill -9 "$job"
        wait $main && fail "no error when a process was killed"
        says err 'a process that draws frames was ended'
    fi
    absent film.rgba
    no_temporary
} 2>/dev/null # the shell tells who was killed
film_progress() {
    script -qec true /dev/null >seen 2>&1 </dev/null || return # no such program, or no terminals here
    printf 'while head -c 65536 | grep -qc .; do sleep 0.05; done\nfor last; do :; done\necho "a film" >"${last#file:}"\n' |
        fake_ffmpeg
    PATH=$PWD/bin:$PATH script -qec "$program $film_cube --turn 360 --frames 200 -o out.mp4" /dev/null >seen </dev/null
    grep -q 'drawing \[.* left' seen || fail "no progress bar with the time left"
    [ "$(tail -c 4 seen | od -An -c | tr -d ' \n')" = '\r033[K' ] || fail "the bar is not cleared"
}
# Real films, as ffprobe sees them.
films_by_ffmpeg() {
    command -v ffmpeg >/dev/null && command -v ffprobe >/dev/null ||
        { echo "# ffmpeg is not installed: films are not looked at"; return; }
    run 0 shape:gear --size 65x49 --turn 360 --frames 12 --fps 10 -q -o f.mp4 -o f.webm -o f.gif -o f.apng -o f-%d.png
    silent err
    local ending seen wanted
    for ending in mp4 webm gif apng; do
        seen=$(ffprobe -v error -count_frames -select_streams v -of csv=p=0 \
            -show_entries stream=width,height,r_frame_rate,nb_read_frames f.$ending)
        case $ending in mp4) wanted=66,50,10/1,12 ;; *) wanted=65,49,10/1,12 ;; esac
        [ "$seen" = $wanted ] || fail "f.$ending: $seen, not $wanted"
    done
    # an APNG loses nothing
    ffmpeg -v error -i f.apng -f rawvideo -pix_fmt rgba f.bin </dev/null
    run 0 shape:gear --size 65x49 --turn 360 --frames 12 -q -o f.rgba
    same_bytes f.bin f.rgba
    "$program" shape:gear --size 64x48 --turn 360 --frames 3 -q --format webm -o - >piped.webm || fail "webm in a pipe"
    seen=$(ffprobe -v error -count_frames -of csv=p=0 -show_entries stream=nb_read_frames piped.webm)
    [ "$seen" = 3 ] || fail "webm in a pipe: $seen frames"
    run 0 shape:gear --size 64x48 --turn 360 --frames 3 -q --paper none -o clear.gif -o clear.webm -o clear.apng -o clear.mp4
    no_temporary
}
