#include "vantage/planners/travel/travel_time.hpp"

#include <algorithm>
#include <array>

#include "vantage/core/error.hpp"

namespace vantage {

TravelTime::TravelTime(double speed_m_s) : least_s_per_m_(0.5 / speed_m_s) {
  expects(speed_m_s > 0.0, "a base that moves");
  constexpr double kStart_s = 2.5;
  // Corners and braking cost a tenth.
  const double s_per_m = 1.1 / speed_m_s;
  for (const double length_m : std::array{1.0, 8.0})
    observe(length_m, kStart_s + s_per_m * length_m);
}

void TravelTime::observe(double length_m, double time_s) {
  count_ += 1.0;
  length_ += length_m;
  length2_ += length_m * length_m;
  time_ += time_s;
  length_time_ += length_m * time_s;
  fit();
}

void TravelTime::fit() {
  const double spread = length2_ - length_ * length_ / count_;
  if (spread <= 0.0) return;
  s_per_m_ = std::max((length_time_ - length_ * time_ / count_) / spread, least_s_per_m_);
  start_s_ = std::max((time_ - s_per_m_ * length_) / count_, 0.0);
}

double TravelTime::of_m(double length_m) const { return start_s_ + s_per_m_ * length_m; }

}  // namespace vantage
