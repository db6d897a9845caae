# Configures projects that have Bumper's sources inside, and Bumper alone:
#   cmake -D GENERATOR=<generator> -D BUMPER=<source tree> -D SOURCE=<tests/consumer> -D WORK=<folder>
#         -P run_embedded.cmake
cmake_minimum_required(VERSION 3.22)
include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)
file(REMOVE_RECURSE ${WORK})
unset(ENV{ODE_ROOT})

# configure(<folder> <argument>...)
macro(configure folder)
  run(${CMAKE_COMMAND} -G ${GENERATOR} -S ${SOURCE}/embedded -B ${WORK}/${folder} -D BUMPER=${BUMPER} ${ARGN})
endmacro()

# Nothing of Bumper is tested or installed with a project that does not ask for it.
configure(fetched -D HOW=FetchContent)
run_for(tests ${CMAKE_CTEST_COMMAND} --test-dir ${WORK}/fetched -N)
if(NOT tests MATCHES "Total Tests: 0")
  message(FATAL_ERROR "the project has got tests:\n${tests}")
endif()
run(${CMAKE_COMMAND} --install ${WORK}/fetched --prefix ${WORK}/prefix)
file(GLOB_RECURSE installed RELATIVE ${WORK}/prefix ${WORK}/prefix/*)
if(NOT installed STREQUAL "share/bumper_embedded/CMakeLists.txt")
  message(FATAL_ERROR "with the project is installed: ${installed}")
endif()

configure(own_ode -D HOW=add_subdirectory -D OWN_ODE=ON -D CMAKE_BUILD_TYPE=Debug -D ASKED_BUILD_TYPE=Debug)

# An ODE in a place of its own, and one in single precision.
load_cache(${WORK}/fetched READ_WITH_PREFIX found_ ODE_INCLUDE_DIR ODE_LIBRARY)
get_filename_component(library ${found_ODE_LIBRARY} NAME)
file(MAKE_DIRECTORY ${WORK}/ode/include ${WORK}/ode/lib)
file(COPY ${found_ODE_INCLUDE_DIR}/ode DESTINATION ${WORK}/ode/include)
file(CREATE_LINK ${found_ODE_LIBRARY} ${WORK}/ode/lib/${library} SYMBOLIC)
configure(ode_root -D HOW=add_subdirectory -D ODE_ROOT=${WORK}/ode)
load_cache(${WORK}/ode_root READ_WITH_PREFIX rooted_ ODE_INCLUDE_DIR ODE_LIBRARY)
if(NOT rooted_ODE_INCLUDE_DIR STREQUAL "${WORK}/ode/include"
   OR NOT rooted_ODE_LIBRARY STREQUAL "${WORK}/ode/lib/${library}")
  message(FATAL_ERROR "ODE_ROOT is ${WORK}/ode, but ${rooted_ODE_LIBRARY} is taken")
endif()
file(WRITE ${WORK}/ode/include/ode/precision.h "#define dSINGLE\n")
execute_process(COMMAND ${CMAKE_COMMAND} -G ${GENERATOR} -S ${SOURCE}/embedded -B ${WORK}/single
                        -D BUMPER=${BUMPER} -D ODE_ROOT=${WORK}/ode
                RESULT_VARIABLE result OUTPUT_QUIET ERROR_VARIABLE errors)
if(result EQUAL 0 OR NOT errors MATCHES "dSINGLE")
  message(FATAL_ERROR "an ODE in single precision is taken, or refused without a word of it:\n${errors}")
endif()

# Alone Bumper is built as users want it, and each component is asked for what it needs itself.
run(${CMAKE_COMMAND} -G ${GENERATOR} -S ${BUMPER} -B ${WORK}/alone -D BUMPER_ENGINE_ADAPTER=OFF
    -D BUMPER_SCENE_FILES=OFF -D BUMPER_RECORDING=OFF -D BUMPER_IMAGES=OFF -D BUMPER_RENDER=OFF
    -D BUMPER_TOOLS=OFF -D CMAKE_DISABLE_FIND_PACKAGE_ODE=ON -D CMAKE_DISABLE_FIND_PACKAGE_GTest=ON)
load_cache(${WORK}/alone READ_WITH_PREFIX alone_ CMAKE_BUILD_TYPE)
if(NOT alone_CMAKE_BUILD_TYPE STREQUAL "Release")
  message(FATAL_ERROR "without a build type given it is '${alone_CMAKE_BUILD_TYPE}'")
endif()
