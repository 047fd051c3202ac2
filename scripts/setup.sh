#!/bin/sh
# setup.sh [build|check|web|deb]: installs what is missing to build, or also to run all checks; or to build the page
# for browsers; or to build Debian packages.
#
# What is there is found by trying it, so nothing is asked of apt on a machine that has everything. The
# rest comes from Debian's packages, with sudo when not root. What can be done without is installed if that works.
set -eu

have() { command -v "$1" >/dev/null 2>&1; }
module() { have pkg-config && pkg-config --exists "$1" 2>/dev/null; }
recent_cmake() {
    have cmake || return 1
    version=$(cmake --version | sed -n 's/^cmake version \([0-9]*\)\.\([0-9]*\).*/\1 \2/p')
    # shellcheck disable=SC2086
    set -- $version
    [ "$1" -gt 3 ] || { [ "$1" -eq 3 ] && [ "$2" -ge 21 ]; }
}
fuzzer_runtime() {
    have clang || return 1
    echo 'int LLVMFuzzerTestOneInput(const char *d, long n) { return d && n < 0; }' |
        clang -fsanitize=fuzzer,address,undefined -x c - -o /dev/null 2>/dev/null
}
ezdxf() { /usr/bin/python3 -c 'import ezdxf' 2>/dev/null; }
python() { /usr/bin/python3 -c "import $1" 2>/dev/null; }
numpy() { python numpy; }
# The compiler-rt package carries the version of clang that the distribution calls its own.
compiler_rt() {
    version=$(apt-cache depends clang 2>/dev/null | sed -n 's/.*Depends: clang-\([0-9]*\)$/\1/p' | head -n 1)
    echo "libclang-rt-${version:-14}-dev"
}

header() { have cc && echo "#include <$1>" | cc -E -x c - >/dev/null 2>&1; }
loadable() { [ -n "$(find /usr/lib /usr/lib64 /usr/local/lib -name "$1" -print -quit 2>/dev/null)" ]; }

# Without these a component, or its tests, is left out, and all else goes on. Each group is installed by itself.
# gl: drawing by OpenGL (its headers, 1 MB; a way to it without a window and drivers, 25 MB, and 120 MB of LLVM for them), the
# viewer (GLFW 1 MB, Dear ImGui 4 MB), tests of its window, and programs under libdrypoint-preload.so (hacks to draw: 8 MB,
# 20 MB unpacked). web: the page's WebAssembly (112 MB, 842 MB unpacked) and scripts. browser: Chromium for its tests
# (124 MB, 414 MB unpacked). py: the Python package and its tests (5 MB, 29 MB unpacked).
find_optional() {
    gl='' web='' browser='' py=''
    case $kind in
    build | check) find_gl ;;
    web) find_browser ;;
    esac
    [ "$kind" = check ] || return 0
    find_web
    web=$missing_web
    find_browser
    find_python
}

find_gl() {
    header GL/glcorearb.h || gl="$gl libgl-dev"
    loadable libEGL.so.1 || gl="$gl libegl1"
    { loadable swrast_dri.so || loadable 'libgallium*.so'; } || gl="$gl libgl1-mesa-dri"
    module glfw3 || gl="$gl libglfw3-dev"
    module imgui || gl="$gl libimgui-dev"
    [ "$kind" = check ] || return 0
    header EGL/egl.h || gl="$gl libegl-dev"
    header X11/Xlib.h || gl="$gl libx11-dev"
    have Xvfb || gl="$gl xvfb xauth" # a screen nobody sees
    have xdotool || gl="$gl xdotool"
    have import || gl="$gl imagemagick"
    have glxgears || gl="$gl mesa-utils"
    [ -x /usr/libexec/xscreensaver/gears ] || [ -x /usr/lib/xscreensaver/gears ] || gl="$gl xscreensaver-gl"
}

# What builds the page.
find_web() {
    missing_web=
    have emcc || missing_web="$missing_web emscripten"
    have node || missing_web="$missing_web nodejs"
    { have esbuild || [ -x "$here/web/node_modules/.bin/esbuild" ]; } || missing_web="$missing_web esbuild"
}

# What tests it, and fetches the packages of its tests and of its optional parts.
find_browser() {
    have npm || [ -d "$here/web/node_modules" ] || browser="$browser npm"
    have chromium || [ -n "${CHROMIUM:-}" ] || browser="$browser chromium"
}

find_python() {
    python cffi || py="$py python3-cffi"
    python setuptools || py="$py python3-setuptools"
    python wheel || py="$py python3-wheel"
    python build || py="$py python3-build"
    python ensurepip || py="$py python3-venv"
    python "sysconfig, os, sys; sys.exit(not os.path.exists(sysconfig.get_paths()['include'] + '/Python.h'))" || py="$py python3-dev"
}

# What debian/control says that the packages are built with, and is not here, without versions.
unmet() {
    if have dpkg-checkbuilddeps; then
        dpkg-checkbuilddeps debian/control 2>&1 | sed -n 's/.*[Uu]nmet build dependencies: //p'
    else
        sed -n '/^Build-Depends:/,/^$/{s/^Build-Depends://;p;}' debian/control | tr ',' ' '
    fi | sed 's/([^)]*)//g'
}
find_for_deb() {
    have dpkg-buildpackage || missing="$missing build-essential"
    have dh || missing="$missing debhelper"
    have lintian || missing="$missing lintian"
    for package in $(unmet); do
        case " $missing " in *" $package "*) ;; *) missing="$missing $package" ;; esac
    done
}

find_missing() {
    missing=
    [ "$kind" != deb ] || { find_for_deb; return; }
    if [ "$kind" = web ]; then
        recent_cmake || missing="$missing cmake"
        have ninja || missing="$missing ninja-build"
        find_web
        missing=$missing$missing_web
        return
    fi
    { have cc && have c++ && have make; } || missing="$missing build-essential"
    recent_cmake || missing="$missing cmake"
    have ninja || missing="$missing ninja-build"
    have pkg-config || missing="$missing pkg-config"
    module libpng || missing="$missing libpng-dev"
    module zlib || missing="$missing zlib1g-dev"
    module assimp || missing="$missing libassimp-dev"
    [ "$kind" = check ] || return 0
    module cmocka || missing="$missing libcmocka-dev"
    have clang || missing="$missing clang"
    have clang-format || missing="$missing clang-format"
    have zsh || missing="$missing zsh" # these try their completions
    have fish || missing="$missing fish"
    [ -e /usr/share/i18n/locales/de_DE ] || missing="$missing locales" # a test makes one with a decimal comma
    have xmllint || missing="$missing libxml2-utils" # these look at pages as others do
    have rsvg-convert || missing="$missing librsvg2-bin"
    have pdftoppm || missing="$missing poppler-utils"
    have qpdf || missing="$missing qpdf"
    have gs || missing="$missing ghostscript"
    ezdxf || missing="$missing python3-ezdxf"
    numpy || missing="$missing python3-numpy"
    [ -d /usr/share/assimp/models ] || missing="$missing assimp-testmodels" # some of them move
    fuzzer_runtime || missing="$missing $(compiler_rt)"
}

kind=${1:-build}
case $kind in
build | check | web | deb) ;;
*)
    echo "setup: there is no $kind to set up for: build, check, web, deb" >&2
    exit 2
    ;;
esac
find_missing
find_optional
optional=$gl$web$browser$py
[ -n "$missing$optional" ] || exit 0

if ! have apt-get; then
    [ -z "$optional" ] || echo "setup: components or tests that can be left out lack what these Debian packages hold:$optional" >&2
    [ -n "$missing" ] || exit 0
    echo "setup: this machine lacks what these Debian packages hold:$missing" >&2
    echo "setup: there is no apt-get here; install the same by its own package manager." >&2
    exit 1
fi
root=
if [ "$(id -u)" -ne 0 ]; then
    if ! have sudo; then
        echo "setup: as root, please run: apt-get install$missing$optional" >&2
        [ -n "$missing" ] || exit 0
        exit 1
    fi
    root="sudo"
    [ -t 0 ] || root="sudo -n" # nobody there to give a password
fi
apt() { $root env DEBIAN_FRONTEND=noninteractive apt-get -q -y -o Dpkg::Use-Pty=0 "$@"; }

log=$(mktemp)
trap 'rm -f "$log"' EXIT
echo "setup: reading the package lists${root:+, as root through sudo}"
apt update >"$log" 2>&1 || {
    echo "setup: apt-get update failed; going on with the lists that are here" >&2
    tail -n 3 "$log" >&2
}
find_missing # the lists may name another compiler-rt
# install_optional WHAT PACKAGES: what goes without them if that fails.
install_optional() {
    [ -n "$2" ] || return 0
    echo "setup: installing$2${root:+, as root through sudo}"
    # shellcheck disable=SC2086
    apt install --no-install-recommends $2 >"$log" 2>&1 || echo "setup: that did not work; left out: $1" >&2
}
install_optional "drawing by OpenGL, the viewer or their tests" "$gl"
install_optional "the page for browsers" "$web"
install_optional "the page's tests in a browser" "$browser"
install_optional "the Python package or its tests" "$py"
[ -n "$missing" ] || exit 0
echo "setup: installing$missing${root:+, as root through sudo}"
# shellcheck disable=SC2086
if ! apt install --no-install-recommends $missing >"$log" 2>&1; then
    tail -n 20 "$log" >&2
    echo "setup: that did not work. As root, please run: apt-get install$missing" >&2
    exit 1
fi

find_missing
if [ -n "$missing" ]; then
    echo "setup: still missing after the installation:$missing" >&2
    exit 1
fi
