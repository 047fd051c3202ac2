# The toolchain of the presets `web` and `web-threads`: Emscripten's own, wherever it is installed.
#
# It is looked for in $EMSDK and $EMSCRIPTEN, beside the `emcc` of the path, and where Debian has it. Debian's emcc
# links only if Node finds Debian's modules, which another Node than Debian's does not look for: so links are
# started with NODE_PATH set. EM_CACHE must not be set: all system libraries are in the package, and no other
# place has them.
if(NOT DRYPOINT_EMSCRIPTEN_FILE)
  find_program(DRYPOINT_EMCC emcc)
  set(places "$ENV{EMSDK}/upstream/emscripten" "$ENV{EMSCRIPTEN}" /usr/share/emscripten)
  if(DRYPOINT_EMCC)
    file(REAL_PATH "${DRYPOINT_EMCC}" beside)
    get_filename_component(beside "${beside}" DIRECTORY)
    list(INSERT places 2 "${beside}" "${beside}/../libexec")
  endif()
  find_file(DRYPOINT_EMSCRIPTEN_FILE Emscripten.cmake
            PATHS ${places} PATH_SUFFIXES cmake/Modules/Platform NO_DEFAULT_PATH NO_CMAKE_FIND_ROOT_PATH)
endif()
if(NOT DRYPOINT_EMSCRIPTEN_FILE)
  message(FATAL_ERROR "Emscripten not found: install it (Debian: emscripten), or set EMSDK or EMSCRIPTEN.")
endif()

set(debian_modules /usr/share/nodejs)
if(NOT DEFINED ENV{NODE_PATH} AND EXISTS ${debian_modules}/acorn)
  set(ENV{NODE_PATH} ${debian_modules})
  set(CMAKE_C_LINKER_LAUNCHER ${CMAKE_COMMAND} -E env NODE_PATH=${debian_modules})
elseif(DEFINED ENV{NODE_PATH})
  set(CMAKE_C_LINKER_LAUNCHER ${CMAKE_COMMAND} -E env NODE_PATH=$ENV{NODE_PATH})
endif()
include(${DRYPOINT_EMSCRIPTEN_FILE})
