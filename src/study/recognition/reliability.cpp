#include "vantage/study/recognition/reliability.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "vantage/core/error.hpp"
#include "vantage/information/quantile.hpp"

namespace vantage {
namespace {

constexpr int kReliabilityResamples = 1000;

std::size_t bin_of(double probability) {
  const int bin = static_cast<int>(probability * kReliabilityBins);
  return static_cast<std::size_t>(std::clamp(bin, 0, kReliabilityBins - 1));
}

struct BinSum {
  double count = 0.0;
  double confidence = 0.0;
  double right = 0.0;
};
using BinSums = std::array<BinSum, kReliabilityBins>;

BinSums sums_of(std::span<const Trial> trials, std::span<const std::size_t> of) {
  BinSums sums;
  for (const std::size_t i : of) {
    BinSum& sum = sums[bin_of(trials[i].probability)];
    sum.count += 1.0;
    sum.confidence += trials[i].probability;
    sum.right += trials[i].correct ? 1.0 : 0.0;
  }
  return sums;
}

void add(BinSums& sums, const BinSums& more) {
  for (std::size_t b = 0; b < sums.size(); ++b) {
    sums[b].count += more[b].count;
    sums[b].confidence += more[b].confidence;
    sums[b].right += more[b].right;
  }
}

double error_of(const BinSums& sums) {
  double error = 0.0;
  double count = 0.0;
  for (const BinSum& sum : sums) {
    error += std::abs(sum.right - sum.confidence);
    count += sum.count;
  }
  return error / count;
}

Interval interval_of(std::vector<double>& values) {
  if (values.empty()) return {};
  return {quantile(values, 0.025), quantile(values, 0.975)};
}

}  // namespace

Clusters clusters_of_objects(std::span<const Trial> trials) {
  std::map<std::string, std::size_t> index;
  std::vector<std::size_t> marks;
  for (const Trial& trial : trials) {
    marks.push_back(index.emplace(trial.name, index.size()).first->second);
  }
  return clusters_of(marks);
}

Reliability reliability_of(std::span<const Trial> trials, std::uint64_t seed) {
  expects(!trials.empty(), "some trials");
  std::vector<BinSums> objects;
  BinSums all;
  for (const auto& of : clusters_of_objects(trials)) {
    objects.push_back(sums_of(trials, of));
    add(all, objects.back());
  }
  Rng rng = Rng::stream(seed, "reliability");
  std::vector<double> errors;
  std::array<std::vector<double>, kReliabilityBins> accuracies;
  for (int r = 0; r < kReliabilityResamples; ++r) {
    BinSums drawn;
    for (std::size_t i = 0; i < objects.size(); ++i) {
      add(drawn, objects[rng.uniform_index(objects.size())]);
    }
    errors.push_back(error_of(drawn));
    for (std::size_t b = 0; b < drawn.size(); ++b) {
      if (drawn[b].count > 0.0) accuracies[b].push_back(drawn[b].right / drawn[b].count);
    }
  }
  Reliability reliability{
      .bins = {}, .error = error_of(all), .error_interval = interval_of(errors)};
  for (std::size_t b = 0; b < all.size(); ++b) {
    reliability.confidence += all[b].confidence / static_cast<double>(trials.size());
    reliability.accuracy += all[b].right / static_cast<double>(trials.size());
    if (all[b].count == 0.0) continue;
    reliability.bins[b] = {.count = static_cast<std::size_t>(all[b].count),
                           .objects = static_cast<std::size_t>(std::ranges::count_if(
                               objects, [b](const BinSums& sums) { return sums[b].count > 0.0; })),
                           .confidence = all[b].confidence / all[b].count,
                           .accuracy = all[b].right / all[b].count,
                           .interval = interval_of(accuracies[b])};
  }
  return reliability;
}

Figure reliability_figure(const std::vector<ReliabilityPanel>& panels) {
  Figure figure{.name = "reliability",
                .title = "Reliability of P(object)",
                .subtitle =
                    "share of right answers by the probability that they are held for; on "
                    "the diagonal is honest, below it too sure",
                .x_label = "probability of the estimate",
                .y_label = "share that is right",
                .panels = {},
                .least_x_step = 0.1,
                .note =
                    "Trials in bins of equal width of the probability; band: 95 % bootstrap "
                    "interval over objects."};
  for (const ReliabilityPanel& panel : panels) {
    FigurePanel& drawn =
        figure.panels.emplace_back(FigurePanel{.title = panel.title, .series = {}});
    FigureSeries honest{.name = "honest", .style = 0, .points = {}};
    for (const double x : {0.0, 1.0}) {
      honest.points.push_back({.x = x, .count = 1, .clusters = 1, .mean = x, .interval = {x, x}});
    }
    drawn.series.push_back(std::move(honest));
    std::size_t style = 1;
    for (const auto& [method, reliability] : panel.methods) {
      FigureSeries series{.name = method, .style = style++, .points = {}};
      for (const ReliabilityBin& bin : reliability.bins) {
        if (bin.count == 0) continue;
        series.points.push_back({.x = bin.confidence,
                                 .count = bin.count,
                                 .clusters = bin.objects,
                                 .mean = bin.accuracy,
                                 .interval = bin.interval});
      }
      drawn.series.push_back(std::move(series));
    }
  }
  return figure;
}

}  // namespace vantage
