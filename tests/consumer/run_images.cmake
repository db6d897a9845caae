# Installs the component images with what it needs, sees that no other component's headers come with
# it, and builds and runs tests/consumer/images against it:
#   cmake -D BUILD=<build tree> -D GENERATOR=<its generator> -D SOURCE=<tests/consumer> -D WORK=<folder>
#         -P run_images.cmake
include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)
file(REMOVE_RECURSE ${WORK})

foreach(component IN ITEMS base images)
  run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix --component ${component})
endforeach()
file(GLOB_RECURSE headers RELATIVE ${WORK}/prefix/include ${WORK}/prefix/include/*)
set(expected bumper/base/api.h bumper/render/golden_image.h bumper/render/image.h bumper/render/image_compare.h
             bumper/render/image_matcher.h bumper/response/error.h)
if(NOT headers STREQUAL expected)
  message(FATAL_ERROR "base and images install the headers\n  ${headers}\ninstead of\n  ${expected}")
endif()

file(COPY ${SOURCE}/images/ DESTINATION ${WORK}/source)
run(${CMAKE_COMMAND} -G ${GENERATOR} -S ${WORK}/source -B ${WORK}/build -D CMAKE_PREFIX_PATH=${WORK}/prefix
    -D CMAKE_BUILD_TYPE=Release)
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${CMAKE_COMMAND} -E chdir ${WORK}/build ${WORK}/build/stripes 0 ${WORK}/source/golden.png)
run(${CMAKE_CTEST_COMMAND} --test-dir ${WORK}/build -R same --output-on-failure)
execute_process(COMMAND ${CMAKE_CTEST_COMMAND} --test-dir ${WORK}/build -R moved
                RESULT_VARIABLE result OUTPUT_QUIET ERROR_QUIET)
if(result EQUAL 0 OR NOT EXISTS ${WORK}/build/moved_difference.png)
  message(FATAL_ERROR "stripes that moved by a pixel pass for the golden ones")
endif()
