# Installs the tools and what they need into another prefix than was configured, moves it as a whole,
# and sees that they find the program that reads scenes for them, also when called by a link:
#   cmake -D BUILD=<build tree> -D WORK=<folder> -D BIN=<CMAKE_INSTALL_BINDIR> -P run_tools.cmake
include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)
file(REMOVE_RECURSE ${WORK})
unset(ENV{BUMPER_READ_SCENE})
set(ENV{MESA_SHADER_CACHE_DISABLE} true)

foreach(component IN ITEMS scene_files_runtime tools)
  run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix --component ${component})
endforeach()
file(MAKE_DIRECTORY ${WORK}/links)
file(WRITE ${WORK}/yard.obj "v -9 -9 0\nv 9 -9 0\nv 9 9 0\nv -9 9 0\nv -9 9 1\nf 1 2 3 4\nf 3 4 5\n")
set(drive ${WORK}/yard.obj --up z --duration 0.01 --out ${WORK}/out)

file(RENAME ${WORK}/prefix ${WORK}/moved)
run(${WORK}/moved/${BIN}/bumper-drive ${drive})
file(CREATE_LINK ${WORK}/moved/${BIN}/bumper-drive ${WORK}/links/bumper-drive SYMBOLIC)
run(${WORK}/links/bumper-drive ${drive})
run(${WORK}/moved/${BIN}/bumper-replay glb ${WORK}/out/run.jsonl ${WORK}/out/run.glb)
