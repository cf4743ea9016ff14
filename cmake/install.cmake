# CMake package `vantage`: the planning library, without the simulator.
include(CMakePackageConfigHelpers)

get_property(targets GLOBAL PROPERTY VANTAGE_INSTALLED_TARGETS)
install(TARGETS ${targets} EXPORT vantage-targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
        COMPONENT library)
foreach(folder core geometry information control perception belief)
  install(DIRECTORY src/${folder} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/vantage
          COMPONENT library FILES_MATCHING PATTERN "*.hpp")
endforeach()
install(DIRECTORY planners DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/vantage
        COMPONENT library FILES_MATCHING PATTERN "*.hpp")

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/vantage)
install(EXPORT vantage-targets NAMESPACE vantage:: DESTINATION ${package_dir} COMPONENT library)
configure_package_config_file(cmake/vantage-config.cmake.in vantage-config.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(vantage-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/vantage-config.cmake
        ${PROJECT_BINARY_DIR}/vantage-config-version.cmake
        DESTINATION ${package_dir} COMPONENT library)

if(VANTAGE_BUILD_SIM)
  install(TARGETS vantage RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT application)
  install(DIRECTORY models/robots models/scenes DESTINATION ${CMAKE_INSTALL_DATADIR}/vantage/models
          COMPONENT application)
  install(DIRECTORY assets/episodes assets/sensors assets/studies assets/views
          DESTINATION ${CMAKE_INSTALL_DATADIR}/vantage/assets COMPONENT application)
endif()
