# The test that bumper_add_image_test() adds:
#   cmake -D COMPARE=<bumper-compare> -D OUTPUT=<png> -D GOLDEN=<png> -D OPTIONS=<of bumper-compare>
#         -P BumperRunImageTest.cmake -- <command>...
cmake_minimum_required(VERSION 3.22)

set(command "")
set(is_command FALSE)
math(EXPR last "${CMAKE_ARGC} - 1")
foreach(k RANGE ${last})
  if(is_command)
    string(REPLACE ";" "\\;" argument "${CMAKE_ARGV${k}}")
    list(APPEND command "${argument}")
  elseif(CMAKE_ARGV${k} STREQUAL "--")
    set(is_command TRUE)
  endif()
endforeach()

get_filename_component(folder ${OUTPUT} DIRECTORY)
get_filename_component(name ${OUTPUT} NAME_WLE)
set(difference ${folder}/${name}_difference.png)
file(MAKE_DIRECTORY ${folder})
# What an earlier run left counts for nothing.
file(REMOVE ${OUTPUT} ${difference})

execute_process(COMMAND ${command} RESULT_VARIABLE result)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "the command ended with ${result}: ${command}")
endif()
if(NOT EXISTS ${OUTPUT})
  message(FATAL_ERROR "the command did not write ${OUTPUT}: ${command}")
endif()

if(NOT "$ENV{BUMPER_UPDATE_GOLDEN}" STREQUAL "" AND NOT "$ENV{BUMPER_UPDATE_GOLDEN}" STREQUAL "0")
  get_filename_component(golden_folder ${GOLDEN} DIRECTORY)
  file(MAKE_DIRECTORY ${golden_folder})
  file(COPY_FILE ${OUTPUT} ${GOLDEN})
  message("golden picture written to ${GOLDEN}")
  return()
endif()
if(NOT EXISTS ${GOLDEN})
  message(FATAL_ERROR "there is no ${GOLDEN}. If ${OUTPUT} is right, run again with "
                      "BUMPER_UPDATE_GOLDEN=1.")
endif()

execute_process(COMMAND ${COMPARE} ${OUTPUT} ${GOLDEN} --diff ${difference} ${OPTIONS}
                RESULT_VARIABLE result)
if(result EQUAL 0)
  file(REMOVE ${difference})
elseif(result EQUAL 1)
  message(FATAL_ERROR "${OUTPUT} differs from ${GOLDEN}; see ${difference}. If the new picture is "
                      "right, run again with BUMPER_UPDATE_GOLDEN=1.")
else()
  message(FATAL_ERROR "${COMPARE} ended with ${result}")
endif()
