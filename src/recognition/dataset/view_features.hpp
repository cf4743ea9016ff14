/// The features of many views of a dataset, extracted once.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "vantage/perception/dataset_index.hpp"
#include "vantage/perception/features/feature.hpp"
#include "vantage/recognition/dataset/long_work.hpp"

namespace vantage {

struct ViewFeatures {
  ViewName name;
  std::filesystem::path folder;         ///< of the object; another recording has another
  double yaw_rad = 0.0;                 ///< of the object, [0, 2 pi)
  double elevation_rad = 0.0;           ///< of the camera above the object's support
  std::vector<FeatureResult> features;  ///< in the order of the extractors
};

/// Of each view, in their order.
/// @throws InputError naming the file of a view that cannot be read, and what `how.poll` throws.
std::vector<ViewFeatures> extract_features(std::span<const ViewEntry> views,
                                           std::span<const TrainedFeature> extractors,
                                           const LongWork& how, const std::string& label);

/// The views of these videos, in their order.
std::vector<ViewEntry> views_of_videos(const DatasetIndex& dataset, std::span<const int> videos);

}  // namespace vantage
