/// What a MuJoCo model is made of: names of files, nothing compiled.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace vantage {

struct MemoryFile {
  std::string name;  ///< as the MJCF calls it
  std::string content;
};

/// Two MJCF files. The scene may use any `<compiler>` settings and includes. When a robot joins it,
/// its numbers are rounded to six digits and its keyframes dropped (their length would no longer
/// fit), and names starting with `robot/` belong to the robot. The robot brings no files of its
/// own.
struct ModelSource {
  std::filesystem::path scene;
  std::filesystem::path robot;         ///< empty: no robot
  std::vector<MemoryFile> files = {};  ///< stand in for files that the scene refers to by name
};

}  // namespace vantage
