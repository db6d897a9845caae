# Installs the build tree into an empty prefix and moves that elsewhere, then builds and runs the
# consumers against it, by CMake and by pkg-config:
#   cmake -D BUILD=<build tree> -D GENERATOR=<its generator> -D SOURCE=<tests/consumer> -D WORK=<folder>
#         -D CXX=<compiler> -D CC=<compiler of C> -D PICTURES=<whether the package has the component pictures>
#         -P run_consumer.cmake
cmake_minimum_required(VERSION 3.22)
include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/pkg_config.cmake)
file(REMOVE_RECURSE ${WORK})

run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
file(RENAME ${WORK}/prefix ${WORK}/moved)

# What a header does not mark, a shared library hides.
file(GLOB_RECURSE headers ${WORK}/moved/include/*.h)
foreach(header IN LISTS headers)
  file(STRINGS ${header} unmarked REGEX "^namespace bumper")
  if(unmarked)
    message(FATAL_ERROR "${header} opens its namespace without BUMPER_API")
  endif()
endforeach()
run(${CMAKE_COMMAND} -G ${GENERATOR} -S ${SOURCE} -B ${WORK}/build -D CMAKE_PREFIX_PATH=${WORK}/moved
    -D CMAKE_BUILD_TYPE=Release)
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/build/consumer)

use_pkg_config(${WORK}/moved)
compile(${WORK}/by_pkg_config ${CXX} -std=c++20 SOURCE ${SOURCE}/main.cpp MODULES bumper-engine-adapter --static)
run(${WORK}/by_pkg_config)

include(${SOURCE}/trials/trials.cmake)

# Each module names all that its library needs: the whole of it is linked.
file(WRITE ${WORK}/nothing.cpp "int main() {}\n")
file(GLOB_RECURSE modules ${WORK}/moved/bumper-*.pc)
foreach(module IN LISTS modules)
  get_filename_component(name ${module} NAME_WE)
  run_for(library pkg-config --libs-only-l ${name})
  string(REGEX MATCH "-lbumper_[a-z_]+" library "${library}")
  run_for(flags pkg-config --libs --static ${name})
  separate_arguments(flags UNIX_COMMAND "${flags}")
  run_for(libdir pkg-config --variable=libdir bumper)
  run(${CXX} ${WORK}/nothing.cpp -o ${WORK}/nothing -L${libdir} -Wl,--whole-archive ${library}
      -Wl,--no-whole-archive ${flags})
endforeach()

if(PICTURES)
  run(${CMAKE_COMMAND} -D PREFIX=${WORK}/moved -D GENERATOR=${GENERATOR} -D SOURCE=${SOURCE}/pictures
      -D WORK=${WORK}/pictures -P ${SOURCE}/run_pictures.cmake)
endif()
