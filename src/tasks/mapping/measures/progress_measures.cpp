#include "vantage/tasks/mapping/measures/progress_measures.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace vantage {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array kShares_percent{80, 90, 95, 97, 98};

double share_left(const ScanRecord& scan, std::size_t observable_cells) {
  if (observable_cells == 0) return 0.0;
  return static_cast<double>(scan.observable_unobserved_cells) /
         static_cast<double>(observable_cells);
}

double area_over_time_s(std::span<const ScanRecord> scans, std::size_t observable_cells) {
  double area_s = 0.0;
  double share = 1.0;
  double since_s = 0.0;
  for (const ScanRecord& scan : scans) {
    area_s += share * (scan.time_s - since_s);
    share = share_left(scan, observable_cells);
    since_s = scan.time_s;
  }
  return area_s;
}

/// The share left as it steps down along another quantity of the scans, sampled evenly.
Curve sampled(const MeasuredEpisode& episode, const char* along, double step) {
  const Curve cells_left = step_values(episode, "scans", "observable_unobserved_cells");
  const auto& scans = episode.metrics.at("scans");
  if (scans.empty() || !scans.front().contains(along)) return {};
  const Curve at = step_values(episode, "scans", along);
  const double all = episode.metrics.at("observable_cells").get<double>();
  Curve shares;
  if (at.empty() || all <= 0.0) return shares;
  const auto samples = static_cast<std::size_t>(std::ceil(at.back() / step)) + 1;
  std::size_t done = 0;
  for (std::size_t k = 0; k < samples; ++k) {
    while (done < at.size() && at[done] <= static_cast<double>(k) * step) ++done;
    shares.push_back(done == 0 ? 1.0 : cells_left[done - 1] / all);
  }
  return shares;
}

}  // namespace

void add_progress(std::span<const ScanRecord> scans, std::size_t observable_cells, Json& metrics) {
  for (const int percent : kShares_percent) {
    const double left = 0.01 * (100 - percent);
    const auto there = std::ranges::find_if(
        scans, [&](const ScanRecord& scan) { return share_left(scan, observable_cells) <= left; });
    const bool reached = there != scans.end();
    metrics[fmt::format("time_to_{}_s", percent)] = reached ? Json(there->time_s) : Json();
    metrics[fmt::format("path_to_{}_m", percent)] = reached ? Json(there->path_length_m) : Json();
    metrics[fmt::format("scans_to_{}", percent)] =
        reached ? Json(there - scans.begin() + 1) : Json();
  }
  metrics["area_over_time"] = area_over_time_s(scans, observable_cells);
}

std::optional<double> reached_95(const MeasuredEpisode& episode) {
  if (!episode.metrics.contains("time_to_95_s")) return {};
  return episode.metrics.at("time_to_95_s").is_null() ? 0.0 : 1.0;
}

Curve share_left_over_time(const MeasuredEpisode& episode) {
  return sampled(episode, "time_s", kAlongTime.step);
}

Curve share_left_over_path(const MeasuredEpisode& episode) {
  return sampled(episode, "path_length_m", kAlongPath.step);
}

}  // namespace vantage
