# drypoint::assimp, the Assimp library through its C interface. Assimp's own package files also ask for
# the libraries that it was built with, which a user of its shared library does not need.
if(NOT TARGET drypoint::assimp)
  find_path(DRYPOINT_ASSIMP_INCLUDE_DIR assimp/cimport.h)
  find_library(DRYPOINT_ASSIMP_LIBRARY assimp)
  mark_as_advanced(DRYPOINT_ASSIMP_INCLUDE_DIR DRYPOINT_ASSIMP_LIBRARY)
  if(DRYPOINT_ASSIMP_INCLUDE_DIR AND DRYPOINT_ASSIMP_LIBRARY)
    add_library(drypoint::assimp UNKNOWN IMPORTED)
    set_target_properties(drypoint::assimp PROPERTIES
      IMPORTED_LOCATION "${DRYPOINT_ASSIMP_LIBRARY}"
      INTERFACE_INCLUDE_DIRECTORIES "${DRYPOINT_ASSIMP_INCLUDE_DIR}")
  endif()
endif()
