#include "vantage/information/resampling.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <vector>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {

constexpr std::size_t kMaxEnumerated = 16;

/// Linear between order statistics (type 7); puts the values in another order.  [HyndmanFan1996]
double quantile(std::vector<double>& values, double share) {
  const double at = share * static_cast<double>(values.size() - 1);
  const double rest = at - std::floor(at);
  const auto below = values.begin() + static_cast<std::ptrdiff_t>(at);
  std::ranges::nth_element(values, below);
  if (rest == 0.0) return *below;
  return (1.0 - rest) * *below + rest * *std::min_element(below + 1, values.end());
}

/// `statistic()` is that of one resample.
template <class Statistic>
Interval percentile_interval(const BootstrapOptions& options, Statistic&& statistic) {
  expects(options.resamples > 0, "a bootstrap needs resamples");
  std::vector<double> found(static_cast<std::size_t>(options.resamples));
  for (double& value : found) value = statistic();
  const double tail = 0.5 * (1.0 - options.confidence);
  const double low = quantile(found, tail);
  return {low, quantile(found, 1.0 - tail)};
}

Clusters each_alone(std::size_t count) {
  Clusters clusters(count);
  for (std::size_t i = 0; i < count; ++i) clusters[i] = {i};
  return clusters;
}

/// The sum with the sign of each value turned where its bit in `pattern` is set.
double flipped_sum(std::span<const double> values, std::uint64_t pattern) {
  double sum = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    sum += (pattern >> i & 1U) != 0 ? -values[i] : values[i];
  }
  return sum;
}

double randomly_flipped_sum(std::span<const double> values, Rng& rng) {
  double sum = 0.0;
  for (std::size_t begin = 0; begin < values.size(); begin += 64) {
    const auto count = std::min<std::size_t>(64, values.size() - begin);
    sum += flipped_sum(values.subspan(begin, count), rng.next());
  }
  return sum;
}

}  // namespace

double mean(std::span<const double> values) {
  expects(!values.empty(), "the mean of no values");
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

Clusters clusters_of(std::span<const std::size_t> marks) {
  Clusters clusters;
  std::map<std::size_t, std::size_t> place;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const auto [entry, is_new] = place.try_emplace(marks[i], clusters.size());
    if (is_new) clusters.emplace_back();
    clusters[entry->second].push_back(i);
  }
  return clusters;
}

std::vector<double> cluster_sums(std::span<const double> values, const Clusters& clusters) {
  std::vector<double> sums;
  for (const auto& cluster : clusters) {
    double sum = 0.0;
    for (const std::size_t i : cluster) sum += values[i];
    sums.push_back(sum);
  }
  return sums;
}

Interval bootstrap_mean(std::span<const double> values, Rng& rng, const BootstrapOptions& options) {
  return bootstrap_mean(values, each_alone(values.size()), rng, options);
}

Interval bootstrap_mean(std::span<const double> values, const Clusters& clusters, Rng& rng,
                        const BootstrapOptions& options) {
  expects(!values.empty(), "a bootstrap of no values");
  const std::vector<double> ones(values.size(), 1.0);
  return bootstrap_ratio(values, ones, clusters, rng, options);
}

Interval bootstrap_ratio(std::span<const double> numerators, std::span<const double> denominators,
                         Rng& rng, const BootstrapOptions& options) {
  return bootstrap_ratio(numerators, denominators, each_alone(numerators.size()), rng, options);
}

Interval bootstrap_ratio(std::span<const double> numerators, std::span<const double> denominators,
                         const Clusters& clusters, Rng& rng, const BootstrapOptions& options) {
  expects(!numerators.empty() && numerators.size() == denominators.size(),
          "a ratio needs as many numerators as denominators");
  expects(!clusters.empty(), "values are in clusters");
  const std::vector<double> above_of = cluster_sums(numerators, clusters);
  const std::vector<double> below_of = cluster_sums(denominators, clusters);
  return percentile_interval(options, [&] {
    double above = 0.0;
    double below = 0.0;
    for (std::size_t i = 0; i < clusters.size(); ++i) {
      const auto drawn = rng.uniform_index(clusters.size());
      above += above_of[drawn];
      below += below_of[drawn];
    }
    return below == 0.0 ? std::numeric_limits<double>::infinity() : above / below;
  });
}

double sign_flip_p_value(std::span<const double> differences, Rng& rng, int draws) {
  expects(!differences.empty(), "a test of no differences");
  double size = 0.0;
  double total = 0.0;
  for (const double difference : differences) {
    size += std::abs(difference);
    total += difference;
  }
  const double threshold = std::abs(total) - 1e-12 * size;  // equal but for rounding is equal
  if (differences.size() <= kMaxEnumerated) {
    const std::uint64_t patterns = std::uint64_t{1} << differences.size();
    std::uint64_t extreme = 0;
    for (std::uint64_t pattern = 0; pattern < patterns; ++pattern) {
      extreme += std::abs(flipped_sum(differences, pattern)) >= threshold ? 1 : 0;
    }
    return static_cast<double>(extreme) / static_cast<double>(patterns);
  }
  int extreme = 1;
  for (int draw = 0; draw < draws; ++draw) {
    extreme += std::abs(randomly_flipped_sum(differences, rng)) >= threshold ? 1 : 0;
  }
  return static_cast<double>(extreme) / static_cast<double>(draws + 1);
}

}  // namespace vantage
