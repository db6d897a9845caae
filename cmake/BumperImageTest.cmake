# bumper_add_image_test(NAME <test> COMMAND <command>... OUTPUT <png> GOLDEN <png>
#                       [TOLERANCE <0..255>] [SMOOTHING <pixels>] [REACH <pixels>]
#                       [MOST_DIFFERING <share>] [MOST_DIFFERING_IN_TILE <share>]
#                       [WORKING_DIRECTORY <folder>])
#
# Adds a CTest test that runs a command and compares the picture that it writes with a golden one by
# bumper-compare; what is not given has that program's default. The command may begin with a target.
# OUTPUT is relative to the current binary folder, GOLDEN to the current source folder. A difference
# leaves <output's name>_difference.png beside the output. With the environment variable
# BUMPER_UPDATE_GOLDEN set (and neither empty nor 0) the picture becomes the golden one instead, and
# the test counts as skipped.

include_guard()

set(_bumper_run_image_test ${CMAKE_CURRENT_LIST_DIR}/BumperRunImageTest.cmake)

function(bumper_add_image_test)
  set(tolerances TOLERANCE SMOOTHING REACH MOST_DIFFERING MOST_DIFFERING_IN_TILE)
  cmake_parse_arguments(ARG "" "NAME;OUTPUT;GOLDEN;WORKING_DIRECTORY;${tolerances}" "COMMAND" ${ARGN})
  foreach(needed NAME COMMAND OUTPUT GOLDEN)
    if(NOT ARG_${needed})
      message(FATAL_ERROR "bumper_add_image_test: ${needed} is missing")
    endif()
  endforeach()
  if(ARG_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "bumper_add_image_test: what is ${ARG_UNPARSED_ARGUMENTS}?")
  endif()

  if(TARGET bumper-compare)
    set(compare $<TARGET_FILE:bumper-compare>)
  else()
    set(compare $<TARGET_FILE:bumper::bumper-compare>)
  endif()
  set(options "")
  foreach(tolerance IN LISTS tolerances)
    if(DEFINED ARG_${tolerance})
      string(TOLOWER ${tolerance} option)
      string(REPLACE _ - option ${option})
      list(APPEND options --${option} ${ARG_${tolerance}})
    endif()
  endforeach()
  list(POP_FRONT ARG_COMMAND program)
  if(TARGET ${program})
    set(program $<TARGET_FILE:${program}>)
  endif()
  if(NOT ARG_WORKING_DIRECTORY)
    set(ARG_WORKING_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR})
  endif()
  get_filename_component(output ${ARG_OUTPUT} ABSOLUTE BASE_DIR ${CMAKE_CURRENT_BINARY_DIR})
  get_filename_component(golden ${ARG_GOLDEN} ABSOLUTE BASE_DIR ${CMAKE_CURRENT_SOURCE_DIR})

  add_test(NAME ${ARG_NAME}
           COMMAND ${CMAKE_COMMAND} -D COMPARE=${compare} -D OUTPUT=${output} -D GOLDEN=${golden}
                   "-DOPTIONS=${options}" -P ${_bumper_run_image_test} -- ${program} ${ARG_COMMAND}
           WORKING_DIRECTORY ${ARG_WORKING_DIRECTORY})
  set_tests_properties(${ARG_NAME} PROPERTIES SKIP_REGULAR_EXPRESSION "golden picture written to")
endfunction()
