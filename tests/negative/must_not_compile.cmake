# cmake -DCOMPILER=... -DINCLUDES=... -DSOURCE=file.cpp -P must_not_compile.cmake
#
# Passes if the file compiles as it is, and with USE_TRUTH defined fails with the error that a line
# `// expected error: REGEX` of it names. INCLUDES are folders, joined by '|'.
string(REPLACE "|" ";" folders "${INCLUDES}")
set(ENV{LC_ALL} C)
set(flags -std=c++20 -fsyntax-only)
foreach(folder IN LISTS folders)
  list(APPEND flags -I${folder})
endforeach()

file(STRINGS ${SOURCE} line REGEX "^// expected error: ")
string(REPLACE "// expected error: " "" expected "${line}")
if(NOT expected)
  message(FATAL_ERROR "${SOURCE}: has no line '// expected error: REGEX'")
endif()

execute_process(COMMAND ${COMPILER} ${flags} ${SOURCE} RESULT_VARIABLE code ERROR_VARIABLE errors)
if(NOT code EQUAL 0)
  message(FATAL_ERROR "${SOURCE}: does not compile without USE_TRUTH\n${errors}")
endif()

execute_process(COMMAND ${COMPILER} ${flags} -DUSE_TRUTH ${SOURCE}
                RESULT_VARIABLE code ERROR_VARIABLE errors)
if(code EQUAL 0)
  message(FATAL_ERROR "${SOURCE}: compiles with USE_TRUTH, which reaches the truth")
endif()
if(NOT errors MATCHES "error: [^\n]*(${expected})")
  message(FATAL_ERROR "${SOURCE}: expected the error '${expected}', got\n${errors}")
endif()
