# What is missing is said by its name; an optional component may be missing.
include(${CMAKE_CURRENT_LIST_DIR}/steps.cmake)
set_configure(${CMAKE_CURRENT_LIST_DIR}/component ${WORK_DIR}/unknown)
fails_with("There is no component planer. Components: core, geometry, " ${configure} -DCOMPONENTS=planer)

set_configure(${CMAKE_CURRENT_LIST_DIR}/component ${WORK_DIR}/without_opencv WITHOUT OpenCV)
set(needs_opencv "Component perception needs OpenCV COMPONENTS core")
fails_with("${needs_opencv}" ${configure} -DCOMPONENTS=perception)
fails_with("${needs_opencv}" ${configure} -DCOMPONENTS=)  # all
run(${configure} "-DCOMPONENTS=planners OPTIONAL_COMPONENTS perception planer")
file(READ ${WORK_DIR}/without_opencv/build.ninja rules)
if(NOT rules MATCHES "libvantage_view_gains" OR rules MATCHES "libvantage_perception")
  message(FATAL_ERROR "an optional component that cannot be had is linked, or planners are not")
endif()

set_configure(${CMAKE_CURRENT_LIST_DIR}/component ${WORK_DIR}/without_eigen WITHOUT Eigen3)
fails_with("Component geometry needs Eigen3" ${configure} -DCOMPONENTS=planners)
