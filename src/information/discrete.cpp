#include "vantage/information/discrete.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string_view>

namespace vantage {
namespace {

using Joint = Eigen::Ref<const Eigen::MatrixXd>;

double minus_p_log2_p(double p) { return p > 0.0 ? -p * std::log2(p) : 0.0; }

/// p log2 (p / q), the summand of every divergence.
double relative_term(double p, double q) {
  if (p == 0.0) return 0.0;
  if (q == 0.0) return std::numeric_limits<double>::infinity();
  const double ratio = p / q;  // beyond what numbers hold where q is next to nothing
  return p * (std::isfinite(ratio) ? std::log2(ratio) : std::log2(p) - std::log2(q));
}

void require_sum_one(double sum, std::string_view function, std::string_view argument) {
  if (std::abs(sum - 1.0) > kSumTolerance) {
    throw DistributionError(fmt::format("{}: {} sums to {}, not to 1", function, argument, sum));
  }
}

bool is_mass(double p) { return p >= 0.0 && std::isfinite(p); }

void require_distribution(std::span<const double> p, std::string_view function,
                          std::string_view argument) {
  if (p.empty()) throw DistributionError(fmt::format("{}: {} is empty", function, argument));
  double sum = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (!is_mass(p[i])) {
      throw DistributionError(
          fmt::format("{}: {}[{}] = {} is not a probability", function, argument, i, p[i]));
    }
    sum += p[i];
  }
  require_sum_one(sum, function, argument);
}

void require_joint(const Joint& p_xy, std::string_view function) {
  if (p_xy.size() == 0) {
    throw DistributionError(
        fmt::format("{}: p_xy is empty ({} x {})", function, p_xy.rows(), p_xy.cols()));
  }
  for (Eigen::Index y = 0; y < p_xy.cols(); ++y) {
    for (Eigen::Index x = 0; x < p_xy.rows(); ++x) {
      if (is_mass(p_xy(x, y))) continue;
      throw DistributionError(
          fmt::format("{}: p_xy({}, {}) = {} is not a probability", function, x, y, p_xy(x, y)));
    }
  }
  require_sum_one(p_xy.sum(), function, "p_xy");
}

void require_pair(std::span<const double> p, std::span<const double> q, std::string_view function) {
  if (p.size() != q.size()) {
    throw DistributionError(
        fmt::format("{}: p has {} entries, q has {}", function, p.size(), q.size()));
  }
  require_distribution(p, function, "p");
  require_distribution(q, function, "q");
}

}  // namespace

double entropy_bits(std::span<const double> p) {
  require_distribution(p, "entropy_bits", "p");
  double bits = 0.0;
  for (const double mass : p) bits += minus_p_log2_p(mass);
  return std::max(bits, 0.0);
}

double joint_entropy_bits(const Joint& p_xy) {
  require_joint(p_xy, "joint_entropy_bits");
  return std::max(p_xy.unaryExpr(&minus_p_log2_p).sum(), 0.0);
}

double conditional_entropy_bits(const Joint& p_xy) {
  require_joint(p_xy, "conditional_entropy_bits");
  const Eigen::VectorXd p_x = p_xy.rowwise().sum();
  double bits = 0.0;
  for (Eigen::Index y = 0; y < p_xy.cols(); ++y) {
    for (Eigen::Index x = 0; x < p_xy.rows(); ++x) bits -= relative_term(p_xy(x, y), p_x[x]);
  }
  return std::max(bits, 0.0);
}

double mutual_information_bits(const Joint& p_xy) {
  require_joint(p_xy, "mutual_information_bits");
  const Eigen::VectorXd p_x = p_xy.rowwise().sum();
  const Eigen::RowVectorXd p_y = p_xy.colwise().sum();
  double bits = 0.0;
  for (Eigen::Index y = 0; y < p_xy.cols(); ++y) {
    for (Eigen::Index x = 0; x < p_xy.rows(); ++x) {
      // p(x, y) / p(x) / p(y): the product p(x) p(y) could underflow to zero.
      const double p = p_xy(x, y);
      if (p > 0.0) bits += p * std::log2(p / p_x[x] / p_y[y]);
    }
  }
  return std::max(bits, 0.0);
}

double kl_divergence_bits(std::span<const double> p, std::span<const double> q) {
  require_pair(p, q, "kl_divergence_bits");
  double bits = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i) bits += relative_term(p[i], q[i]);
  return std::max(bits, 0.0);
}

double jeffreys_divergence_bits(std::span<const double> p, std::span<const double> q) {
  require_pair(p, q, "jeffreys_divergence_bits");
  double bits = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    bits += relative_term(p[i], q[i]) + relative_term(q[i], p[i]);
  }
  return std::max(bits, 0.0);
}

double binary_entropy_bits(double p) {
  if (!(p >= 0.0 && p <= 1.0)) {
    throw DistributionError(fmt::format("binary_entropy_bits: p = {} is not in [0, 1]", p));
  }
  return binary_entropy_bits_unchecked(p);
}

}  // namespace vantage
