/// When how much was observed: the time, the way and the scans to a share of the observable cells.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "vantage/runtime/measure.hpp"
#include "vantage/tasks/mapping/driving/scan_record.hpp"

namespace vantage {

/// Adds `time_to_80_s`, `path_to_80_m`, `scans_to_80`, the same for 90, 95, 97 and 98 %, all null
/// where never reached, and `area_over_time`: the share of observable cells left, integrated over
/// the simulated time until the last scan, s. A share holds from one scan to the next.
void add_progress(std::span<const ScanRecord> scans, std::size_t observable_cells,
                  nlohmann::ordered_json& metrics);

/// Names of these keys, and what they are.
inline constexpr auto kProgressTexts =
    std::to_array<std::pair<std::string_view, std::string_view>>({
        {"time_to_80_s",
         "simulated time until 80 % of the observable cells were observed; null: never"},
        {"path_to_80_m", "way driven until then"},
        {"scans_to_80", "scans taken until then"},
        {"time_to_90_s",
         "simulated time until 90 % of the observable cells were observed; null: never"},
        {"path_to_90_m", "way driven until then"},
        {"scans_to_90", "scans taken until then"},
        {"time_to_95_s",
         "simulated time until 95 % of the observable cells were observed; null: never"},
        {"path_to_95_m", "way driven until then"},
        {"scans_to_95", "scans taken until then"},
        {"time_to_97_s",
         "simulated time until 97 % of the observable cells were observed; null: never"},
        {"path_to_97_m", "way driven until then"},
        {"scans_to_97", "scans taken until then"},
        {"time_to_98_s",
         "simulated time until 98 % of the observable cells were observed; null: never"},
        {"path_to_98_m", "way driven until then"},
        {"scans_to_98", "scans taken until then"},
        {"area_over_time",
         "share of the observable cells left, integrated over the simulated time, s; a share holds "
         "from "
         "one scan to the next"},
    });

/// What a study reads of them.
std::optional<double> reached_95(const MeasuredEpisode& episode);
inline constexpr CurveAxis kAlongTime{"simulated time, s", 0.0, 20.0};
inline constexpr CurveAxis kAlongPath{"distance travelled, m", 0.0, 1.0};
/// The share left at the steps of kAlongTime, up to the first from the last scan on.
Curve share_left_over_time(const MeasuredEpisode& episode);
/// At those of kAlongPath.
Curve share_left_over_path(const MeasuredEpisode& episode);

}  // namespace vantage
