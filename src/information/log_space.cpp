#include "vantage/information/log_space.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string_view>

#include "vantage/information/discrete.hpp"

namespace vantage {
namespace {

using Joint = Eigen::Ref<const Eigen::MatrixXd>;

constexpr double kBitsPerNat = std::numbers::log2e;
constexpr double kMinusInfinity = -std::numeric_limits<double>::infinity();

std::span<const double> entries(const Eigen::MatrixXd& matrix) {
  return {matrix.data(), static_cast<std::size_t>(matrix.size())};
}

void require_logs(std::span<const double> logs, std::string_view function) {
  if (logs.empty()) throw DistributionError(fmt::format("{}: empty argument", function));
  for (std::size_t i = 0; i < logs.size(); ++i) {
    if (logs[i] < std::numeric_limits<double>::infinity()) continue;
    throw DistributionError(
        fmt::format("{}: entry {} = {} is not a log-probability", function, i, logs[i]));
  }
}

double log_sum(std::span<const double> logs) {
  const double largest = *std::ranges::max_element(logs);
  if (largest == kMinusInfinity) return kMinusInfinity;
  double sum = 0.0;
  for (const double entry : logs) sum += std::exp(entry - largest);
  return largest + std::log(sum);
}

void require_distribution(std::span<const double> log_p, std::string_view function) {
  require_logs(log_p, function);
  const double sum = std::exp(log_sum(log_p));
  if (!(std::abs(sum - 1.0) <= kSumTolerance)) {
    throw DistributionError(
        fmt::format("{}: the probabilities sum to {}, not to 1", function, sum));
  }
}

void require_log_pair(std::span<const double> log_p, std::span<const double> log_q,
                      std::string_view function) {
  if (log_p.size() != log_q.size()) {
    throw DistributionError(
        fmt::format("{}: p has {} entries, q has {}", function, log_p.size(), log_q.size()));
  }
  require_distribution(log_p, function);
  require_distribution(log_q, function);
}

/// p (ln p - ln q) in nats; infinite where q = 0 and p > 0, however small p is.
double log_relative_term(double log_p, double log_q) {
  if (log_p == kMinusInfinity) return 0.0;
  return log_q == kMinusInfinity ? -kMinusInfinity : std::exp(log_p) * (log_p - log_q);
}

double bits_of(double nats) { return std::max(nats * kBitsPerNat, 0.0); }

double entropy_nats(std::span<const double> log_p) {
  double nats = 0.0;
  for (const double entry : log_p) nats -= log_relative_term(entry, 0.0);
  return nats;
}

Eigen::VectorXd log_row_sums(const Eigen::MatrixXd& logs) {
  // Transposed, so that a row is contiguous.
  const Eigen::MatrixXd by_row = logs.transpose();
  Eigen::VectorXd sums(by_row.cols());
  const auto length = static_cast<std::size_t>(by_row.rows());
  for (Eigen::Index i = 0; i < by_row.cols(); ++i)
    sums[i] = log_sum({by_row.col(i).data(), length});
  return sums;
}

}  // namespace

double log_sum_exp(std::span<const double> log_weights) {
  require_logs(log_weights, "log_sum_exp");
  return log_sum(log_weights);
}

double normalise_log(std::span<double> log_weights) {
  require_logs(log_weights, "normalise_log");
  const double total = log_sum(log_weights);
  if (total == kMinusInfinity) {
    throw DistributionError("normalise_log: every entry is -inf, the sum of probabilities is 0");
  }
  for (double& entry : log_weights) entry -= total;
  return total;
}

double entropy_bits_from_log(std::span<const double> log_p) {
  require_distribution(log_p, "entropy_bits_from_log");
  return bits_of(entropy_nats(log_p));
}

double joint_entropy_bits_from_log(const Joint& log_p_xy) {
  const Eigen::MatrixXd logs = log_p_xy;
  require_distribution(entries(logs), "joint_entropy_bits_from_log");
  return bits_of(entropy_nats(entries(logs)));
}

double conditional_entropy_bits_from_log(const Joint& log_p_xy) {
  const Eigen::MatrixXd logs = log_p_xy;
  require_distribution(entries(logs), "conditional_entropy_bits_from_log");
  const Eigen::VectorXd log_p_x = log_row_sums(logs);
  double nats = 0.0;
  for (Eigen::Index y = 0; y < logs.cols(); ++y) {
    for (Eigen::Index x = 0; x < logs.rows(); ++x)
      nats -= log_relative_term(logs(x, y), log_p_x[x]);
  }
  return bits_of(nats);
}

double mutual_information_bits_from_log(const Joint& log_p_xy) {
  const Eigen::MatrixXd logs = log_p_xy;
  require_distribution(entries(logs), "mutual_information_bits_from_log");
  const Eigen::VectorXd log_p_x = log_row_sums(logs);
  const Eigen::VectorXd log_p_y = log_row_sums(logs.transpose());
  double nats = 0.0;
  for (Eigen::Index y = 0; y < logs.cols(); ++y) {
    for (Eigen::Index x = 0; x < logs.rows(); ++x) {
      nats += log_relative_term(logs(x, y), log_p_x[x] + log_p_y[y]);
    }
  }
  return bits_of(nats);
}

double kl_divergence_bits_from_log(std::span<const double> log_p, std::span<const double> log_q) {
  require_log_pair(log_p, log_q, "kl_divergence_bits_from_log");
  double nats = 0.0;
  for (std::size_t i = 0; i < log_p.size(); ++i) nats += log_relative_term(log_p[i], log_q[i]);
  return bits_of(nats);
}

double jeffreys_divergence_bits_from_log(std::span<const double> log_p,
                                         std::span<const double> log_q) {
  require_log_pair(log_p, log_q, "jeffreys_divergence_bits_from_log");
  double nats = 0.0;
  for (std::size_t i = 0; i < log_p.size(); ++i) {
    nats += log_relative_term(log_p[i], log_q[i]) + log_relative_term(log_q[i], log_p[i]);
  }
  return bits_of(nats);
}

}  // namespace vantage
