#include "vantage/tasks/wait/wait_parts.hpp"

#include <algorithm>
#include <cmath>

namespace vantage {

WaitParts::WaitParts(const Wait& task, std::uint64_t seed, TurningRobotInterface& robot,
                     WaitRecorder& recorder)
    : task_(task), robot_(robot), recorder_(recorder), choice_rng_(Rng::stream(seed, "wait")) {}

void WaitParts::update(const PlanarScan& scan) {
  const auto returns =
      std::ranges::count_if(scan.range_m, [](float range_m) { return std::isfinite(range_m); });
  records_.push_back({robot_.time_s(), static_cast<std::size_t>(returns)});
}

void WaitParts::record() { recorder_.scan(records_.back(), records_.size()); }

std::string WaitParts::finished() const {
  return records_.size() >= static_cast<std::size_t>(task_.scans) ? "all scans" : "";
}

std::vector<double> WaitParts::propose() const {
  return {task_.turning_rate_rad_s, -task_.turning_rate_rad_s};
}

std::size_t WaitParts::choose(const std::vector<double>& rates_rad_s) {
  return choice_rng_.uniform_index(rates_rad_s.size());
}

}  // namespace vantage
