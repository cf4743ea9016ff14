#include "vantage/belief/objects/object_belief.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <span>

#include "vantage/core/error.hpp"
#include "vantage/information/discrete.hpp"
#include "vantage/information/log_space.hpp"

namespace vantage {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

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

ObjectBelief prior_belief(const ObjectStates& states, double p_unknown) {
  if (states.unknown_category.empty()) return uniform_belief(states);
  expects(states.known_size() >= 1 && p_unknown >= 0.0 && p_unknown < 1.0, "a probability");
  const auto of_none = std::ranges::count(states.unknown_category, kNoCategory);
  const auto of_some = std::ssize(states.unknown_category) - of_none;
  const double share = of_none > 0 && of_some > 0 ? 0.5 : 1.0;
  ObjectBelief prior{Eigen::VectorXd::Constant(
      states.size(), std::log1p(-p_unknown) - std::log(states.known_size()))};
  for (int u = 0; u < states.unknown_size(); ++u) {
    const bool none = states.unknown_category[static_cast<std::size_t>(u)] == kNoCategory;
    prior.log_p[states.known_size() + u] =
        std::log(p_unknown * share / static_cast<double>(none ? of_none : of_some));
  }
  return prior;
}

void spread_over_seen(const ObjectStates& states, std::span<const int> unseen,
                      ObjectBelief& belief) {
  std::map<int, Eigen::VectorXd> of_object;  // of which some are unseen
  for (const int state : unseen) {
    const int object = states.object_of(state);
    const auto bins = belief.log_p.segment(states.state(object, 0), states.bins);
    of_object.try_emplace(object, bins).first->second[states.bin_of(state)] = -kInfinity;
  }
  for (auto& [object, left] : of_object) {
    auto bins = belief.log_p.segment(states.state(object, 0), states.bins);
    const double log_left = log_sum_exp(entries(left));
    if (log_left == -kInfinity) continue;
    bins = left.array() + (log_sum_exp(entries(bins.eval())) - log_left);
  }
}

void forget_yaw(const ObjectStates& states, std::span<const int> unseen, ObjectBelief& belief) {
  const Eigen::VectorXd log_object = p_object(states, belief).array().log();
  for (int k = 0; k < states.object_count(); ++k) {
    belief.log_p.segment(states.state(k, 0), states.bins)
        .setConstant(log_object[k] - std::log(states.bins));
  }
  spread_over_seen(states, unseen, belief);
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
  return p.head(states.known_size())
      .reshaped(states.bins, states.object_count())
      .colwise()
      .sum()
      .transpose();
}

Eigen::VectorXd p_category(const ObjectStates& states, const ObjectBelief& belief) {
  const Eigen::VectorXd of_objects = p_object(states, belief);
  Eigen::VectorXd p = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(states.categories.size()));
  for (int k = 0; k < states.object_count(); ++k) {
    p[states.category_of[static_cast<std::size_t>(k)]] += of_objects[k];
  }
  for (int u = 0; u < states.unknown_size(); ++u) {
    const int category = states.unknown_category[static_cast<std::size_t>(u)];
    if (category != kNoCategory) p[category] += std::exp(belief.log_p[states.known_size() + u]);
  }
  return p;
}

double p_unknown(const ObjectStates& states, const ObjectBelief& belief) {
  if (states.unknown_category.empty()) return 0.0;
  return belief.log_p.tail(states.unknown_size()).array().exp().sum();
}

bool is_unknown(const ObjectStates& states, const ObjectBelief& belief) {
  return p_unknown(states, belief) > 0.5;
}

int unknown_category(const ObjectStates& states, const ObjectBelief& belief) {
  expects(states.unknown_size() > 0, "a hypothesis of unknown objects");
  const int best = index_of_largest(belief.log_p.tail(states.unknown_size()));
  return states.unknown_category[static_cast<std::size_t>(best)];
}

ObjectEstimate estimate_of(const ObjectStates& states, const ObjectBelief& belief) {
  const auto category_name = [&](int category) {
    return category == kNoCategory ? std::string(kUnknown)
                                   : states.categories[static_cast<std::size_t>(category)];
  };
  // Sums of probabilities round to a little above 1.
  if (is_unknown(states, belief)) {
    return {.object = kUnknown,
            .category = category_name(unknown_category(states, belief)),
            .probability = std::min(1.0, p_unknown(states, belief))};
  }
  const Eigen::VectorXd p = p_object(states, belief);
  const int best = index_of_largest(p);
  const auto object = static_cast<std::size_t>(best);
  return {.object = states.objects[object],
          .category = category_name(states.category_of[object]),
          .probability = std::min(1.0, p[best])};
}

double state_entropy_bits(const ObjectBelief& belief) {
  return entropy_bits_from_log(entries(belief.log_p));
}

double object_entropy_bits(const ObjectStates& states, const ObjectBelief& belief) {
  Eigen::VectorXd p = p_object(states, belief);
  if (states.unknown_size() > 0) {
    p.conservativeResize(p.size() + 1);
    p[p.size() - 1] = p_unknown(states, belief);
  }
  return entropy_bits(entries(p));
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
