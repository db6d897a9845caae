# Finds Mesa's offscreen renderer and gives the target OSMesa::OSMesa.
find_package(PkgConfig QUIET)
pkg_check_modules(PC_OSMESA QUIET osmesa)
find_path(OSMESA_INCLUDE_DIR GL/osmesa.h HINTS ${PC_OSMESA_INCLUDE_DIRS})
find_library(OSMESA_LIBRARY OSMesa HINTS ${PC_OSMESA_LIBRARY_DIRS})

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OSMesa REQUIRED_VARS OSMESA_LIBRARY OSMESA_INCLUDE_DIR
                                  VERSION_VAR PC_OSMESA_VERSION)
if(OSMesa_FOUND AND NOT TARGET OSMesa::OSMesa)
  add_library(OSMesa::OSMesa UNKNOWN IMPORTED)
  set_target_properties(
    OSMesa::OSMesa PROPERTIES IMPORTED_LOCATION ${OSMESA_LIBRARY}
                              INTERFACE_INCLUDE_DIRECTORIES ${OSMESA_INCLUDE_DIR})
endif()
