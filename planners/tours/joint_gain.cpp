#include "vantage/planners/tours/joint_gain.hpp"

namespace vantage {

JointGain::JointGain(const PlanningProblem& problem) : problem_(problem), left_(problem.cells) {}

double JointGain::of_adding(std::size_t view) const {
  const ShownShares& shown = problem_.shows[view];
  float sum = 0.0F;
  for (std::size_t i = 0; i < shown.block.size(); ++i)
    sum += shown.share[i] * left_[shown.block[i]];
  return static_cast<double>(sum);
}

double JointGain::add(std::size_t view) {
  const ShownShares& shown = problem_.shows[view];
  float sum = 0.0F;
  for (std::size_t i = 0; i < shown.block.size(); ++i) {
    float& left = left_[shown.block[i]];
    const float added = shown.share[i] * left;
    left -= added;
    sum += added;
  }
  added_.push_back(view);
  total_ += static_cast<double>(sum);
  return static_cast<double>(sum);
}

void JointGain::clear() {
  for (const std::size_t view : added_) {
    for (const std::uint32_t block : problem_.shows[view].block) {
      left_[block] = problem_.cells[block];
    }
  }
  added_.clear();
  total_ = 0.0;
}

double joint_gain(const PlanningProblem& problem, std::span<const std::size_t> views) {
  JointGain gain(problem);
  for (const std::size_t view : views) gain.add(view);
  return gain.total();
}

}  // namespace vantage
