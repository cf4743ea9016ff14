#include "vantage/belief/objects/object_belief.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "vantage/core/error.hpp"
#include "vantage/information/discrete.hpp"
#include "vantage/information/log_space.hpp"

namespace vantage {
namespace {

std::span<const double> entries(const Eigen::VectorXd& vector) {
  return {vector.data(), static_cast<std::size_t>(vector.size())};
}

std::span<double> entries(Eigen::VectorXd& vector) {
  return {vector.data(), static_cast<std::size_t>(vector.size())};
}

int index_of_largest(const Eigen::VectorXd& p) {
  Eigen::Index largest = 0;
  p.maxCoeff(&largest);
  return static_cast<int>(largest);
}

}  // namespace

ObjectBelief uniform_belief(const ObjectStates& states) {
  expects(states.size() >= 1, "a belief is over some state");
  return {Eigen::VectorXd::Constant(states.size(), -std::log(states.size()))};
}

void predict(ObjectBelief& belief, const ObjectStates& states, const TransitionModel& transition,
             double motion_rad) {
  if (motion_rad == 0.0) return;
  const TransitionKernel kernel = kernel_of(transition, motion_rad, states.bins);
  belief.log_p = transition_forward(states, kernel, belief.log_p);
  normalise_log(entries(belief.log_p));
}

EvidenceResult update(ObjectBelief& belief,
                      const Eigen::Ref<const Eigen::VectorXd>& log_likelihood) {
  expects(log_likelihood.size() == belief.log_p.size(), "a likelihood for every state");
  for (Eigen::Index j = 0; j < log_likelihood.size(); ++j) {
    if (log_likelihood[j] < std::numeric_limits<double>::infinity()) continue;
    return {.log_evidence = 0.0,
            .reason = fmt::format("the log likelihood of state {} is {}", j, log_likelihood[j])};
  }
  Eigen::VectorXd posterior = belief.log_p + log_likelihood;
  if (posterior.maxCoeff() == -std::numeric_limits<double>::infinity()) {
    return {.log_evidence = -std::numeric_limits<double>::infinity(),
            .reason = "no state that is possible explains the feature"};
  }
  const double log_evidence = normalise_log(entries(posterior));
  belief.log_p = std::move(posterior);
  return {.log_evidence = log_evidence, .reason = {}};
}

Eigen::VectorXd p_state(const ObjectBelief& belief) {
  return belief.log_p.unaryExpr([](double log_p) { return std::exp(log_p); });
}

Eigen::VectorXd p_object(const ObjectStates& states, const ObjectBelief& belief) {
  const Eigen::VectorXd p = p_state(belief);
  return p.reshaped(states.bins, states.object_count()).colwise().sum().transpose();
}

Eigen::VectorXd p_category(const ObjectStates& states, const ObjectBelief& belief) {
  const Eigen::VectorXd of_objects = p_object(states, belief);
  Eigen::VectorXd p = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(states.categories.size()));
  for (int k = 0; k < states.object_count(); ++k) {
    p[states.category_of[static_cast<std::size_t>(k)]] += of_objects[k];
  }
  return p;
}

double state_entropy_bits(const ObjectBelief& belief) {
  return entropy_bits_from_log(entries(belief.log_p));
}

double object_entropy_bits(const ObjectStates& states, const ObjectBelief& belief) {
  return entropy_bits(entries(p_object(states, belief)));
}

int most_probable_state(const ObjectBelief& belief) { return index_of_largest(belief.log_p); }

int most_probable_object(const ObjectStates& states, const ObjectBelief& belief) {
  return index_of_largest(p_object(states, belief));
}

double mean_yaw_rad(const ObjectStates& states, const ObjectBelief& belief, int object) {
  expects(object >= 0 && object < states.object_count(), "an object of the states");
  const auto log_p = belief.log_p.segment(states.state(object, 0), states.bins);
  const double largest = log_p.maxCoeff();
  if (largest == -std::numeric_limits<double>::infinity()) return 0.0;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  double sum = 0.0;
  for (int q = 0; q < states.bins; ++q) {
    const double p = std::exp(log_p[q] - largest);
    const double yaw_rad = q * states.bin_rad();
    mean += p * Eigen::Vector2d(std::cos(yaw_rad), std::sin(yaw_rad));
    sum += p;
  }
  constexpr double kNoDirection = 1e-9;
  if (mean.norm() < kNoDirection * sum) return 0.0;
  const double yaw_rad = std::atan2(mean.y(), mean.x());
  return yaw_rad < 0.0 ? yaw_rad + 2.0 * std::numbers::pi : yaw_rad;
}

int expected_state(const ObjectStates& states, const ObjectBelief& belief) {
  const int object = most_probable_object(states, belief);
  const double yaw_rad = mean_yaw_rad(states, belief, object);
  return states.state(object,
                      static_cast<int>(std::lround(yaw_rad / states.bin_rad())) % states.bins);
}

int bin_error(const ObjectStates& states, int state, int other) {
  const int apart = std::abs(states.bin_of(state) - states.bin_of(other));
  return std::min(apart, states.bins - apart);
}

}  // namespace vantage
