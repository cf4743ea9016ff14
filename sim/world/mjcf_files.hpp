/// What files an MJCF text names, nothing compiled.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace vantage {

/// `<element name="value">`, of the text that it was found in; entities are as written.
struct MjcfAttribute {
  std::string_view element;
  std::string_view name;
  std::string_view value;
  /// It names a file: `file`, or `fileright` and the like of a cube.
  [[nodiscard]] bool names_file() const { return name.starts_with("file"); }
};

/// All of them in order, comments left out.
std::vector<MjcfAttribute> mjcf_attributes(std::string_view mjcf);

/// The file at `main` and every file that it or what it includes names, where MuJoCo looks for
/// them: beside `main`, meshes and textures in the folders of any `<compiler>`. Files that are not
/// there are left out.
std::set<std::filesystem::path> mjcf_files(const std::filesystem::path& main);

}  // namespace vantage
