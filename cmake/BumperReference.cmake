# The target "reference", if Doxygen is there: the API reference, from the public headers. They are those
# that are installed.
find_package(Doxygen QUIET)
if(NOT DOXYGEN_FOUND)
  return()
endif()

set(reference_includes "")
foreach(folder response/base response scenes scenes/files engine_adapter render/images render/recording
               render/pictures render/replay)
  string(APPEND reference_includes " \\\n    \"${PROJECT_SOURCE_DIR}/${folder}/include\"")
endforeach()
configure_file(cmake/Doxyfile.in ${PROJECT_BINARY_DIR}/Doxyfile @ONLY)
add_custom_target(reference COMMAND Doxygen::doxygen ${PROJECT_BINARY_DIR}/Doxyfile
                  WORKING_DIRECTORY ${PROJECT_SOURCE_DIR} COMMENT "The API reference" VERBATIM)
