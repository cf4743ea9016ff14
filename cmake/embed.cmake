# vantage_embed(TARGET NAME FILES...): compiles text files into TARGET, so that an installed program
# needs no asset folder. The target's own sources then find them through
#
#   #include "generated/NAME.hpp"
#   std::string_view vantage::embedded_asset("page.html")      the file's name without its folder
#
# Run as a script (cmake -P) it writes the source file at build time, whenever an asset changed.
if(CMAKE_SCRIPT_MODE_FILE)
  set(fence "vantage_asset")
  set(entries "")
  foreach(file IN LISTS FILES)
    file(READ "${file}" text)
    string(FIND "${text}" ")${fence}\"" clash)
    if(NOT clash EQUAL -1)
      message(FATAL_ERROR "${file}: contains the end of a raw string literal, )${fence}\"")
    endif()
    get_filename_component(asset "${file}" NAME)
    string(APPEND entries "    {\"${asset}\", R\"${fence}(${text})${fence}\"},\n")
  endforeach()
  file(WRITE "${OUTPUT}" "#include \"generated/${NAME}.hpp\"

#include <utility>

#include \"vantage/core/error.hpp\"

namespace vantage {
inline namespace ${NAME} {
namespace {
constexpr std::pair<std::string_view, std::string_view> kAssets[] = {
${entries}};
}  // namespace

std::string_view embedded_asset(std::string_view name) {
  for (const auto& [asset, text] : kAssets) {
    if (asset == name) return text;
  }
  expects(false, \"an asset of that name is embedded\");
  return {};
}

}  // namespace ${NAME}
}  // namespace vantage
")
  return()
endif()

set(VANTAGE_EMBED_SCRIPT "${CMAKE_CURRENT_LIST_FILE}")

function(vantage_embed target name)
  set(folder "${CMAKE_CURRENT_BINARY_DIR}/embed_${name}")
  set(files "")
  foreach(file IN LISTS ARGN)
    get_filename_component(file "${file}" ABSOLUTE)
    list(APPEND files "${file}")
  endforeach()
  file(CONFIGURE OUTPUT "${folder}/generated/${name}.hpp" CONTENT "#pragma once

#include <string_view>

namespace vantage {
inline namespace ${name} {  // so that several of a program are not taken for one

/// The text of a file that was compiled in.
std::string_view embedded_asset(std::string_view name);

}  // namespace ${name}
}  // namespace vantage
" @ONLY)
  add_custom_command(
    OUTPUT "${folder}/${name}.cpp"
    COMMAND ${CMAKE_COMMAND} "-DNAME=${name}" "-DFILES=${files}" "-DOUTPUT=${folder}/${name}.cpp"
            -P "${VANTAGE_EMBED_SCRIPT}"
    DEPENDS ${files} "${VANTAGE_EMBED_SCRIPT}"
    COMMENT "Embedding ${name}"
    VERBATIM)
  target_sources(${target} PRIVATE "${folder}/${name}.cpp")
  target_include_directories(${target} PRIVATE "${folder}")
endfunction()
