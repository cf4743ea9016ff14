#include "src/episode/scan_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include "planners/exact_gain.hpp"
#include "planners/swept_gain.hpp"
#include "src/core/log.hpp"

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

std::vector<std::string_view> recorded_predictors(const Episode& episode) {
  std::vector<std::string_view> names = cell_predictors();
  if (!episode.in_office()) return names;
  std::erase_if(names, [&](std::string_view name) {
    return name != strategy_name_of(episode.gain) && !can_sweep(make_strategy<Gain>(name));
  });
  return names;
}

std::vector<std::pair<std::string, double>> predicted_cells(const Episode& episode,
                                                            const GainContext& context,
                                                            const Pose& T_world_sensor,
                                                            const FieldOfView& field_of_view) {
  std::array<Candidate, 1> view;
  view.front().T_world_sensor = T_world_sensor;
  std::vector<std::pair<std::string, double>> predictions;
  for (const std::string_view name : recorded_predictors(episode)) {
    const auto gain =
        name == strategy_name_of(episode.gain) ? episode.gain : make_strategy<Gain>(name);
    predictions.emplace_back(
        name, episode.in_office()
                  ? view_gains_bits(gain, context, view, field_of_view, episode.threads).front()
                  : exact_gain_bits(gain, context, T_world_sensor, field_of_view));
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
  input.predicted_new_cells = predicted_by(scans.back(), strategy_name_of(episode.gain));
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
