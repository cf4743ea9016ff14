// What each feature costs on one view: extraction only, one thread. The views are noisy striped
// balls that fill a crop of 150 x 150 px; what is learnt has its full size, 1000 words and 1000
// components, from crops of 64 x 64 px, which is quicker and costs the same to use.
#include <fmt/format.h>
#include <opencv2/core.hpp>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "bench/measures.hpp"
#include "tests/support/object_views.hpp"
#include "vantage/core/fields.hpp"
#include "vantage/core/yaml.hpp"
#include "vantage/perception/features/feature.hpp"

namespace vantage::bench {
namespace {

constexpr int kSide_px = 150;
constexpr int kTrainingSide_px = 64;
constexpr int kTrainingViews = 1100;
constexpr int kViews = 8;
constexpr int kRepeats = 31;

/// Vocabulary, pyramid and components at their full size; quicker to learn.
Feature full_size(std::string_view name) {
  auto feature = make_strategy<Feature>(name);
  std::visit(
      [](auto& options) {
        if constexpr (requires { options.learning; }) {
          options.learning.iterations = 2;
          options.learning.samples_per_word = 5;
        }
      },
      feature);
  return feature;
}

double cost_ms(const Feature& feature, const std::vector<ObjectView>& training,
               const std::vector<ObjectView>& views) {
  Rng rng(1);
  const TrainedFeature trained = train_feature(feature, training, rng);
  log_info(fmt::format("{}: {} dimensions", trained.name(), trained.dimension()));
  std::size_t next = 0;
  return median_ms(kRepeats, [&] {
    expects(trained.extract(views[next++ % views.size()]).extracted(), "a ball has every feature");
  });
}

void run_benchmark() {
  cv::setNumThreads(1);
  Rng rng(1);
  const std::vector<ObjectView> training = ball_views(kTrainingViews, kTrainingSide_px, rng);
  const std::vector<ObjectView> views = ball_views(kViews, kSide_px, rng);
  std::string configuration =
      fmt::format("views: {{of: {}, side_px: {}}}\ntraining: {{of: {}, side_px: {}}}\n", kViews,
                  kSide_px, kTrainingViews, kTrainingSide_px);
  const auto cost = [&](std::string_view name) {
    const Feature feature = full_size(name);
    configuration += to_yaml(write_node(feature));
    return cost_ms(feature, training, views);
  };
  std::vector<std::pair<std::string, double>> figures{
      {"colour_ms", cost(Colour::name)},    {"soft_colour_ms", cost(SoftColour::name)},
      {"bbox_ms", cost(BoundingBox::name)}, {"standing_box_ms", cost(StandingBox::name)},
      {"sift_ms", cost(Sift::name)},        {"vfh_ms", cost(Vfh::name)}};
  double sum_ms = 0.0;
  for (const PatchKindRow& kind : kPatchKinds) {
    const double ms = cost(kind.name);
    figures.emplace_back("kernel_" + std::string(kind.name) + "_ms", ms);
    sum_ms += ms;
  }
  figures.emplace_back("kernel_ms", sum_ms);
  print_figures("features", 1, configuration, figures);
}

}  // namespace
}  // namespace vantage::bench

int main() { return vantage::bench::run_main(vantage::bench::run_benchmark); }
