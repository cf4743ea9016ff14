# vantage_discover_suites(TARGET PREFIX TIMEOUT LONG): a test of CTest for each suite of a GoogleTest program, found when
# the program is built. A process for each test would spend more time on loading libraries than on tests. The suites
# named in LONG, separated by spaces, begin first, and have the label `long`: `./test --short` leaves them out.
#
# Run as a script by that build: writes FILE with the suites of PROGRAM.

if(CMAKE_SCRIPT_MODE_FILE)
  cmake_minimum_required(VERSION 3.25)
  execute_process(COMMAND ${PROGRAM} --gtest_list_tests OUTPUT_VARIABLE listing COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "(^|\n)[A-Za-z0-9_/]+[.]" suites "${listing}")
  if(NOT suites)
    message(FATAL_ERROR "${PROGRAM}: has no tests")
  endif()
  set(tests "")
  math(EXPR cost "${TIMEOUT} / 100")
  separate_arguments(long UNIX_COMMAND "${LONG}")
  foreach(suite IN LISTS suites)
    string(STRIP "${suite}" suite)
    string(REGEX REPLACE "[.]$" "" suite "${suite}")
    set(order "COST ${cost}")
    if(suite IN_LIST long)
      set(order "COST 100 LABELS long")
      list(REMOVE_ITEM long "${suite}")
    endif()
    string(APPEND tests
      "add_test(\"${PREFIX}.${suite}\" \"${PROGRAM}\" \"--gtest_filter=${suite}.*\")\n"
      "set_tests_properties(\"${PREFIX}.${suite}\" PROPERTIES WORKING_DIRECTORY \"${FOLDER}\" TIMEOUT ${TIMEOUT}\n"
      "  ${order} SKIP_REGULAR_EXPRESSION \"every test was skipped\")\n")
  endforeach()
  if(long)
    message(FATAL_ERROR "${PROGRAM}: no such suites: ${long}")
  endif()
  file(WRITE "${FILE}" "${tests}")
  return()
endif()

set(VANTAGE_SUITES_SCRIPT ${CMAKE_CURRENT_LIST_FILE})
function(vantage_discover_suites target prefix timeout long)
  set(suites ${CMAKE_CURRENT_BINARY_DIR}/${target}_suites.cmake)
  add_custom_command(TARGET ${target} POST_BUILD BYPRODUCTS ${suites} VERBATIM
    COMMAND ${CMAKE_COMMAND} -DPROGRAM=$<TARGET_FILE:${target}> -DPREFIX=${prefix} -DTIMEOUT=${timeout}
            "-DLONG=${long}" -DFOLDER=${CMAKE_CURRENT_BINARY_DIR} -DFILE=${suites} -P ${VANTAGE_SUITES_SCRIPT})
  set(include ${CMAKE_CURRENT_BINARY_DIR}/${target}_include.cmake)
  file(WRITE ${include} "if(EXISTS \"${suites}\")\n  include(\"${suites}\")\nelse()\n"
    "  add_test(${target}_NOT_BUILT ${target}_NOT_BUILT)\nendif()\n")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${include})
endfunction()
