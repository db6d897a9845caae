# use_pkg_config(<prefix>): pkg-config finds the package that is installed there, before others.
function(use_pkg_config prefix)
  file(GLOB_RECURSE file ${prefix}/bumper.pc)
  get_filename_component(folder ${file} DIRECTORY)
  set(ENV{PKG_CONFIG_PATH} ${folder}:$ENV{PKG_CONFIG_PATH})
endfunction()

# compile(<program> <compiler and its flags>... SOURCE <file> MODULES <module or --static>...): as one
# does by hand, $(pkg-config --cflags --libs <module>...); what it needs shared is found from its rpath.
function(compile program)
  cmake_parse_arguments(ARG "" "SOURCE" "MODULES" ${ARGN})
  run_for(flags pkg-config --cflags --libs ${ARG_MODULES})
  run_for(libdir pkg-config --variable=libdir bumper)
  separate_arguments(flags UNIX_COMMAND "${flags}")
  run(${ARG_UNPARSED_ARGUMENTS} ${ARG_SOURCE} -o ${program} ${flags} -Wl,-rpath,${libdir})
endfunction()
