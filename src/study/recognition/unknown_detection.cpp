#include "vantage/study/recognition/unknown_detection.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "vantage/core/error.hpp"
#include "vantage/information/quantile.hpp"
#include "vantage/study/recognition/reliability.hpp"

namespace vantage {
namespace {

constexpr int kResamples = 1000;
constexpr double kFound = 0.9;

std::vector<double> probabilities(std::span<const Trial> trials, std::span<const std::size_t> of) {
  std::vector<double> values;
  for (const std::size_t i : of) values.push_back(trials[i].unknown_probability);
  return values;
}

double share_above(std::span<const double> values, double threshold) {
  const auto above = std::ranges::count_if(values, [&](double p) { return p >= threshold; });
  return static_cast<double>(above) / static_cast<double>(values.size());
}

std::vector<std::size_t> all_of(const Clusters& clusters) {
  std::vector<std::size_t> all;
  for (const auto& cluster : clusters) all.insert(all.end(), cluster.begin(), cluster.end());
  return all;
}

/// As many clusters, each any of them.
std::vector<std::size_t> resampled(const Clusters& clusters, Rng& rng) {
  std::vector<std::size_t> drawn;
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    const auto& cluster = clusters[rng.uniform_index(clusters.size())];
    drawn.insert(drawn.end(), cluster.begin(), cluster.end());
  }
  return drawn;
}

/// Of those that are found and whose category is known, or is not.
double category_right(const UnknownTrials& unknown, bool known) {
  double found = 0.0;
  double right = 0.0;
  for (std::size_t i = 0; i < unknown.trials.size(); ++i) {
    if (!unknown.trials[i].correct || unknown.category_known[i] != known) continue;
    found += 1.0;
    right += unknown.trials[i].category_correct ? 1.0 : 0.0;
  }
  return found > 0.0 ? right / found : std::numeric_limits<double>::quiet_NaN();
}

double held_for_unknown(std::span<const double> values) {
  const auto count = std::ranges::count_if(values, [](double p) { return p > 0.5; });
  return static_cast<double>(count) / static_cast<double>(values.size());
}

}  // namespace

double area_under_curve(std::span<const double> high, std::span<const double> low) {
  expects(!high.empty() && !low.empty(), "values of both kinds");
  std::vector<double> sorted(low.begin(), low.end());
  std::ranges::sort(sorted);
  double sum = 0.0;
  for (const double value : high) {
    const auto [first, last] = std::equal_range(sorted.begin(), sorted.end(), value);
    sum += static_cast<double>(first - sorted.begin()) + 0.5 * static_cast<double>(last - first);
  }
  return sum / (static_cast<double>(high.size()) * static_cast<double>(low.size()));
}

double found_above(std::vector<double> values, double share) {
  expects(!values.empty() && share > 0.0 && share <= 1.0, "a share of some values");
  std::ranges::sort(values, std::greater{});
  const auto count =
      static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size()) - 1e-9));
  return values[std::max<std::size_t>(count, 1) - 1];
}

UnknownDetection detection_of(std::span<const Trial> known, const UnknownTrials& unknown,
                              std::uint64_t seed) {
  expects(!known.empty() && !unknown.trials.empty(), "trials of both kinds");
  const Clusters known_objects = clusters_of_objects(known);
  const Clusters unknown_objects = clusters_of_objects(unknown.trials);
  const std::vector<double> of_known = probabilities(known, all_of(known_objects));
  const std::vector<double> of_unknown = probabilities(unknown.trials, all_of(unknown_objects));
  UnknownDetection detection{.area = area_under_curve(of_unknown, of_known),
                             .area_interval = {},
                             .threshold = found_above(of_unknown, kFound)};
  detection.false_alarms = share_above(of_known, detection.threshold);
  detection.found = held_for_unknown(of_unknown);
  detection.known_missed = held_for_unknown(of_known);
  detection.category_known_right = category_right(unknown, true);
  detection.category_unknown_right = category_right(unknown, false);
  Rng rng = Rng::stream(seed, "unknown objects");
  std::vector<double> areas;
  std::vector<double> alarms;
  for (int r = 0; r < kResamples; ++r) {
    const std::vector<double> low = probabilities(known, resampled(known_objects, rng));
    const std::vector<double> high = probabilities(unknown.trials, resampled(unknown_objects, rng));
    areas.push_back(area_under_curve(high, low));
    alarms.push_back(share_above(low, found_above(high, kFound)));
  }
  detection.area_interval = {quantile(areas, 0.025), quantile(areas, 0.975)};
  detection.false_alarms_interval = {quantile(alarms, 0.025), quantile(alarms, 0.975)};
  return detection;
}

}  // namespace vantage
