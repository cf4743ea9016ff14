#include "vantage/recipe/model_recipe.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "vantage/core/data_root.hpp"
#include "vantage/core/yaml.hpp"

namespace vantage {
namespace {

/// Writes into each recording what all have in common and it does not say itself. What is no map
/// or no list stays: reading it tells.
void fill_in_common(ConfigNode& root) {
  const ConfigNode* render = root.find("render");
  const ConfigNode* recordings = root.find("recordings");
  if (render == nullptr || recordings == nullptr) return;
  ConfigNode filled = *recordings;
  for (ConfigNode& recording : filled.items) {
    if (recording.kind == ConfigNode::Kind::scalar) continue;
    for (const auto& [key, value] : render->entries) {
      if (recording.find(key) == nullptr) recording.set(key, value);
    }
  }
  root.set("recordings", std::move(filled));
}

}  // namespace

void ModelRecipe::check() const {
  if (recordings.empty()) throw ConfigError("recordings: some are needed");
  std::set<std::string> known;
  for (const DatasetOptions& recording : recordings) {
    if (!known.insert(to_yaml(write_node(recording))).second) {
      throw ConfigError(
          fmt::format("recordings: two of session {} are the same", recording.session));
    }
    for (const int video : train.videos) {
      if (std::ranges::find(recording.videos, video) != recording.videos.end()) continue;
      throw ConfigError(
          fmt::format("train.videos: {} is not recorded in session {}", video, recording.session));
    }
  }
}

ModelRecipe read_model_recipe(const std::filesystem::path& file,
                              const std::vector<std::string>& overrides) {
  ConfigNode root = read_yaml(file);
  apply_overrides(root, overrides);
  fill_in_common(root);
  ModelRecipe recipe;
  read_into(root, recipe, {});
  for (DatasetOptions& recording : recipe.recordings) {
    if (recording.models.empty()) continue;
    recording.models =
        std::filesystem::absolute(find_input(recording.models, file.parent_path(), "models"))
            .string();
  }
  return recipe;
}

}  // namespace vantage
