# Builds Bumper within another project as shared libraries, installs them, moves them elsewhere, looks
# at what they export, and uses them from outside by CMake and by pkg-config:
#   cmake -D GENERATOR=<generator> -D BUMPER=<source tree> -D SOURCE=<tests/consumer> -D WORK=<folder>
#         -D CXX=<compiler> -D COMPILER=<its kind> -D NM=<nm> -P run_shared.cmake
cmake_minimum_required(VERSION 3.22)
include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/pkg_config.cmake)
file(REMOVE_RECURSE ${WORK})

# Unoptimised, and several sources at a time: what is exported does not depend on it.
run(${CMAKE_COMMAND} -G ${GENERATOR} -S ${SOURCE}/embedded -B ${WORK}/build -D BUMPER=${BUMPER}
    -D BUILD_SHARED_LIBS=ON -D BUMPER_INSTALL=ON -D CMAKE_CXX_COMPILER=${CXX} -D CMAKE_UNITY_BUILD=ON
    -D CMAKE_UNITY_BUILD_BATCH_SIZE=12)
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/build/consumer)
run(${CMAKE_COMMAND} --install ${WORK}/build --prefix ${WORK}/prefix)
file(REMOVE_RECURSE ${WORK}/build)
file(RENAME ${WORK}/prefix ${WORK}/moved)

file(GLOB_RECURSE libraries ${WORK}/moved/*.so)
list(LENGTH libraries count)
if(NOT count EQUAL 4)
  message(FATAL_ERROR "installed are the shared libraries ${libraries}")
endif()
foreach(library IN LISTS libraries)
  file(READ_SYMLINK ${library} versioned)
  if(NOT versioned MATCHES "\\.so\\.[0-9]+\\.[0-9]+$")
    message(FATAL_ERROR "${library} has no version")
  endif()
endforeach()
set(LIBRARIES ${libraries})
set(HEADERS ${WORK}/moved/include ${BUMPER}/response/base/internal ${BUMPER}/scenes/src)
if(COMPILER STREQUAL "GNU")
  include(${SOURCE}/exported_symbols.cmake)
endif()

run(${CMAKE_COMMAND} -G ${GENERATOR} -S ${SOURCE}/borders -B ${WORK}/borders
    -D CMAKE_PREFIX_PATH=${WORK}/moved -D CMAKE_CXX_COMPILER=${CXX})
run(${CMAKE_COMMAND} --build ${WORK}/borders)
run(${WORK}/borders/borders)

use_pkg_config(${WORK}/moved)
compile(${WORK}/by_pkg_config ${CXX} -std=c++20 SOURCE ${SOURCE}/main.cpp MODULES bumper-engine-adapter)
run(${WORK}/by_pkg_config)
