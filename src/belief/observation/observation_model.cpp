#include "vantage/belief/observation/observation_model.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {

using Feature = Eigen::Ref<const Eigen::VectorXf>;

/// Sums of so many terms stay in single precision; the blocks are added up in double.
constexpr Eigen::Index kBlock = 128;

void require_feature(Eigen::Index dimensions, const Feature& feature) {
  expects(feature.size() == dimensions, "a feature of as many dimensions as the model");
  expects(feature.allFinite(), "a feature of finite numbers");
}

/// Sum over the dimensions of `term(first, count)`, the sum over a run of them.
template <class Term>
double sum_in_blocks(Eigen::Index dimensions, const Term& term) {
  double sum = 0.0;
  for (Eigen::Index first = 0; first < dimensions; first += kBlock) {
    sum += static_cast<double>(term(first, std::min(kBlock, dimensions - first)));
  }
  return sum;
}

double log_two_pi(Eigen::Index dimensions) {
  return static_cast<double>(dimensions) * std::log(2.0 * std::numbers::pi);
}

}  // namespace

Eigen::VectorXd log_density(const ObservationModel& model, const Feature& feature) {
  require_feature(model.mean.rows(), feature);
  Eigen::VectorXd result(model.mean.cols());
  for (Eigen::Index j = 0; j < result.size(); ++j) {
    const double sum = sum_in_blocks(feature.size(), [&](Eigen::Index first, Eigen::Index count) {
      const auto variance = model.variance.col(j).segment(first, count).array();
      const auto error = feature.segment(first, count) - model.mean.col(j).segment(first, count);
      return (error.array().square() / variance + variance.log()).sum();
    });
    result[j] = -0.5 * (sum + log_two_pi(feature.size()));
  }
  if (model.log_factor.size() > 0) result += model.log_factor;
  return result;
}

Eigen::VectorXd log_likelihood(const ObservationModel& model, const Feature& feature) {
  if (model.psi == 0.0) return Eigen::VectorXd::Zero(model.states());
  return model.psi * log_density(model, feature);
}

PreparedObservationModel prepare(const ObservationModel& model) {
  PreparedObservationModel prepared{.mean = model.mean,
                                    .precision = model.variance.cwiseInverse(),
                                    .log_at_mean = Eigen::VectorXd(model.states()),
                                    .log_factor = Eigen::VectorXd::Zero(model.states()),
                                    .psi = model.psi};
  for (Eigen::Index j = 0; j < prepared.log_at_mean.size(); ++j) {
    const auto variance = model.variance.col(j).cast<double>().array();
    prepared.log_at_mean[j] = -0.5 * (variance.log().sum() + log_two_pi(variance.size()));
  }
  if (model.log_factor.size() > 0) prepared.log_factor = model.log_factor;
  prepared.log_at_mean += prepared.log_factor;
  return prepared;
}

Eigen::VectorXd log_likelihood(const PreparedObservationModel& model, const Feature& feature) {
  require_feature(model.mean.rows(), feature);
  if (model.psi == 0.0) return Eigen::VectorXd::Zero(model.mean.cols());
  Eigen::VectorXd result(model.mean.cols());
  for (Eigen::Index j = 0; j < result.size(); ++j) {
    const double sum = sum_in_blocks(feature.size(), [&](Eigen::Index first, Eigen::Index count) {
      const auto precision = model.precision.col(j).segment(first, count).array();
      const auto error = feature.segment(first, count) - model.mean.col(j).segment(first, count);
      return (error.array().square() * precision).sum();
    });
    result[j] = model.psi * (model.log_at_mean[j] - 0.5 * sum);
  }
  return result;
}

Eigen::VectorXd log_likelihood(const PreparedObservationModel& model, const Feature& feature,
                               std::span<const Reading> readings) {
  if (readings.empty()) return log_likelihood(model, feature);
  require_feature(model.mean.rows(), feature);
  expects(std::ssize(readings) == feature.size(), "a reading for each number");
  const bool tells = std::ranges::any_of(readings, [](Reading r) { return r != Reading::none; });
  if (model.psi == 0.0 || !tells) return Eigen::VectorXd::Zero(model.mean.cols());
  // Factors are of whole features: what tells of fewer numbers tells as much less of the unknown.
  const double exact = static_cast<double>(std::ranges::count(readings, Reading::exact)) /
                       static_cast<double>(readings.size());
  Eigen::VectorXd result = model.psi * model.log_factor;
  result.array() *=
      (model.log_factor.array() > kRulesOut).select(exact, Eigen::ArrayXd::Ones(result.size()));
  for (Eigen::Index j = 0; j < result.size(); ++j) {
    for (Eigen::Index d = 0; d < feature.size(); ++d) {
      result[j] += model.psi * log_likelihood(readings[static_cast<std::size_t>(d)], feature[d],
                                              model.mean(d, j),
                                              1.0 / static_cast<double>(model.precision(d, j)));
    }
  }
  return result;
}

}  // namespace vantage
