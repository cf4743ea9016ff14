/// Checked-in scenes: what the tests of the generators compare and load.
#pragma once

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/models/catalogue/shapes/texture.hpp"

namespace vantage::support {

inline const std::filesystem::path kCheckedInScenes =
    std::filesystem::path(VANTAGE_SOURCE_DIR) / "models" / "scenes";

using Model = std::unique_ptr<mjModel, decltype(&mj_deleteModel)>;

/// Every scene of a list, as ./check models asks for it, or one of so many.
/// @param of no multiple of the number of levels, so that each of them is among the few
template <class Options>
std::vector<Options> some_of(const std::vector<Options>& scenes, std::size_t of) {
  if (std::getenv("VANTAGE_EVERY_SCENE") != nullptr) of = 1;
  std::vector<Options> some;
  for (std::size_t i = 0; i < scenes.size(); i += of) some.push_back(scenes[i]);
  return some;
}

/// Fails the test on errors and on warnings.
inline Model load_mjcf(const std::filesystem::path& path) {
  std::array<char, 1000> message{};
  Model model(mj_loadXML(path.c_str(), nullptr, message.data(), message.size()), &mj_deleteModel);
  EXPECT_NE(model, nullptr) << message.data();
  EXPECT_STREQ(message.data(), "");
  return model;
}

inline std::map<std::string, std::filesystem::path> files_below(
    const std::filesystem::path& directory) {
  std::map<std::string, std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(directory)) {
    if (!entry.is_regular_file()) continue;
    files[std::filesystem::relative(entry.path(), directory).string()] = entry.path();
  }
  return files;
}

/// The same names and contents; images by their pixels.
inline void expect_same_files(const std::filesystem::path& made_folder,
                              const std::filesystem::path& kept_folder) {
  const auto made = files_below(made_folder);
  const auto kept = files_below(kept_folder);
  ASSERT_EQ(made.size(), kept.size());
  for (const auto& [name, path] : made) {
    ASSERT_TRUE(kept.contains(name)) << name;
    if (path.extension() == ".png") {
      EXPECT_TRUE(read_png(path) == read_png(kept.at(name))) << name;
    } else {
      EXPECT_TRUE(read_file(path) == read_file(kept.at(name))) << name;
    }
  }
}

}  // namespace vantage::support
