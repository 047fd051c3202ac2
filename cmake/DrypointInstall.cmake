# What `cmake --install` puts where: headers, libraries, the programs, their manual pages and completions, the viewer's
# desktop file and icon, pages to read, and what find_package(drypoint) and pkg-config need. cmake/Uninstall.cmake takes it
# away again.
include(CMakePackageConfigHelpers)

# For cmake/Uninstall.cmake, beside the manifest.
install(CODE "file(WRITE \"${PROJECT_BINARY_DIR}/install_prefix.txt\" \"\${CMAKE_INSTALL_PREFIX}\\n\")")

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/drypoint)

install(DIRECTORY include/drypoint DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")
# One export set per component, so that the core can be used where libpng and Assimp are absent.
foreach(component drypoint drypoint_io drypoint_gl)
  foreach(library ${component} ${component}_shared)
    if(TARGET ${library})
      install(TARGETS ${library} EXPORT ${component}Targets
              ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
    endif()
  endforeach()
  if(TARGET ${component})
    install(EXPORT ${component}Targets NAMESPACE drypoint:: DESTINATION ${package_dir})
  endif()
endforeach()
set_target_properties(drypoint PROPERTIES EXPORT_NAME static)
if(TARGET drypoint_shared)
  set_target_properties(drypoint_shared PROPERTIES EXPORT_NAME shared)
endif()
foreach(component io gl)
  if(TARGET drypoint_${component})
    set_target_properties(drypoint_${component} PROPERTIES EXPORT_NAME ${component}_static)
  endif()
  if(TARGET drypoint_${component}_shared)
    set_target_properties(drypoint_${component}_shared PROPERTIES EXPORT_NAME ${component}_shared)
  endif()
endforeach()

configure_package_config_file(cmake/drypointConfig.cmake.in ${PROJECT_BINARY_DIR}/cmake/drypointConfig.cmake
                              INSTALL_DESTINATION ${package_dir})
# Before 1.0 a minor version may change the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/cmake/drypointConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/cmake/drypointConfig.cmake
              ${PROJECT_BINARY_DIR}/cmake/drypointConfigVersion.cmake
              cmake/DrypointAssimp.cmake
        DESTINATION ${package_dir})

# Directories below the prefix are written relative to it, so that `pkg-config --define-prefix` works.
foreach(kind LIBDIR INCLUDEDIR)
  if(IS_ABSOLUTE "${CMAKE_INSTALL_${kind}}")
    set(pc_${kind} "${CMAKE_INSTALL_${kind}}")
  else()
    set(pc_${kind} "\${prefix}/${CMAKE_INSTALL_${kind}}")
  endif()
endforeach()
set(prefix "@prefix@") # the prefix may still change at install time: filled in then
set(pc_modules drypoint)
foreach(component io gl)
  if(TARGET drypoint_${component})
    list(APPEND pc_modules drypoint-${component})
  endif()
endforeach()
foreach(module ${pc_modules})
  configure_file(cmake/${module}.pc.in ${PROJECT_BINARY_DIR}/cmake/${module}.pc.in @ONLY)
  install(CODE "
    set(prefix \"\${CMAKE_INSTALL_PREFIX}\")
    configure_file(\"${PROJECT_BINARY_DIR}/cmake/${module}.pc.in\"
                   \"${PROJECT_BINARY_DIR}/cmake/${module}.pc\" @ONLY)")
  install(FILES ${PROJECT_BINARY_DIR}/cmake/${module}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endforeach()

foreach(program drypoint_tool drypoint_view)
  if(TARGET ${program})
    if(DRYPOINT_TOOLS_SHARED AND NOT IS_ABSOLUTE "${CMAKE_INSTALL_LIBDIR}") # found wherever the prefix is
      set_target_properties(${program} PROPERTIES INSTALL_RPATH "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")
    endif()
    install(TARGETS ${program} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  endif()
endforeach()
# Completions for shells, as the program that was just built writes them; when cross-compiling it cannot be asked.
if(TARGET drypoint_tool AND NOT CMAKE_CROSSCOMPILING)
  set(completions ${PROJECT_BINARY_DIR}/completions)
  file(MAKE_DIRECTORY ${completions})
  foreach(pair bash:drypoint zsh:_drypoint fish:drypoint.fish)
    string(REPLACE ":" ";" pair ${pair})
    list(GET pair 0 shell)
    list(GET pair 1 name)
    add_custom_command(OUTPUT ${completions}/${name} DEPENDS drypoint_tool VERBATIM
                       COMMAND drypoint_tool --completions ${shell} > ${completions}/${name})
    list(APPEND completion_files ${completions}/${name})
  endforeach()
  add_custom_target(drypoint_completions ALL DEPENDS ${completion_files})
  install(FILES ${completions}/drypoint DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
  install(FILES ${completions}/_drypoint DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions)
  install(FILES ${completions}/drypoint.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
  if(TARGET drypoint_view) # shells look for a file of that name; the scripts know it
    file(CREATE_LINK drypoint ${completions}/drypoint-view SYMBOLIC)
    file(CREATE_LINK drypoint.fish ${completions}/drypoint-view.fish SYMBOLIC)
    install(FILES ${completions}/drypoint-view DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
    install(FILES ${completions}/drypoint-view.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
  endif()
endif()
# The viewer's place among the desktop's programs.
if(TARGET drypoint_view)
  install(FILES viewer/desktop/drypoint-view.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications)
  install(FILES viewer/desktop/drypoint-view.metainfo.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/metainfo)
  install(FILES viewer/desktop/drypoint.svg DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps)
  install(FILES docs/man/drypoint-view.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
endif()
if(TARGET drypoint_tool)
  install(FILES docs/man/drypoint.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
endif()

# The pages to read, as they lie here, so that their links hold, and the programs that tests/consume builds, to copy from.
install(FILES LICENSE README.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} PATTERN man EXCLUDE)
install(DIRECTORY tests/consume/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/examples
        FILES_MATCHING PATTERN "*.c" PATTERN "find_package/CMakeLists.txt" PATTERN "add_subdirectory" EXCLUDE
        PATTERN "pkg_config" EXCLUDE)
