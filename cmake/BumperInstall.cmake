# The installed package: find_package(bumper COMPONENTS response engine_adapter ...).
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/bumper)
configure_package_config_file(cmake/bumperConfig.cmake.in bumperConfig.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(bumperConfigVersion.cmake COMPATIBILITY SameMinorVersion)
# The component base, which every other one needs, brings them.
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/bumperConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/bumperConfigVersion.cmake
              cmake/FindEGL.cmake cmake/FindODE.cmake cmake/FindOSMesa.cmake DESTINATION ${package_dir}
        COMPONENT base)

# Image regression for other projects' tests.
if(BUMPER_IMAGES)
  install(TARGETS bumper-compare EXPORT bumper_compare_target COMPONENT images)
  install(EXPORT bumper_compare_target NAMESPACE bumper:: DESTINATION ${package_dir} COMPONENT images)
  install(FILES cmake/BumperImageTest.cmake cmake/BumperRunImageTest.cmake DESTINATION ${package_dir}
          COMPONENT images)
endif()
