# run(<command>...): runs it; a failure ends the script, with what the command printed.
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result OUTPUT_VARIABLE out ERROR_VARIABLE out)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${ARGV} failed (${result}):\n${out}")
  endif()
endfunction()

# run_for(<variable> <command>...): the same; the variable gets what the command printed.
function(run_for variable)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE out ERROR_VARIABLE errors
                  OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${ARGN} failed (${result}):\n${out}${errors}")
  endif()
  set(${variable} "${out}" PARENT_SCOPE)
endfunction()
