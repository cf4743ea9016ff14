#include "vantage/belief/objects/transition.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <span>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {

constexpr double kSumTolerance = 1e-6;

void require_sum_one(double sum, std::string_view what) {
  if (std::abs(sum - 1.0) <= kSumTolerance) return;
  throw ConfigError(fmt::format("{} sum to {}, not to 1", what, sum));
}

int wrapped(int bin, int bins) { return (bin % bins + bins) % bins; }

}  // namespace

MotionBins motion_bins(double motion_rad, int bins) {
  expects(std::isfinite(motion_rad) && bins >= 1, "a finite motion");
  // Commands are computed: a hair beside a multiple of the bin is the multiple.
  constexpr double kHair = 1e-9;
  const double turns = motion_rad / (2.0 * std::numbers::pi);
  const double in_bins = (turns - std::floor(turns)) * bins;
  const double lower = std::floor(in_bins + kHair);
  MotionBins motion;
  motion.lower = wrapped(static_cast<int>(lower), bins);
  motion.upper = wrapped(motion.lower + 1, bins);
  motion.upper_share = in_bins - lower > kHair ? in_bins - lower : 0.0;
  return motion;
}

void TableTransition::check() const {
  require_sum_one(right_angle + wrong_angle + other_instance + other_category,
                  "right_angle, wrong_angle, other_instance and other_category");
}

TransitionKernel TableTransition::kernel(double motion_rad, int bins) const {
  const MotionBins motion = motion_bins(motion_rad, bins);
  TransitionKernel kernel{.bin_change = Eigen::VectorXd::Ones(bins),
                          .same_object = right_angle + wrong_angle,
                          .other_instance = other_instance,
                          .other_category = other_category};
  if (bins == 1) return kernel;
  kernel.bin_change.setConstant(wrong_angle / kernel.same_object / (bins - 1));
  const int right = motion.upper_share < 0.5 ? motion.lower : motion.upper;
  kernel.bin_change[right] = right_angle / kernel.same_object;
  return kernel;
}

TransitionKernel RigidTransition::kernel(double motion_rad, int bins) const {
  const MotionBins motion = motion_bins(motion_rad, bins);
  TransitionKernel kernel{.bin_change = Eigen::VectorXd::Zero(bins)};
  const auto add = [&](int right, double mass) {
    kernel.bin_change[right] += mass * (1.0 - slip);
    kernel.bin_change[wrapped(right - 1, bins)] += mass * 0.5 * slip;
    kernel.bin_change[wrapped(right + 1, bins)] += mass * 0.5 * slip;
  };
  add(motion.lower, 1.0 - motion.upper_share);
  add(motion.upper, motion.upper_share);
  return kernel;
}

void LearnedTransition::check() const {
  require_sum_one(same_object + other_instance + other_category,
                  "same_object, other_instance and other_category");
  if (slip.empty() && same_object != 1.0) {
    throw ConfigError(
        "same_object: is of no effect without a slip: the model's own transition holds then");
  }
  const auto bins = static_cast<std::size_t>(std::lround(std::sqrt(slip.size())));
  if (bins * bins != slip.size()) {
    throw ConfigError(fmt::format("slip has {} numbers, not bins * bins", slip.size()));
  }
  for (std::size_t command = 0; command < bins; ++command) {
    double sum = 0.0;
    for (const double p : std::span(slip).subspan(command * bins, bins)) sum += p;
    require_sum_one(sum, fmt::format("slip: the numbers of a motion by {} bins", command));
  }
}

TransitionKernel LearnedTransition::kernel(double motion_rad, int bins) const {
  TransitionKernel kernel{.bin_change = Eigen::VectorXd::Zero(bins),
                          .same_object = same_object,
                          .other_instance = other_instance,
                          .other_category = other_category};
  if (slip.empty()) {
    kernel.bin_change = RigidTransition{}.kernel(motion_rad, bins).bin_change;
    return kernel;
  }
  const auto size = static_cast<std::size_t>(bins);
  if (slip.size() != size * size) {
    throw ConfigError(fmt::format("learned: slip has {} numbers, {} bins need {}", slip.size(),
                                  bins, size * size));
  }
  const Eigen::Map<const Eigen::MatrixXd> by_command(slip.data(), bins, bins);
  const MotionBins motion = motion_bins(motion_rad, bins);
  for (int d = 0; d < bins; ++d) {
    kernel.bin_change[wrapped(motion.lower + d, bins)] +=
        (1.0 - motion.upper_share) * by_command(d, motion.lower);
    kernel.bin_change[wrapped(motion.upper + d, bins)] +=
        motion.upper_share * by_command(d, motion.upper);
  }
  return kernel;
}

TransitionKernel kernel_of(const TransitionModel& model, double motion_rad, int bins) {
  return std::visit([&](const auto& m) { return m.kernel(motion_rad, bins); }, model);
}

}  // namespace vantage
