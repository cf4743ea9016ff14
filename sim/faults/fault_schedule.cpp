#include "vantage/sim/faults/fault_schedule.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "vantage/core/rng.hpp"

namespace vantage {
namespace {

std::int64_t interval_at(double time_s, double length_s) {
  return static_cast<std::int64_t>(std::floor((time_s + kSameMoment_s) / length_s));
}

}  // namespace

Stretches::Stretches(std::uint64_t seed, std::string stream, double share, double length_s)
    : seed_(seed), stream_(std::move(stream)), share_(share), length_s_(length_s) {}

bool Stretches::cover(double time_s) const {
  if (share_ <= 0.0) return false;
  const std::int64_t stretch = interval_at(time_s, length_s_);
  return Rng::stream(seed_, fmt::format("{} {}", stream_, stretch)).uniform() < share_;
}

Gusts::Gusts(std::uint64_t seed, double force_max_N, double every_s, double duration_s)
    : seed_(seed), force_max_N_(force_max_N), every_s_(every_s), duration_s_(duration_s) {}

Eigen::Vector3d Gusts::force_world_N(double time_s) const {
  if (force_max_N_ <= 0.0) return Eigen::Vector3d::Zero();
  const std::int64_t interval = interval_at(time_s, every_s_);
  Rng draw = Rng::stream(seed_, fmt::format("fault gust {}", interval));
  const double start_s =
      static_cast<double>(interval) * every_s_ + draw.uniform(0.0, every_s_ - duration_s_);
  const double heading_rad = draw.uniform(0.0, 2.0 * std::numbers::pi);
  const double force_N = draw.uniform(0.5, 1.0) * force_max_N_;
  if (time_s < start_s || time_s >= start_s + duration_s_) return Eigen::Vector3d::Zero();
  return force_N * Eigen::Vector3d(std::cos(heading_rad), std::sin(heading_rad), 0.0);
}

}  // namespace vantage
