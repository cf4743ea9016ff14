# Builds a sample against the installed package and runs it, where neither OpenCV nor nanoflann is.
include(${CMAKE_CURRENT_LIST_DIR}/steps.cmake)
set(build ${WORK_DIR}/${SAMPLE})
set_configure(${CMAKE_CURRENT_LIST_DIR}/${SAMPLE} ${build} WITHOUT ${foreign_to_planners})
run(${configure})
run(${CMAKE_COMMAND} --build ${build})
run(${build}/${SAMPLE})
links_nothing_of(${SAMPLE} ${build} "opencv|nanoflann")
