# Installs the build tree into an empty prefix, then builds and runs the consumers against it.
#   cmake -D BUILD=<build tree> -D GENERATOR=<its generator> -D SOURCE=<tests/consumer> -D WORK=<folder>
#         -D PICTURES=<whether the package has the component pictures> -P run_consumer.cmake
include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)
file(REMOVE_RECURSE ${WORK})

run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
run(${CMAKE_COMMAND} -G ${GENERATOR} -S ${SOURCE} -B ${WORK}/build -D CMAKE_PREFIX_PATH=${WORK}/prefix
    -D CMAKE_BUILD_TYPE=Release)
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/build/consumer)

if(PICTURES)
  run(${CMAKE_COMMAND} -D PREFIX=${WORK}/prefix -D GENERATOR=${GENERATOR} -D SOURCE=${SOURCE}/pictures
      -D WORK=${WORK}/pictures -P ${SOURCE}/run_pictures.cmake)
endif()
