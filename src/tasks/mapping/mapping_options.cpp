#include "vantage/tasks/mapping/mapping_options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "vantage/core/names.hpp"

namespace vantage {
namespace {

constexpr double kMaxCells = 67108864.0;

std::string labels(const std::vector<Gain>& gains) {
  std::vector<std::string> names;
  for (const Gain& gain : gains) names.push_back(strategy_label(gain));
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

double MapOptions::count() const {
  const auto& n = cells ? *cells : kCells;
  return static_cast<double>(n[0]) * n[1] * n[2];
}

void MapOptions::check() const {
  if (cells && count() > kMaxCells) {
    const auto& n = *cells;
    throw ConfigError(fmt::format("cells: {} x {} x {} is more than 2^26 cells", n[0], n[1], n[2]));
  }
}

void MapOptions::fill_in() {
  centre_m = centre_m.value_or(kCentre_m);
  size_m = size_m.value_or(kSize_m);
  cells = cells.value_or(kCells);
}

void MetricsOptions::check() const {
  for (const Gain& gain : predictors) {
    if (predicts_cells(gain)) continue;
    throw ConfigError(fmt::format("predictors: '{}' does not predict cells; those that do: {}",
                                  strategy_name_of(gain), labels(cell_predictors())));
  }
}

std::string MappingOptions::method_name() const {
  if (std::holds_alternative<GreedyGain>(choice)) return strategy_label(gain);
  const std::string label = strategy_label(choice);
  return weighs_gain(choice) ? label + " of " + strategy_label(gain) : label;
}

double map_tolerance_m(const MappingOptions& options) {
  return options.localisation.tolerance_cells * options.map.frame().cell_size_m.maxCoeff();
}

std::vector<Predictor> recorded_predictors(const MappingOptions& options,
                                           const std::vector<Gain>& defaults) {
  std::vector<Gain> gains =
      options.metrics.predictors.empty() ? defaults : options.metrics.predictors;
  if (predicts_cells(options.gain)) gains.push_back(options.gain);
  std::vector<Predictor> predictors;
  for (const Gain& gain : gains) {
    std::string label = strategy_label(gain);
    if (std::ranges::find(predictors, label, &Predictor::label) != predictors.end()) continue;
    predictors.push_back({std::move(label), gain});
  }
  return predictors;
}

}  // namespace vantage
