/// A recogniser of a few objects that is rendered and learnt in seconds, and flights that use it.
#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <vector>

#include "vantage/dataset/render_dataset.hpp"
#include "vantage/recognition/training.hpp"

namespace vantage::support {

inline constexpr int kSmallObjects = 4;  // mugs, and a cereal box without a near-duplicate

/// Makes `folder`/model.
inline void make_small_model(const std::filesystem::path& folder) {
  DatasetOptions objects;
  objects.objects = kSmallObjects;
  objects.step_deg = 24.0;
  objects.supersampling = 1;
  render_dataset(objects, {.root = folder / "objects"});
  TrainingOptions training;
  training.features = {SoftColour{}, StandingBox{}};
  training.transition_prior_moves = 0.0;
  write_recognition_model(train_recognition(index_dataset(folder / "objects"), training, {}),
                          folder / "model");
}

/// Overrides of an episode that flies.
inline std::vector<std::string> small_flight(const std::filesystem::path& folder) {
  return {fmt::format("model={}", (folder / "model").string()),
          fmt::format("database.objects={}", kSmallObjects),
          "settle_s=0.1",
          "max_views=2",
          "all_features=true",
          "camera={width_px: 320, height_px: 240}",
          "segmentation.min_pixels=40"};
}

}  // namespace vantage::support
