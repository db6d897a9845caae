# Builds the image regression of tests/consumer/pictures against an installed package, makes its
# golden pictures by the environment variable, and sees them kept and missed:
#   cmake -D PREFIX=<installed package> -D GENERATOR=<generator> -D SOURCE=<tests/consumer/pictures>
#         -D WORK=<folder> -P run_pictures.cmake
include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)
file(REMOVE_RECURSE ${WORK})
file(COPY ${SOURCE}/ DESTINATION ${WORK}/source)
set(ENV{MESA_SHADER_CACHE_DISABLE} true)

set(differences ${WORK}/build/golden_differences/matcher_difference.png ${WORK}/build/out/run_difference.png)

# expect(<true or false> <VARIABLE=value>...): whether both tests pass with these variables set, and
# leave a difference picture if they do not.
function(expect passing)
  foreach(test matcher program)
    execute_process(COMMAND ${CMAKE_COMMAND} -E env ${ARGN}
                            ${CMAKE_CTEST_COMMAND} -R "^${test}$" --output-on-failure
                    WORKING_DIRECTORY ${WORK}/build RESULT_VARIABLE result OUTPUT_VARIABLE out
                    ERROR_VARIABLE out)
    if(passing AND NOT result EQUAL 0)
      message(FATAL_ERROR "'${test}' fails with '${ARGN}':\n${out}")
    elseif(NOT passing AND result EQUAL 0)
      message(FATAL_ERROR "'${test}' passes with '${ARGN}':\n${out}")
    endif()
  endforeach()
  foreach(picture IN LISTS differences)
    if(passing AND EXISTS ${picture})
      message(FATAL_ERROR "${picture} is left by a test that passed with '${ARGN}'")
    elseif(NOT passing AND NOT EXISTS ${picture})
      message(FATAL_ERROR "${picture} is missing after a test that failed with '${ARGN}'")
    endif()
  endforeach()
endfunction()

run(${CMAKE_COMMAND} -G ${GENERATOR} -S ${WORK}/source -B ${WORK}/build -D CMAKE_PREFIX_PATH=${PREFIX}
    -D CMAKE_BUILD_TYPE=Release)
run(${CMAKE_COMMAND} --build ${WORK}/build)

execute_process(COMMAND ${CMAKE_CTEST_COMMAND} WORKING_DIRECTORY ${WORK}/build RESULT_VARIABLE result
                OUTPUT_QUIET ERROR_QUIET)
if(result EQUAL 0)
  message(FATAL_ERROR "tests pass without golden pictures")
endif()
expect(TRUE BUMPER_UPDATE_GOLDEN=1)
foreach(picture ${WORK}/source/golden/program.png ${WORK}/source/golden/matcher.png)
  if(NOT EXISTS ${picture})
    message(FATAL_ERROR "the golden picture ${picture} was not written")
  endif()
endforeach()
expect(TRUE)
expect(TRUE LP_NATIVE_VECTOR_WIDTH=128)
expect(TRUE LP_NUM_THREADS=0)
expect(FALSE BREAK=wall)
expect(FALSE BREAK=turn)
expect(FALSE BREAK=mark)
expect(TRUE)
