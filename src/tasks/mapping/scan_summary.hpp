/// What an episode says of its scans: how many new cells the gains expected of a view beside what
/// it showed.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "vantage/tasks/mapping/map_panel.hpp"
#include "vantage/tasks/mapping/scan_record.hpp"
#include "vantage/tasks/scenario.hpp"

namespace vantage {

struct Predictor {
  std::string label;
  Gain gain;
};
/// The gains whose prediction an episode records: MetricsOptions::predictors and the one in use.
std::vector<Predictor> recorded_predictors(const Episode& episode);

/// Per recorded predictor, what it expects of the view.
std::vector<std::pair<std::string, double>> predicted_cells(const Episode& episode,
                                                            const GainContext& context,
                                                            const Pose& T_world_sensor,
                                                            const FieldOfView& field_of_view);

/// What a panel shows of the scans so far.
MapPanelInput panel_of_scans(const Episode& episode, std::span<const ScanRecord> scans);

void log_scan(const ScanRecord& scan, std::size_t index);

}  // namespace vantage
