#include "vantage/tasks/mapping/scan_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "vantage/core/log.hpp"
#include "vantage/core/strategy_label.hpp"
#include "vantage/planners/swept_gain.hpp"

namespace vantage {
namespace {

/// NaN if that gain was not recorded.
double predicted_by(const ScanRecord& scan, std::string_view gain) {
  const auto found =
      std::ranges::find(scan.predicted_cells, gain, &std::pair<std::string, double>::first);
  return found == scan.predicted_cells.end() ? std::numeric_limits<double>::quiet_NaN()
                                             : found->second;
}

}  // namespace

std::vector<Predictor> recorded_predictors(const Episode& episode) {
  std::vector<Gain> gains = episode.metrics.predictors;
  if (gains.empty()) {
    gains = cell_predictors();
    if (episode.in_office())
      std::erase_if(gains, [](const Gain& gain) { return !can_sweep(gain); });
  }
  if (predicts_cells(episode.gain)) gains.push_back(episode.gain);
  std::vector<Predictor> predictors;
  for (Gain& gain : gains) {
    std::string label = strategy_label(gain);
    if (std::ranges::find(predictors, label, &Predictor::label) != predictors.end()) continue;
    predictors.push_back({std::move(label), std::move(gain)});
  }
  return predictors;
}

std::vector<std::pair<std::string, double>> predicted_cells(const Episode& episode,
                                                            const GainContext& context,
                                                            const Pose& T_world_sensor,
                                                            const FieldOfView& field_of_view) {
  std::array<Candidate, 1> view;
  view.front().T_world_sensor = T_world_sensor;
  std::vector<std::pair<std::string, double>> predictions;
  for (const auto& [label, gain] : recorded_predictors(episode)) {
    const auto gains_bits = view_gains_bits(gain, context, view, field_of_view, episode.threads);
    predictions.emplace_back(label, gains_bits.front());
  }
  return predictions;
}

MapPanelInput panel_of_scans(const Episode& episode, std::span<const ScanRecord> scans) {
  MapPanelInput input;
  input.scans_planned = episode.scans;
  input.method = method_name(episode);
  for (const ScanRecord& scan : scans) {
    input.T_world_chosen.push_back(scan.T_world_sensor);
    input.observable_unobserved_cells.push_back(
        static_cast<double>(scan.observable_unobserved_cells));
  }
  if (scans.empty()) return input;
  input.predicted_new_cells = predicted_by(scans.back(), strategy_label(episode.gain));
  input.actual_new_cells = scans.back().actual_new_cells;
  return input;
}

void log_scan(const ScanRecord& scan, std::size_t index) {
  log_debug(fmt::format(
      "scan {}: view {}{}, {} new cells, {} observable left, pose error {:.1f} mm", index,
      scan.chosen_view, scan.fallback ? " (fallback)" : "", scan.actual_new_cells,
      scan.observable_unobserved_cells, 1e3 * scan.pose_error_m));
}

}  // namespace vantage
