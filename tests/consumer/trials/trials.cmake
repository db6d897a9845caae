# Included: what the README says, done by a new user of the package in ${WORK}/moved, outside of all of
# Bumper's folders.

# most(<file> <lines>): that it takes so few.
function(most file lines)
  file(STRINGS ${file} text)
  list(LENGTH text count)
  if(count GREATER lines)
    message(FATAL_ERROR "${file} has ${count} lines, not ${lines}")
  endif()
endfunction()

# A program of sixty lines, with five of CMake, and in C by pkg-config.
most(${SOURCE}/trials/cmake/game.cpp 60)
most(${SOURCE}/trials/cmake/CMakeLists.txt 5)
most(${SOURCE}/trials/game.c 60)
file(COPY ${SOURCE}/trials DESTINATION ${WORK})
run(${CMAKE_COMMAND} -G ${GENERATOR} -S ${WORK}/trials/cmake -B ${WORK}/trials/build
    -D CMAKE_PREFIX_PATH=${WORK}/moved)
run(${CMAKE_COMMAND} --build ${WORK}/trials/build)
run(${WORK}/trials/build/game)
compile(${WORK}/trials/game_in_c ${CC} -std=c99 -Wall -Wextra -Wpedantic -Werror SOURCE ${WORK}/trials/game.c
        MODULES bumper --static)
run(${WORK}/trials/game_in_c)

# The program of engine_adapter/docs/embedding.md.
file(COPY ${SOURCE}/../../examples/hinge2_car.cpp DESTINATION ${WORK}/trials/hinge2_car)
run(${CMAKE_COMMAND} -G ${GENERATOR} -S ${WORK}/trials/hinge2_car -B ${WORK}/trials/hinge2_car/build
    -D CMAKE_PREFIX_PATH=${WORK}/moved)
run(${CMAKE_COMMAND} --build ${WORK}/trials/hinge2_car/build)
run(${WORK}/trials/hinge2_car/build/hinge2_car ${WORK}/trials/hinge2_car.jsonl)

# ODE's buggy gets Bumper by twelve lines, and moves as before while no wall is near.
file(READ ${SOURCE}/trials/buggy.cpp text)
string(REPLACE ";" "" text "${text}")
string(REGEX MATCHALL "#ifdef BUMPER\n[^#]*(#include[^#]*)?#endif" parts "${text}")
list(JOIN parts "" parts)
string(REGEX REPLACE "#(ifdef BUMPER|endif)\n?" "" parts "${parts}")
string(REGEX MATCHALL "\n" added "${parts}")
list(LENGTH added count)
if(count EQUAL 0 OR count GREATER 12)
  message(FATAL_ERROR "the buggy gets Bumper by ${count} lines")
endif()
message(STATUS "the buggy gets Bumper by ${count} lines")
set(buggy ${WORK}/trials/buggy)
compile(${buggy} ${CXX} -std=c++20 SOURCE ${WORK}/trials/buggy.cpp MODULES ode)
compile(${buggy}_bumper ${CXX} -std=c++20 -DBUMPER SOURCE ${WORK}/trials/buggy.cpp MODULES bumper --static)
# same(<variable> <wall, m> <steps>): whether both move alike.
function(same variable)
  run_for(plain ${buggy} ${ARGN})
  run_for(answered ${buggy}_bumper ${ARGN})
  set(${variable} FALSE PARENT_SCOPE)
  if(plain STREQUAL answered)
    set(${variable} TRUE PARENT_SCOPE)
  endif()
endfunction()
same(far 1000 400)
same(before 8 200)
same(after 8 400)
if(NOT far OR NOT before OR after)
  message(FATAL_ERROR "Bumper moves the buggy: far from the wall (same: ${far}), before it (${before}), at it (${after})")
endif()
