# vantage_commit(VARIABLE): the commit that the sources are of, -dirty if they differ from it. What
# studies and checks write is no change of the program.
function(vantage_commit variable)
  set(git git -C ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/..)
  execute_process(COMMAND ${git} describe --always
                  OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  execute_process(COMMAND ${git} status --porcelain --untracked-files=no --
                          . :!bench/results :!bench/RESULTS.md :!docs/reliability.md
                  OUTPUT_VARIABLE changed ERROR_QUIET)
  if(NOT commit)
    set(commit "unknown")
  elseif(changed)
    string(APPEND commit "-dirty")
  endif()
  set(${variable} "${commit}" PARENT_SCOPE)
endfunction()

# cmake -DHEADER=FILE -P commit.cmake: a header of it, which stays as it is while the commit does.
if(CMAKE_SCRIPT_MODE_FILE)
  vantage_commit(commit)
  file(CONFIGURE OUTPUT ${HEADER} CONTENT "#pragma once\n#define VANTAGE_GIT_COMMIT \"${commit}\"\n")
  return()
endif()

# vantage_tells_commit(TARGET): its sources include vantage_commit.hpp, looked up by every build.
function(vantage_tells_commit target)
  set(header ${PROJECT_BINARY_DIR}/commit/vantage_commit.hpp)
  if(NOT TARGET vantage_commit)
    add_custom_target(vantage_commit BYPRODUCTS ${header} VERBATIM
      COMMAND ${CMAKE_COMMAND} -DHEADER=${header} -P ${CMAKE_CURRENT_FUNCTION_LIST_FILE}
      COMMENT "Looking up the commit")
  endif()
  add_dependencies(${target} vantage_commit)
  target_include_directories(${target} PRIVATE ${PROJECT_BINARY_DIR}/commit)
endfunction()
