# Tests of --gl and of drypoint view, for run.sh, which reads this file: as far as there is OpenGL without a window.
# shellcheck shell=bash disable=SC2034

opengl_tests="draws_by_opengl opengl_refuses opengl_missing opengl_old no_viewer"

# Is there OpenGL 4.3 without a window, and is it built in? What ends in another way than being told so has failed.
has_opengl() {
    local code=0
    "$program" shape:cube --gl --size 32x32 -o probe.png -q 2>probe || code=$?
    [ $code -le 1 ] || fail "--gl: exit code $code: $(head -c 300 probe)"
    return $code
}

draws_by_opengl() {
    has_opengl || return
    run 0 shape:bolt $small -q --gl --detail exact -o gl.png --stats
    is_png gl.png
    says err 'device '
    says err 'faces '
    run 0 shape:bolt $small -q --gl -o again.png --stats json
    says out '"device": "'
    says out '"stages": {"vertices": '
    cmp -s gl.png again.png || fail "--gl draws lines other than exact ones"
    run 0 shape:cube -q --gl --size 64x48 --preset blueprint -o blue.png
    run 0 shape:bolt $small -q --gl -o lines.svg -o trace=lines.txt
    grep -q '<path' lines.svg || fail "no path is in lines.svg"
    says lines.txt 'silhouette'
    run 0 shape:bracket -q --gl --size 64x48 --turn 360 --frames 2 -o 'film-%d.png'
    cmp -s film-0.png film-1.png && fail "both frames are alike"
}
# What OpenGL does not draw is named, and nothing is left.
opengl_refuses() {
    has_opengl || return
    run 1 shape:bolt $small -q --gl --hidden dashed -o out.png
    one_line
    says err '--gl: OpenGL does not draw hidden lines; leave out --gl'
    run 1 shape:bolt $small -q --gl --clip 1,0,0 -o out.png
    says err '--gl: OpenGL does not draw sections and hatching; leave out --gl'
    run 1 shape:bolt $small -q --gl --detail auto -o out.png
    says err 'detail of lines other than exact'
    run 1 shape:bolt $small -q --gl --object '*:color=red' -o out.png
    says err '--gl: OpenGL draws no object in a look of its own'
    run 1 shape:bolt $small -q --gl -o out.png -o depth=z.png
    says err '--gl: OpenGL gives pixels and lines, no planes'
    absent out.png
}
opengl_missing() {
    wrong bench shape:cube --gl -- 'option --gl does not belong to "drypoint bench"'
    wrong shape:cube -o out.png --backend gl -- 'option --backend does not belong to "drypoint MODEL"; give --gl'
    has_opengl && return # and where there is none:
    run 1 shape:cube --gl -o out.png
    one_line
    says err '--gl: '
    absent out.png
}
# A driver that is too old is told by its version (Mesa's, which can be told to be older).
opengl_old() {
    has_opengl || return
    "$program" shape:cube --gl --size 32x32 -o probe.png --stats json 2>/dev/null | grep -q llvmpipe || return 0
    MESA_GL_VERSION_OVERRIDE=3.3 run 1 shape:cube --gl -o out.png
    one_line
    says err 'OpenGL 4.3 or later is needed, here is 3.3'
    run 0 shape:cube --gl --size 32x32 --samples 16 -o out.png
    says err 'warning: --samples: OpenGL draws 4 of a pixel, not 16'
}
# The program without its viewer beside it; and wrong words are told before a window opens.
no_viewer() {
    cp "$program" alone
    PATH=/nowhere ./alone view shape:cube >out 2>err && fail "a viewer was found"
    says err 'drypoint-view, is neither beside this program nor on PATH'
    wrong view shape:cube --backend vulkan -- 'is none of cpu|gl'
    wrong view shape:cube --gl -- 'give --backend gl'
    wrong view shape:cube -o out.png -- 'option --output does not belong to "drypoint view"'
}
