# Finds the Open Dynamics Engine through pkg-config and gives the target ODE::ODE.
# Bumper works in double precision, and so must the ODE it is built with.
find_package(PkgConfig QUIET)
pkg_check_modules(PC_ODE QUIET ode)
pkg_get_variable(ODE_PRECISION ode precision)
find_path(ODE_INCLUDE_DIR ode/ode.h HINTS ${PC_ODE_INCLUDE_DIRS})
find_library(ODE_LIBRARY ode HINTS ${PC_ODE_LIBRARY_DIRS})

if(ODE_LIBRARY AND NOT ODE_PRECISION STREQUAL "dDOUBLE")
  set(ODE_LIBRARY ODE_LIBRARY-NOTFOUND)
  set(reason REASON_FAILURE_MESSAGE "this ODE is built in '${ODE_PRECISION}', bumper needs dDOUBLE")
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(ODE REQUIRED_VARS ODE_LIBRARY ODE_INCLUDE_DIR
                                  VERSION_VAR PC_ODE_VERSION ${reason})
if(ODE_FOUND AND NOT TARGET ODE::ODE)
  add_library(ODE::ODE UNKNOWN IMPORTED)
  set_target_properties(
    ODE::ODE PROPERTIES IMPORTED_LOCATION ${ODE_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES
                                                         ${ODE_INCLUDE_DIR})
endif()
