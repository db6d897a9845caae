# Gives the target ODE::ODE, the Open Dynamics Engine: the one that the project has already, or what
# is found in ODE_ROOT, the usual places or through pkg-config.
# Bumper works in double precision, and so must the ODE it is built with.
if(TARGET ODE::ODE)
  set(ODE_FOUND TRUE)
  return()
endif()

find_package(PkgConfig QUIET)
if(PKG_CONFIG_FOUND)
  pkg_check_modules(PC_ODE QUIET ode)
endif()
find_path(ODE_INCLUDE_DIR ode/ode.h HINTS ${PC_ODE_INCLUDE_DIRS})
find_library(ODE_LIBRARY ode HINTS ${PC_ODE_LIBRARY_DIRS})

# What ODE was built in stands last in the header that chooses.
set(ODE_PRECISION "")
if(ODE_INCLUDE_DIR AND EXISTS ${ODE_INCLUDE_DIR}/ode/precision.h)
  file(STRINGS ${ODE_INCLUDE_DIR}/ode/precision.h precisions REGEX "define d(SINGLE|DOUBLE)")
  list(POP_BACK precisions ODE_PRECISION)
  string(REGEX REPLACE ".*define " "" ODE_PRECISION "${ODE_PRECISION}")
endif()
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
