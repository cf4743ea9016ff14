/// Where the models and episodes that come with Vantage are.
#pragma once

#include <filesystem>
#include <string>

namespace vantage {

/// $VANTAGE_DATA if set, else what set_data_root() said, else <prefix>/share/vantage beside an
/// installed binary, else the source tree.
std::filesystem::path data_root();

/// Data lies there unless $VANTAGE_DATA is set: for programs that bring it with them. Once, before
/// anything is looked for.
void set_data_root(std::filesystem::path root);

/// `name` as it stands if absolute; else the first that exists of `base`/name, name in the working
/// directory, and data_root()/name.
/// @throws InputError naming `key` and the places looked at.
std::filesystem::path find_input(const std::string& name, const std::filesystem::path& base,
                                 const std::string& key);

/// A found file's name as it is found again from any working directory: relative to data_root() if
/// it is inside, else absolute.
std::string lasting_name(const std::filesystem::path& found);

/// What people call a scene: "office_small_2" for models/scenes/office_small_2/scene.xml, "kitchen"
/// for my/kitchen.xml. Anything that is no MJCF file keeps its name.
std::string scene_title(const std::string& scene);

}  // namespace vantage
