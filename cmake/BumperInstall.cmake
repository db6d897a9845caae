# The installed package: find_package(bumper COMPONENTS response engine_adapter ...).
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/bumper)
# What a shared library needs inside is not its users' concern.
set(is_static TRUE)
if(BUILD_SHARED_LIBS)
  set(is_static FALSE)
endif()
configure_package_config_file(cmake/bumperConfig.cmake.in bumperConfig.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(bumperConfigVersion.cmake COMPATIBILITY SameMinorVersion)
# The component base, which every other one needs, brings them.
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/bumperConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/bumperConfigVersion.cmake
              cmake/FindEGL.cmake cmake/FindODE.cmake cmake/FindOSMesa.cmake DESTINATION ${package_dir}
        COMPONENT base)

# Image regression for other projects' tests.
if(TARGET bumper-compare)
  bumper_install_program(bumper-compare images EXPORT bumper_compare_target)
  install(EXPORT bumper_compare_target NAMESPACE bumper:: DESTINATION ${package_dir} COMPONENT images)
  install(FILES cmake/BumperImageTest.cmake cmake/BumperRunImageTest.cmake DESTINATION ${package_dir}
          COMPONENT images)
endif()

# The same for pkg-config: bumper-<component>.pc each, and bumper.pc for what most programs want.
file(RELATIVE_PATH libdir_from_prefix ${CMAKE_INSTALL_PREFIX} ${CMAKE_INSTALL_FULL_LIBDIR})
file(RELATIVE_PATH includedir_from_prefix ${CMAKE_INSTALL_PREFIX} ${CMAKE_INSTALL_FULL_INCLUDEDIR})
file(RELATIVE_PATH prefix_from_pc ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
string(REGEX REPLACE "/$" "" prefix_from_pc "${prefix_from_pc}")

# bumper_pkg_config(<name> <component that it is installed with> <description>), with the variables
# libs, libs_private, requires and requires_private.
function(bumper_pkg_config name component description)
  list(JOIN requires ", " requires)
  list(JOIN requires_private ", " requires_private)
  list(JOIN libs_private " " libs_private)
  set(file ${CMAKE_CURRENT_BINARY_DIR}/pkgconfig/${name}.pc)
  configure_file(cmake/bumper.pc.in ${file} @ONLY)
  install(FILES ${file} DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT ${component})
endfunction()

# bumper_modules_of(<modules> <flags> <linked target or flag>...): as pkg-config knows them.
function(bumper_modules_of modules flags)
  set(Eigen3::Eigen eigen3)
  set(ODE::ODE ode)
  set(assimp::assimp assimp)
  set(PNG::PNG libpng)
  set(OSMesa::OSMesa osmesa)
  set(EGL::EGL egl)
  set(of_modules "")
  set(of_flags "")
  foreach(linked IN LISTS ARGN)
    if(linked MATCHES "^bumper::(.*)")
      string(REPLACE _ - module ${CMAKE_MATCH_1})
      list(APPEND of_modules bumper-${module})
    elseif(linked STREQUAL "Threads::Threads")
      list(APPEND of_flags -pthread)
    elseif(linked MATCHES "^[a-z]+$")
      list(APPEND of_flags -l${linked})
    elseif(DEFINED ${linked})
      list(APPEND of_modules ${${linked}})
    elseif(NOT linked MATCHES "^\\$<")
      message(FATAL_ERROR "pkg-config's name of ${linked} is not known")
    endif()
  endforeach()
  set(${modules} "${of_modules}" PARENT_SCOPE)
  set(${flags} "${of_flags}" PARENT_SCOPE)
endfunction()

get_property(components GLOBAL PROPERTY BUMPER_COMPONENTS)
foreach(component IN LISTS components)
  get_target_property(public bumper_${component} INTERFACE_LINK_LIBRARIES)
  get_target_property(all bumper_${component} LINK_LIBRARIES)
  if(NOT public)
    set(public "")
  endif()
  if(NOT all)
    set(all "")
  endif()
  list(FILTER public EXCLUDE REGEX "^\\$<")
  list(REMOVE_ITEM all ${public} "")
  bumper_modules_of(requires flags ${public})
  bumper_modules_of(requires_private libs_private ${all})
  if(component STREQUAL "base")
    # For a linker that is called by another language's compiler.
    list(APPEND libs_private -lstdc++ -lm)
  endif()
  if(NOT is_static)
    set(requires_private "")
    set(libs_private "")
  endif()
  string(REPLACE _ - name ${component})
  set(libs "-L\${libdir} -lbumper_${component}")
  bumper_pkg_config(bumper-${name} ${component} "${PROJECT_DESCRIPTION}: ${component}")
endforeach()

set(requires bumper-scenes)
if(BUMPER_ENGINE_ADAPTER)
  set(requires bumper-engine-adapter)
endif()
set(libs "")
set(libs_private "")
set(requires_private "")
bumper_pkg_config(bumper base "${PROJECT_DESCRIPTION}")

# LICENSE, and the documents as they refer to each other.
install(FILES LICENSE CHANGELOG.md README.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT base)
foreach(folder response scenes engine_adapter render render/tools examples)
  install(FILES ${folder}/README.md DESTINATION ${CMAKE_INSTALL_DOCDIR}/${folder} COMPONENT base)
endforeach()
file(GLOB pages ${PROJECT_SOURCE_DIR}/engine_adapter/docs/*.md)
install(FILES ${pages} DESTINATION ${CMAKE_INSTALL_DOCDIR}/engine_adapter/docs COMPONENT base)
install(FILES examples/hinge2_car.cpp examples/threads.cpp examples/wall_in_c.c examples/test_rail.png
        DESTINATION ${CMAKE_INSTALL_DOCDIR}/examples COMPONENT base)
