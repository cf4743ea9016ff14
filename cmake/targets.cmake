# Headers are included by the same name in the tree and once installed, vantage/<folder>/<file>.hpp:
# these links lead there.
file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/include/vantage)
file(GLOB vantage_folders LIST_DIRECTORIES true ${PROJECT_SOURCE_DIR}/src/*)
foreach(folder IN LISTS vantage_folders ITEMS ${PROJECT_SOURCE_DIR}/planners ${PROJECT_SOURCE_DIR}/sim
                                              ${PROJECT_SOURCE_DIR}/models)
  if(IS_DIRECTORY ${folder})
    get_filename_component(name ${folder} NAME)
    file(CREATE_LINK ${folder} ${PROJECT_BINARY_DIR}/include/vantage/${name} SYMBOLIC)
  endif()
endforeach()

# What nearly every source includes is parsed once for all libraries.
# CMAKE_DISABLE_PRECOMPILE_HEADERS=ON builds without.
function(vantage_library_base)
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/library_base.cpp CONTENT "")
  add_library(vantage_library_base OBJECT ${PROJECT_BINARY_DIR}/library_base.cpp)
  set_target_properties(vantage_library_base PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_link_libraries(vantage_library_base PRIVATE Eigen3::Eigen fmt::fmt)
  vantage_compile_options(vantage_library_base)
  target_precompile_headers(vantage_library_base PRIVATE
    <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <memory> <optional> <span>
    <string> <string_view> <utility> <variant> <vector>
    <Eigen/Core> <Eigen/Geometry> <fmt/format.h>)
endfunction()

# vantage_library(NAME SOURCES ... [PUBLIC ...] [PRIVATE ...]): one static library per folder, target
# vantage_NAME, alias vantage::NAME. COLD: most of its time is spent in other libraries, so that it
# is compiled to be compiled fast.
function(vantage_library name)
  cmake_parse_arguments(ARG "NOT_INSTALLED;COLD" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(vantage_${name} STATIC ${ARG_SOURCES})
  add_library(vantage::${name} ALIAS vantage_${name})
  set_target_properties(vantage_${name} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_include_directories(vantage_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(vantage_${name} PUBLIC ${ARG_PUBLIC} PRIVATE fmt::fmt ${ARG_PRIVATE})
  vantage_compile_options(vantage_${name})
  vantage_in_batches(vantage_${name})
  if(ARG_COLD)
    target_compile_options(vantage_${name} PRIVATE $<$<CONFIG:Release>:-O1>)
  else()
    target_precompile_headers(vantage_${name} REUSE_FROM vantage_library_base)
  endif()
  if(NOT ARG_NOT_INSTALLED)
    set_property(GLOBAL APPEND PROPERTY VANTAGE_INSTALLED_TARGETS vantage_${name})
  endif()
endfunction()

# vantage_bundle(NAME FOLDERS...): one name for the libraries of several rooms.
function(vantage_bundle name)
  add_library(vantage_${name} INTERFACE)
  add_library(vantage::${name} ALIAS vantage_${name})
  set_target_properties(vantage_${name} PROPERTIES EXPORT_NAME ${name})
  foreach(room IN LISTS ARGN)
    target_link_libraries(vantage_${name} INTERFACE vantage::${room})
  endforeach()
  get_property(installed GLOBAL PROPERTY VANTAGE_INSTALLED_TARGETS)
  list(TRANSFORM ARGN PREPEND vantage_ OUTPUT_VARIABLE rooms)
  list(REMOVE_ITEM rooms ${installed})
  if(NOT rooms)
    set_property(GLOBAL APPEND PROPERTY VANTAGE_INSTALLED_TARGETS vantage_${name})
  endif()
endfunction()

# Warnings are errors in our own code. Contraction into FMA is off, so that optimisation does not
# change results, and GCC collects its garbage seldom: a tenth of its time.
function(vantage_compile_options target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Werror -ffp-contract=off)
  # Eigen's own square root of floats begins at an estimate of the processor, of which each maker has another.
  target_compile_definitions(${target} PRIVATE EIGEN_FAST_MATH=0)
  # GCC 12 warns of overlaps and overflows inside std::string's own operator+ (GCC bug 105651).
  target_compile_options(${target} PRIVATE
    $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict;-Wno-stringop-overflow;-Wno-array-bounds>
    "$<$<CXX_COMPILER_ID:GNU>:SHELL:--param ggc-min-heapsize=1000000>")
  target_compile_definitions(${target} PRIVATE
    $<$<CONFIG:Debug>:EIGEN_INITIALIZE_MATRICES_BY_NAN>)
endfunction()

# Where what files include takes more time than what they say, a few are compiled as one:
# VANTAGE_UNITY_BUILD.
function(vantage_in_batches target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${VANTAGE_UNITY_BUILD} UNITY_BUILD_BATCH_SIZE 8)
  if(VANTAGE_UNITY_BUILD)    # to GCC the sources of a batch are headers
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  endif()
endfunction()

# What every test program has: suites that cannot be set up fail, and what nearly every test
# includes is parsed once for all of them, so that one compiles in two thirds of the time.
# CMAKE_DISABLE_PRECOMPILE_HEADERS=ON builds without the latter.
function(vantage_test_base name optimisation)
  add_library(${name} OBJECT ${PROJECT_SOURCE_DIR}/tests/support/suite_set_up.cpp)
  target_link_libraries(${name} PRIVATE Eigen3::Eigen GTest::gtest_main GTest::gmock)
  vantage_test_options(${name} ${optimisation})
  target_precompile_headers(${name} PRIVATE
    <algorithm> <cmath> <filesystem> <fstream> <functional> <map> <numbers> <optional> <random>
    <ranges> <set> <span> <string> <variant> <vector>
    <Eigen/Core> <Eigen/Geometry> <gmock/gmock.h> <gtest/gtest.h>)
endfunction()

# Of tests and of their headers alike, else the headers cannot be used.
function(vantage_test_options target optimisation)
  target_compile_definitions(${target} PRIVATE VANTAGE_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR})
  vantage_compile_options(${target})
  vantage_in_batches(${target})
  set_target_properties(${target} PROPERTIES UNITY_BUILD_BATCH_SIZE 16)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:${optimisation}>)
endfunction()

# vantage_test(FOLDER SOURCES ... LINK ... [TIMEOUT seconds] [LONG suites ...] [CALCULATES]): one GoogleTest program per
# folder, test_FOLDER, and a test of CTest for each of its suites; those that may take longest begin first, and
# `./test --short` leaves the LONG ones out, which take half a minute and more. Not optimised, tests
# compile in half the time and most run as fast, as their time is spent in the libraries; not those that CALCULATE, by
# themselves or by templates of the libraries.
function(vantage_test folder)
  cmake_parse_arguments(ARG "CALCULATES" "TIMEOUT" "SOURCES;LINK;LONG" ${ARGN})
  list(JOIN ARG_LONG " " long)
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 600)
  endif()
  if(CMAKE_CXX_FLAGS MATCHES "-fsanitize=thread")    # ten times as slow
    math(EXPR ARG_TIMEOUT "6 * ${ARG_TIMEOUT}")
  endif()
  set(base vantage_test_base)
  set(optimisation -O0)
  if(ARG_CALCULATES)
    set(base vantage_test_base_optimised)
    set(optimisation -O1)
  endif()
  add_executable(test_${folder} ${ARG_SOURCES} $<TARGET_OBJECTS:${base}>)
  target_link_libraries(test_${folder} PRIVATE ${ARG_LINK} GTest::gtest_main GTest::gmock)
  vantage_test_options(test_${folder} ${optimisation})
  target_precompile_headers(test_${folder} REUSE_FROM ${base})
  vantage_discover_suites(test_${folder} ${folder} ${ARG_TIMEOUT} "${long}")
endfunction()
