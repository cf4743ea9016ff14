#include "vantage/recognition/dataset/view_features.hpp"

#include <algorithm>
#include <optional>

#include "vantage/perception/dataset_reader.hpp"
#include "vantage/recognition/dataset/feature_cache.hpp"

namespace vantage {
namespace {

/// The images are opened only if something is missing.
std::vector<FeatureResult> features_of(const ViewEntry& entry,
                                       std::span<const TrainedFeature> extractors,
                                       FeatureCache& cache) {
  const std::uint64_t hash = cache.active() ? view_hash(entry) : 0;
  std::optional<LabelledView> view;
  std::vector<FeatureResult> features;
  for (std::size_t f = 0; f < extractors.size(); ++f) {
    if (auto known = cache.find(f, hash)) {
      features.push_back(std::move(*known));
      continue;
    }
    if (!view) view = load_view(entry);
    features.push_back(extractors[f].extract(view->view));
    cache.keep(f, hash, features.back());
  }
  return features;
}

}  // namespace

std::vector<ViewFeatures> extract_features(std::span<const ViewEntry> views,
                                           std::span<const TrainedFeature> extractors,
                                           const LongWork& how, const std::string& label) {
  std::vector<ViewFeatures> extracted(views.size());
  FeatureCache cache(how.feature_cache, extractors);
  work_through(views.size(), how, label, [&](std::size_t i) {
    extracted[i] = {.name = views[i].name,
                    .folder = views[i].folder,
                    .yaw_rad = views[i].yaw_rad,
                    .elevation_rad = views[i].elevation_rad(),
                    .features = features_of(views[i], extractors, cache)};
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
