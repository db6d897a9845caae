# The two ways a target comes to be: bumper_library() for a part of a room that applications link,
# bumper_program() for a test, benchmark or example.

include_guard()
include(CheckCXXCompilerFlag)
include(CheckLinkerFlag)

# Asked for before they are used: another compiler may lack some.
set(bumper_flags "")
foreach(
  flag
  -Wall
  -Wextra
  -Wpedantic
  -Wshadow
  -Wconversion
  -Wold-style-cast
  -Wnon-virtual-dtor
  # Same bits at every optimisation level: no fused multiply-add behind our back.
  -ffp-contract=off
  # Nobody replaces a function of ours when a program is loaded: they may be inlined.
  -fno-semantic-interposition)
  string(MAKE_C_IDENTIFIER "BUMPER_HAS${flag}" has)
  check_cxx_compiler_flag(${flag} ${has})
  if(${has})
    list(APPEND bumper_flags ${flag})
  endif()
endforeach()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # From float alone: Clang means double to long double too, which the tests' oracles are made of.
  list(APPEND bumper_flags -Wdouble-promotion)
elseif(CMAKE_CXX_FLAGS MATCHES "-fsanitize=[a-z,]*address")
  # GCC's macro, which Clang 14 lacks.
  list(APPEND bumper_flags -D__SANITIZE_ADDRESS__)
endif()

set(bumper_exported_symbols ${CMAKE_CURRENT_LIST_DIR}/exported_symbols.map)
check_linker_flag(CXX LINKER:--version-script=${bumper_exported_symbols} BUMPER_HAS_VERSION_SCRIPTS)

# The same flags for every target of ours; none of them leaks to applications.
function(bumper_target_options target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF POSITION_INDEPENDENT_CODE ON)
  # Clang hides a function that is defined where its namespace is opened anew, whatever its header says:
  # there the linker's list alone bounds what a shared library shows.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    set_target_properties(${target} PROPERTIES CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  endif()
  target_compile_options(${target} PRIVATE ${bumper_flags}
                                           $<$<BOOL:${BUMPER_WARNINGS_AS_ERRORS}>:-Werror>)
endfunction()

# Installed, libraries are found from where a program or another library is: all may be moved together.
if(BUILD_SHARED_LIBS)
  foreach(from BIN LIBEXEC)
    file(RELATIVE_PATH lib_from_${from} ${CMAKE_INSTALL_FULL_${from}DIR} ${CMAKE_INSTALL_FULL_LIBDIR})
  endforeach()
endif()

# bumper_library(<component> SOURCES <file>... [PUBLIC <target>...] [PRIVATE <target>...])
# The component's public headers are those of its own folder include/; whoever links it gets these and
# those of its PUBLIC targets. What compiling needs is installed as <component>, what running needs
# (a shared library) as <component>_runtime.
function(bumper_library component)
  cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  set(target bumper_${component})
  add_library(${target} ${ARG_SOURCES})
  add_library(bumper::${component} ALIAS ${target})
  bumper_target_options(${target})
  # Before version 1 every minor version may change what programs were compiled against.
  set_target_properties(
    ${target} PROPERTIES EXPORT_NAME ${component} VERSION ${PROJECT_VERSION}
                         SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}
                         INSTALL_RPATH $ORIGIN)
  get_target_property(type ${target} TYPE)
  if(type STREQUAL "SHARED_LIBRARY" AND BUMPER_HAS_VERSION_SCRIPTS)
    target_link_options(${target} PRIVATE LINKER:--version-script=${bumper_exported_symbols})
    set_property(TARGET ${target} APPEND PROPERTY LINK_DEPENDS ${bumper_exported_symbols})
  endif()
  target_include_directories(
    ${target} PUBLIC $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
                     $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(${target} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  set_property(GLOBAL APPEND PROPERTY BUMPER_COMPONENTS ${component})
  if(BUMPER_INSTALL)
    install(
      TARGETS ${target}
      EXPORT bumper_${component}_targets
      ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT ${component}
      LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
              COMPONENT ${component}_runtime
              NAMELINK_COMPONENT ${component})
    install(EXPORT bumper_${component}_targets NAMESPACE bumper::
            DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/bumper FILE bumper_${component}_targets.cmake
            COMPONENT ${component})
    install(DIRECTORY include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT ${component})
  endif()
endfunction()

# bumper_program(<name> SOURCES <file>... LINK <target>...)
function(bumper_program name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  # Tests repeat each other's names.
  set_target_properties(${name} PROPERTIES UNITY_BUILD OFF)
  bumper_target_options(${name})
  target_link_libraries(${name} PRIVATE ${ARG_LINK})
endfunction()

# The same for sources in C, which see what any user's strict C99 sees.
function(bumper_c_options target)
  set_target_properties(${target} PROPERTIES C_STANDARD 99 C_STANDARD_REQUIRED ON C_EXTENSIONS OFF
                                             POSITION_INDEPENDENT_CODE ON UNITY_BUILD OFF)
  target_compile_options(
    ${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wstrict-prototypes -ffp-contract=off
                      $<$<BOOL:${BUMPER_WARNINGS_AS_ERRORS}>:-Werror>)
endfunction()

# bumper_install_program(<name> <component> [LIBEXEC] [EXPORT <set>])
# For users (bin), or for libraries and programs alone (libexec).
function(bumper_install_program name component)
  cmake_parse_arguments(ARG "LIBEXEC" "EXPORT" "" ${ARGN})
  if(NOT BUMPER_INSTALL)
    return()
  endif()
  set(folder BIN)
  if(ARG_LIBEXEC)
    set(folder LIBEXEC)
  endif()
  set(export "")
  if(ARG_EXPORT)
    set(export EXPORT ${ARG_EXPORT})
  endif()
  if(BUILD_SHARED_LIBS)
    set_target_properties(${name} PROPERTIES INSTALL_RPATH $ORIGIN/${lib_from_${folder}})
  endif()
  install(TARGETS ${name} ${export} DESTINATION ${CMAKE_INSTALL_${folder}DIR} COMPONENT ${component})
endfunction()
