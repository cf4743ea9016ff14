#include "src/recognition/view_features.hpp"

#include <algorithm>

#include "src/perception/dataset_reader.hpp"

namespace vantage {

std::vector<ViewFeatures> extract_features(std::span<const ViewEntry> views,
                                           std::span<const TrainedFeature> extractors,
                                           const LongWork& how, const std::string& label) {
  std::vector<ViewFeatures> extracted(views.size());
  work_through(views.size(), how, label, [&](std::size_t i) {
    const LabelledView view = load_view(views[i]);
    extracted[i] = {.name = view.name, .yaw_rad = view.yaw_rad, .features = {}};
    for (const TrainedFeature& extractor : extractors) {
      extracted[i].features.push_back(extractor.extract(view.view));
    }
  });
  return extracted;
}

std::vector<ViewEntry> views_of_videos(const DatasetIndex& dataset, std::span<const int> videos) {
  std::vector<ViewEntry> views;
  std::ranges::copy_if(dataset.views, std::back_inserter(views), [&](const ViewEntry& view) {
    return std::ranges::find(videos, view.name.video) != videos.end();
  });
  return views;
}

}  // namespace vantage
