#!/bin/bash
# check.sh [PHASE...]: builds and tests in several ways, and closes with the line `N passed, N failed`.
#
# One phase is one preset of CMakePresets.json and the tests that say something new there. Counted are single
# tests, not programs: a cmocka program that runs nine tests counts nine; a program that crashes, hangs
# or fails without saying which test it was counts as one failure; so does a phase that does not build.
# A failing phase shows what failed and the others still run. It says at the start how long it takes, and at least
# every 30 s what runs now.
set -u
cd "$(dirname "$0")/.." || exit
jobs=${JOBS:-$(nproc)}
logs=build/check-logs
mkdir -p "$logs"
passed=0 failed=0
width=46

# ---- time ----

# usual PHASE: how long a phase takes: as last time here, or some seconds of 2 processors for one that has not been run.
usual() {
    local seconds
    seconds=$(awk -v phase="$1" '$1 == phase { print $2 }' "$logs/times" 2>/dev/null)
    [ -z "$seconds" ] || { echo "$seconds"; return; }
    case $1 in
    gcc) seconds=400 ;;
    clang) seconds=130 ;;
    asan) seconds=450 ;;
    hostile) seconds=400 ;;
    tsan) seconds=130 ;;
    fuzz) seconds=170 ;;
    accuracy) seconds=60 ;;
    gl) seconds=150 ;;
    python) seconds=60 ;;
    web) seconds=240 ;;
    *) seconds=1 ;;
    esac
    [ "$jobs" -le 2 ] || seconds=$((seconds * 2 / jobs))
    [ "$jobs" -gt 1 ] || seconds=$((seconds * 2))
    echo "$seconds"
}

# note_time PHASE SECONDS: for the next time.
note_time() {
    { grep -v "^$1 " "$logs/times" 2>/dev/null; echo "$1 $2"; } >"$logs/times.new"
    mv "$logs/times.new" "$logs/times"
}

# spoken SECONDS: "12 min", or "40 s".
spoken() { if [ "$1" -lt 120 ]; then echo "$1 s"; else echo "$((($1 + 30) / 60)) min"; fi; }

# now LOG: what the phase does whose log that is: its build's last step, or how many tests are over and which began last.
now() {
    local over
    if [ ! -s "$1" ]; then
        printf 'building %s' "$(grep -aoE '^\[[^]]*\]' "$1.build" 2>/dev/null | tail -n 1)"
        return
    fi
    over=$(grep -acE '^ *[0-9]+/[0-9]+ +Test +#|^(not )?ok ' "$1")
    printf '%d tests are over, %s runs' "$over" "$(sed -n 's/^ *Start *[0-9]*: *//p;/^ok /s/.*/the next/p' "$1" | tail -n 1)"
}

# begin TITLE LOG: from now on a line every 25 s says what runs, until `end`. It shares no output with its sleep, which
# may outlive it for as long.
begin() {
    (
        start=$SECONDS
        while kill -0 $$ 2>/dev/null; do
            sleep 25 >/dev/null 2>&1 &
            wait $!
            printf '    ... %s: %s (%d s)\n' "$1" "$(now "$2")" $((SECONDS - start))
        done
    ) &
    beat=$!
}
end() {
    [ -z "$beat" ] || kill "$beat" 2>/dev/null
    wait "$beat" 2>/dev/null
    beat=
}
beat=
trap end EXIT

# ---- phases ----

# count FILE: "passed failed" of a log of `ctest -V`, whose lines begin with the test's number.
count() {
    awk '
    match($0, /^ *[0-9]+\/[0-9]+ +Test +#[0-9]+: /) { # its result
        split($0, part, "#"); id = part[2] + 0
        result[id] = ($0 ~ /\.\.\.+ +Passed +[0-9.]+ sec/) ? "passed" : "failed"
        if ($0 ~ /\*\*\*(Exception|Timeout)/) bad[id]++
        if ($0 ~ /\*\*\*Skipped/) delete result[id]
        next
    }
    match($0, /^[0-9]+: /) {
        id = $1 + 0
        text = substr($0, RLENGTH + 1)
        if (text ~ /^\[ +OK \] /) ok[id]++
        else if (text ~ /^ok /) ok[id]++
        else if (text ~ /^not ok /) bad[id]++
        else if (match(text, /^\[ +FAILED +\] [0-9]+ test\(s\)/)) { split(text, part, "]"); bad[id] += part[2] }
    }
    END {
        for (id in result) {
            good = ok[id] + 0; wrong = bad[id] + 0
            if (result[id] == "failed" && !wrong) wrong = 1
            if (result[id] == "passed" && !good) good = 1
            p += good; f += wrong
        }
        print p + 0, f + 0
    }' "$1"
}

# What the failed tests of a log printed, each at most 60 lines.
show_failures() {
    local id
    sed -n 's/^ *[0-9]*\/[0-9]* *Test *#\([0-9]*\): .*\*\*\*.*/\1/p' "$1" | while read -r id; do
        grep -E "^ *[0-9]+/[0-9]+ +Test +#$id: " "$1"
        grep "^$id: " "$1" | sed "s/^$id: /    /" | grep -Ev '^    (\[ *(OK|RUN) *\]|ok |Test command|Working Dir|Test timeout|Environment var| [AULT]+SAN_OPTIONS)' | tail -n 60
    done
}

# build NAME TARGETS: configures a preset and builds some of its targets.
build() {
    # shellcheck disable=SC2046,SC2086
    cmake --preset "$1" $([ -e "build/$1/CMakeCache.txt" ] || scripts/generator.sh) &&
        cmake --build "build/$1" --parallel "$jobs" --target $2
}

# phase NAME TITLE TARGETS CTEST-ARGUMENTS...: configures a preset, builds what its tests need, then runs them.
phase() {
    local name=$1 title=$2 targets=$3
    shift 3
    local log=$logs/$name.log start=$SECONDS good wrong
    : >"$log"
    begin "$title" "$log"
    if ! build "$name" "$targets" >"$log.build" 2>&1; then
        end
        failed=$((failed + 1))
        printf "%-${width}s" "$title"
        printf 'does not build (%s)\n' "$log.build"
        grep -E -A2 '(error|Error|warning):|undefined reference|^CMake Error' "$log.build" |
            head -n 15 | sed 's/^/    /'
        return
    fi
    ctest --test-dir "build/$name" -V --no-tests=error --parallel "$jobs" "$@" >"$log" 2>&1
    local status=$?
    end
    printf "%-${width}s" "$title"
    read -r good wrong <<<"$(count "$log")"
    if [ "$status" -ne 0 ] && [ "$wrong" -eq 0 ]; then wrong=1; fi
    passed=$((passed + good)) failed=$((failed + wrong))
    printf '%5d passed' "$good"
    [ "$wrong" -eq 0 ] || printf ', %d failed (%s)' "$wrong" "$log"
    printf '  %d s\n' $((SECONDS - start))
    if [ "$wrong" -ne 0 ]; then
        show_failures "$log" | sed 's/^/    /'
        grep -q 'Test *#' "$log" || tail -n 5 "$log" | sed 's/^/    /'
    fi
}

# Are the sources as the formatter wants them? Its versions differ in taste, so only Debian 12's is asked, where it is.
format() {
    local files
    printf "%-${width}s" "format, as clang-format 14 has it"
    if ! clang-format --version 2>/dev/null | grep -q 'version 14' || ! files=$(git ls-files '*.c' '*.h' '*.inc' 2>/dev/null); then
        echo 'skipped (there is no clang-format 14, or no git)'
        return
    fi
    # shellcheck disable=SC2086
    if clang-format --dry-run -Werror $files >"$logs/format.log" 2>&1; then
        passed=$((passed + 1))
        printf '%5d passed\n' 1
    else
        failed=$((failed + 1))
        printf '%5d failed (%s; make format)\n' 1 "$logs/format.log"
    fi
}

# Do includes between folders run one way?
structure() {
    printf "%-${width}s" "structure, as docs/architecture.md has it"
    if scripts/structure.sh >"$logs/structure.log" 2>&1; then
        passed=$((passed + 1))
        printf '%5d passed\n' 1
    else
        failed=$((failed + 1))
        printf '%5d failed\n' 1
        sed 's/^/    /' "$logs/structure.log"
    fi
}

# What OpenGL's tests lack here: headers, EGL, or a driver that needs no display. Mesa is all of these.
no_gl() {
    any '/usr/include/GL/glcorearb.h' || { echo libgl-dev; return; }
    any '/usr/include/EGL/egl.h' || { echo libegl-dev; return; }
    any '/usr/lib*/libEGL.so.1' '/usr/lib/*/libEGL.so.1' || { echo libegl1; return; }
    any '/usr/lib*/dri/swrast_dri.so' '/usr/lib/*/dri/swrast_dri.so' '/usr/lib*/libgallium*.so' \
        '/usr/lib/*/libgallium*.so' || echo libgl1-mesa-dri
}
any() { # PATTERN...: is there a file of one of these names?
    local pattern
    for pattern; do
        ! compgen -G "$pattern" >/dev/null || return 0
    done
    return 1
}
has_gl() { [ -z "$(no_gl)" ]; }

# The Python package: its wheel, of the libraries of the gcc phase, and its tests with it.
python_package() {
    local log=$logs/python.log start=$SECONDS good wrong status
    : >"$log"
    begin "Python: the wheel and its tests" "$log"
    if ! build check-gcc drypoint_io >"$log.build" 2>&1; then
        status=1
        cp "$log.build" "$log"
    else
        scripts/python.sh build/check-gcc >"$log" 2>&1
        status=$?
    fi
    end
    printf "%-${width}s" "Python: the wheel and its tests"
    if [ "$status" -eq 77 ]; then
        echo "skipped ($(tail -n 1 "$log"))"
        return
    fi
    good=$(grep -c '^ok ' "$log") wrong=$(grep -c '^not ok ' "$log")
    if [ "$status" -ne 0 ] && [ "$wrong" -eq 0 ]; then wrong=1; fi
    passed=$((passed + good)) failed=$((failed + wrong))
    printf '%5d passed' "$good"
    [ "$wrong" -eq 0 ] || printf ', %d failed (%s)' "$wrong" "$log"
    printf '  %d s\n' $((SECONDS - start))
    [ "$wrong" -eq 0 ] || grep -v '^ok ' "$log" | tail -n 60 | sed 's/^/    /'
}

# What building the page lacks here; its tests say themselves what they lack.
no_web() {
    command -v emcc >/dev/null || { echo emscripten; return; }
    command -v node >/dev/null || { echo nodejs; return; }
    command -v esbuild >/dev/null || [ -x web/node_modules/.bin/esbuild ] || echo esbuild
}

# The page for browsers: its WebAssembly and itself, then their tests, which compare with the native build.
web() {
    local title="the page for browsers, WebAssembly"
    if [ -n "$(no_web)" ]; then
        printf "%-${width}s" "$title"
        echo "skipped (no $(no_web): make setup-check installs it where it can)"
        return
    fi
    : >"$logs/web.log"
    begin "$title: its build" "$logs/web.log"
    scripts/web.sh >"$logs/web.log.build" 2>&1
    local status=$?
    end
    if [ "$status" -ne 0 ]; then
        failed=$((failed + 1))
        printf "%-${width}s" "$title"
        printf 'does not build (%s)\n' "$logs/web.log.build"
        tail -n 15 "$logs/web.log.build" | sed 's/^/    /'
        return
    fi
    phase check-gcc "$title" web_tests -L '^web$'
}

run_phase() {
    case $1 in
    format) format ;;
    structure) structure ;;
    gcc) # pictures by OpenGL are drawn under the sanitizers (gl): compiling their shaders takes long
        phase check-gcc "gcc, release, -Werror: all tests" all -E '^gl\.test_' -LE '^web$'
        ;;
    clang)
        # Another compiler may answer differently what is arithmetic: kernels, pictures, headers, and the tests that see most
        # for their time. All else is the same C as under gcc, and the sanitizers look closer; the fuzzers' files are
        # replayed there, and by clang's own fuzzers.
        phase check-clang "clang, release, -Werror" all -L 'quick|golden|header'
        ;;
    asan)
        # The hostile phase runs determinism under the same sanitizers, in tiles where more goes wrong; it is the
        # slowest of all programs, and every mode's pictures are drawn here once by the golden ones.
        # Counted bytes are the same counts as under gcc. Pairs of features are thousands of pictures; sources in
        # sources (test_wrapped, fuzz.wrapped) and each feature's own tests are drawn here.
        phase check-asan "address and undefined behaviour sanitizers" \
            "drypoint_tool unit_tests golden_tests twins_tests fuzzers" -LE 'accuracy|^gl$' \
            -E 'unit.test_(determinism|stats_bytes)|cli.pairs'
        ;;
    tsan) phase check-tsan "thread sanitizer: what runs in threads" threads_tests -L threads ;;
    hostile)
        : >"$logs/reference.log"
        begin "hostile build: its reference" "$logs/reference.log"
        build check-gcc drypoint_tool >"$logs/reference.log.build" 2>&1 # whose pictures are compared
        end
        # tests/CMakeLists.txt lists what this build leaves out
        phase check-hostile "hostile build: tiny batches, bins and tiles" "unit_tests golden_tests" -L 'unit|golden'
        ;;
    gl)
        # In the sanitizers' build, of which only these tests are built if the phase runs alone.
        if has_gl; then
            phase check-asan "OpenGL without a window, under the sanitizers" gl_tests -L '^gl$'
        else
            printf "%-${width}s" "OpenGL without a window"
            echo "skipped (no $(no_gl): make setup-check installs it where it can)"
        fi
        ;;
    web) web ;;
    python) python_package ;;
    fuzz) phase check-fuzz "fuzzers, a few seconds each" fuzzers -L fuzz ;;
    accuracy) phase check-gcc "gcc, release: accuracy tests" all -L accuracy ;;
    *)
        echo "check: unknown phase $1 (format, structure, gcc, accuracy, clang, asan, gl, python, tsan, hostile, fuzz, web)" >&2
        exit 2
        ;;
    esac
}

[ $# -gt 0 ] || set -- format structure gcc web python clang asan gl tsan hostile fuzz
total=0
for name; do total=$((total + $(usual "$name"))); done
echo "check: $*: about $(spoken $total) with $jobs processors; longer where much is to be built"
for name; do
    since=$SECONDS
    run_phase "$name"
    note_time "$name" $((SECONDS - since))
done
echo
echo "check: took $(spoken $SECONDS)"
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
