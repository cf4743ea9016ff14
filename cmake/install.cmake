# CMake package `vantage`: the planning library, without the simulator, in components.
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/vantage)

# vantage_component(NAME TARGETS ... [ON COMPONENTS...] [PACKAGES ...]): what find_package(vantage
# COMPONENTS NAME) brings, the components below that it stands on, and the packages that its targets
# link, their PRIVATE ones too: a static library hands those on to whoever links it.
function(vantage_component name)
  cmake_parse_arguments(ARG "" "" "TARGETS;ON;PACKAGES" ${ARGN})
  list(TRANSFORM ARG_TARGETS PREPEND vantage_)
  install(TARGETS ${ARG_TARGETS} EXPORT vantage-${name} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
          COMPONENT library)
  install(EXPORT vantage-${name} NAMESPACE vantage:: FILE vantage-${name}-targets.cmake
          DESTINATION ${package_dir} COMPONENT library)
  set_property(GLOBAL APPEND PROPERTY VANTAGE_COMPONENT_TARGETS ${ARG_TARGETS})
  set_property(GLOBAL APPEND PROPERTY VANTAGE_COMPONENTS ${name})
  set_property(GLOBAL APPEND_STRING PROPERTY VANTAGE_COMPONENT_NEEDS
               "set(_vantage_${name}_on ${ARG_ON})\nset(_vantage_${name}_packages \"${ARG_PACKAGES}\")\n")
endfunction()

# Bottom to top.
vantage_component(core TARGETS core PACKAGES fmt spdlog yaml-cpp)
vantage_component(geometry TARGETS geometry ON core PACKAGES "Eigen3 3.4")
vantage_component(information TARGETS information ON core PACKAGES "Eigen3 3.4" fmt)
vantage_component(control TARGETS control ON geometry PACKAGES fmt)
vantage_component(belief TARGETS belief_map belief_observation belief_objects belief_tracking belief ON information geometry
                  PACKAGES fmt octomap Threads)
vantage_component(trajectory TARGETS trajectory_optimisers trajectory ON belief control PACKAGES fmt)
vantage_component(planners
                  TARGETS visibility gains view_gains views tours choice navigation travel object_planning planners
                  ON trajectory PACKAGES fmt Threads)
if(VANTAGE_BUILD_PERCEPTION)
  vantage_component(perception
                    TARGETS clouds images perception perception_search perception_clutter feature_kit patch_features features ON information geometry
                    PACKAGES fmt nanoflann "OpenCV COMPONENTS core imgproc imgcodecs features2d dnn")
endif()

get_property(left_over GLOBAL PROPERTY VANTAGE_INSTALLED_TARGETS)
get_property(component_targets GLOBAL PROPERTY VANTAGE_COMPONENT_TARGETS)
list(REMOVE_ITEM left_over ${component_targets})
if(left_over)
  message(FATAL_ERROR "in no component of the package, nor NOT_INSTALLED: ${left_over}")
endif()

set(installed_folders core geometry information control belief)
if(VANTAGE_BUILD_PERCEPTION)
  list(APPEND installed_folders perception)
endif()
# Headers with images of OpenCV are for the sources of perception alone.
foreach(folder IN LISTS installed_folders)
  install(DIRECTORY src/${folder} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/vantage
          COMPONENT library FILES_MATCHING PATTERN "*.hpp"
          REGEX "/(column_cut|depth_pieces)\\.hpp$" EXCLUDE)
endforeach()
install(DIRECTORY planners DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/vantage
        COMPONENT library FILES_MATCHING PATTERN "*.hpp")

get_property(VANTAGE_COMPONENTS GLOBAL PROPERTY VANTAGE_COMPONENTS)
get_property(VANTAGE_COMPONENT_NEEDS GLOBAL PROPERTY VANTAGE_COMPONENT_NEEDS)
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
  install(DIRECTORY assets/episodes assets/models assets/sensors assets/studies assets/views
          DESTINATION ${CMAKE_INSTALL_DATADIR}/vantage/assets COMPONENT application)
endif()
