# `cpack -G DEB` in a build folder: vantage (program and data), libvantage-dev (the planning library),
# python3-vantage. What they depend on dpkg-shlibdeps reads from what is linked.
set(debian ${PROJECT_SOURCE_DIR}/cmake/debian)
set(parts library)
if(VANTAGE_BUILD_SIM)
  list(APPEND parts application)
endif()
if(VANTAGE_WITH_PYTHON)
  list(APPEND parts python)
endif()
set(name_of_application vantage)
set(name_of_library libvantage-dev)
set(name_of_python python3-vantage)

# The changelog that Debian asks for names the version, the commit and its date: a new commit
# configures again.
execute_process(COMMAND git -C ${PROJECT_SOURCE_DIR} rev-parse --path-format=absolute --git-path logs/HEAD
                OUTPUT_VARIABLE head_log OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(head_log AND EXISTS ${head_log})
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${head_log})
endif()
vantage_commit(VANTAGE_GIT_COMMIT)
execute_process(COMMAND git -C ${PROJECT_SOURCE_DIR} log -1 --format=%aD OUTPUT_VARIABLE VANTAGE_COMMIT_DATE
                OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT VANTAGE_COMMIT_DATE)
  set(VANTAGE_COMMIT_DATE "Thu, 01 Jan 1970 00:00:00 +0000")
endif()
set(VANTAGE_MAINTAINER "Vantage maintainers <vantage@example.org>" CACHE STRING "Maintainer that packages name")
find_program(GZIP gzip REQUIRED)
configure_file(${debian}/changelog.in ${PROJECT_BINARY_DIR}/debian/changelog @ONLY)
execute_process(COMMAND ${GZIP} -9nf ${PROJECT_BINARY_DIR}/debian/changelog)

foreach(part IN LISTS parts)
  install(FILES ${debian}/copyright ${PROJECT_BINARY_DIR}/debian/changelog.gz
          DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name_of_${part}} COMPONENT ${part} EXCLUDE_FROM_ALL)
endforeach()
if(VANTAGE_BUILD_SIM)
  install(DIRECTORY ${PROJECT_BINARY_DIR}/manual/man1 DESTINATION ${CMAKE_INSTALL_MANDIR} COMPONENT application)
  install(FILES ${PROJECT_BINARY_DIR}/manual/bash-completion/vantage
          DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT application)
endif()
if(VANTAGE_WITH_PYTHON)
  install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/python3-vantage COMPONENT python
          FILES_MATCHING PATTERN "*.py" PATTERN "*.js" PATTERN "*.cpp" PATTERN "CMakeLists.txt" PATTERN "README.md")
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME vantage)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")    # each has its own
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT "${VANTAGE_MAINTAINER}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_COMPONENTS_ALL ${parts})
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE
    WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_APPLICATION_PACKAGE_NAME vantage)
set(CPACK_DEBIAN_APPLICATION_PACKAGE_SECTION science)
set(CPACK_DEBIAN_APPLICATION_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_APPLICATION_PACKAGE_SUGGESTS "bash-completion, python3-vantage")
set(CPACK_DEBIAN_APPLICATION_DESCRIPTION "information-theoretic action selection for robots
Robots that choose their next action by how much they will learn from it:
next best views on a table and in offices, recognition of objects from a
quadrotor, trajectories for recognition. Each closes the loop in physics,
from sensor to belief to plan to actuator, in one headless process.
.
This package has the program, its scenes, robots, episodes and studies.")

set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libvantage-dev)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS
    "libeigen3-dev (>= 3.4), libfmt-dev, liboctomap-dev, libspdlog-dev, libyaml-cpp-dev")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_RECOMMENDS "cmake, libnanoflann-dev, libopencv-dev")
set(CPACK_DEBIAN_LIBRARY_DESCRIPTION "information-theoretic planning for robots (development files)
Occupancy maps, what views of them are worth, choices of views, tours,
distance fields, trajectory optimisation, measures of information, object
beliefs and features, without a simulator.
.
This package has static libraries, headers and the CMake package of
components. The component perception needs what is recommended.")

if(VANTAGE_WITH_PYTHON)
  set(next_minor ${Python3_VERSION_MINOR})
  math(EXPR next_minor "${next_minor} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-vantage)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
      "python3 (>= 3.${Python3_VERSION_MINOR}), python3 (<< 3.${next_minor}), python3-numpy, vantage (= ${PROJECT_VERSION})")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "python3-matplotlib")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA "${debian}/postinst;${debian}/prerm")
  set(CPACK_DEBIAN_PYTHON_DESCRIPTION "information-theoretic action selection for robots (Python 3)
Planning, recognition and whole episodes from Python, with numpy arrays in
and out: grids, gains, views, tours, trajectories; planners of your own in
closed loop; environments with the semantics of Gymnasium.
.
The data is that of the package vantage. Examples need matplotlib.")
endif()
include(CPack)
