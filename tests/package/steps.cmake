# What the scripts beside this one share.
foreach(variable WORK_DIR SOURCE_DIR CXX_COMPILER)
  if(NOT DEFINED ${variable})
    message(FATAL_ERROR "-D${variable}=... is missing")
  endif()
endforeach()
set(prefix ${WORK_DIR}/prefix)

# What finding and linking planners must not need.
set(foreign_to_planners OpenCV nanoflann)

# run(COMMAND ...): fails unless the command succeeds; its output is left in `output`.
macro(run)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${WORK_DIR} RESULT_VARIABLE result
                  OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${ARGN}\n${output}")
  endif()
endmacro()

# fails_with(TEXT COMMAND ...): fails unless the command does, and says TEXT. Where CMake breaks the
# lines of a message does not matter.
macro(fails_with text)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${WORK_DIR} RESULT_VARIABLE result
                  OUTPUT_VARIABLE output ERROR_VARIABLE output)
  string(REGEX REPLACE "[ \n]+" " " said "${output}")
  string(FIND "${said}" "${text}" place)
  if(result EQUAL 0 OR place EQUAL -1)
    message(FATAL_ERROR "does not fail with \"${text}\": ${ARGN}\n${output}")
  endif()
endmacro()

# set_configure(SOURCE BUILD [WITHOUT PACKAGES...]): leaves in `configure` the command that
# configures a project with the installed package, where some packages cannot be found.
macro(set_configure source build)
  cmake_parse_arguments(ARG "" "" "WITHOUT" ${ARGN})
  list(TRANSFORM ARG_WITHOUT REPLACE "(.+)" "-DCMAKE_DISABLE_FIND_PACKAGE_\\1=ON")
  set(configure ${CMAKE_COMMAND} -S ${source} -B ${build} -G Ninja -DCMAKE_BUILD_TYPE=Release
      -DCMAKE_CXX_COMPILER=${CXX_COMPILER} -DCMAKE_CXX_COMPILER_LAUNCHER=${CXX_LAUNCHER}
      "-DCMAKE_CXX_FLAGS=${CXX_FLAGS}" -DCMAKE_PREFIX_PATH=${prefix} ${ARG_WITHOUT})
endmacro()

# links_nothing_of(PROGRAM BUILD PATTERN): the link line and what the program loads.
function(links_nothing_of program build pattern)
  run(ldd ${build}/${program})
  file(READ ${build}/build.ninja rules)
  string(TOLOWER "${output}${rules}" all)
  string(REGEX MATCH "[^ \n]*(${pattern})[^ \n]*" found "${all}")
  if(found)
    message(FATAL_ERROR "${program} links ${found}")
  endif()
endfunction()
