#include "vantage/information/mixture_bounds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

#include "vantage/information/discrete.hpp"

namespace vantage {
namespace {

using Divergences = Eigen::Ref<const Eigen::MatrixXf>;

Eigen::Index size_of(std::span<const double> b) { return static_cast<Eigen::Index>(b.size()); }

Eigen::Map<const Eigen::VectorXd> vector_of(std::span<const double> b) {
  return {b.data(), size_of(b)};
}

void require_components(std::span<const double> b, const Divergences& D,
                        std::string_view function) {
  entropy_bits(b);  // throws if b is no distribution
  if (D.rows() != size_of(b) || D.cols() != size_of(b)) {
    throw DistributionError(fmt::format("{}: {} components and {} x {} divergences", function,
                                        b.size(), D.rows(), D.cols()));
  }
  for (Eigen::Index j = 0; j < D.cols(); ++j) {
    for (Eigen::Index i = 0; i < D.rows(); ++i) {
      if (D(i, j) >= 0.0F) continue;
      throw DistributionError(
          fmt::format("{}: D({}, {}) = {} must not be negative", function, i, j, D(i, j)));
    }
  }
}

void require_groups(std::span<const double> b, std::span<const int> group,
                    std::string_view function) {
  if (group.size() != b.size()) {
    throw DistributionError(
        fmt::format("{}: {} components and {} groups", function, b.size(), group.size()));
  }
  for (const int g : group) {
    if (g < 0) throw DistributionError(fmt::format("{}: group {} must be >= 0", function, g));
  }
}

Eigen::MatrixXd overlaps(const Divergences& D) { return (-D.cast<double>().array()).exp(); }

/// Numbers the groups that occur from 0.
std::vector<Eigen::Index> dense(std::span<const int> group) {
  std::vector<int> known(group.begin(), group.end());
  std::ranges::sort(known);
  known.erase(std::unique(known.begin(), known.end()), known.end());
  std::vector<Eigen::Index> numbers;
  for (const int g : group) numbers.push_back(std::ranges::lower_bound(known, g) - known.begin());
  return numbers;
}

Eigen::VectorXd masses(std::span<const double> b, const std::vector<Eigen::Index>& group) {
  Eigen::VectorXd mass = Eigen::VectorXd::Zero(*std::ranges::max_element(group) + 1);
  for (std::size_t i = 0; i < b.size(); ++i) mass[group[i]] += b[i];
  return mass;
}

/// -sum b log2 x, at least 0; entries with b = 0 count for nothing.
double expected_surprise_bits(const Eigen::Ref<const Eigen::VectorXd>& b,
                              const Eigen::Ref<const Eigen::VectorXd>& x) {
  double bits = 0.0;
  for (Eigen::Index i = 0; i < b.size(); ++i) {
    if (b[i] > 0.0) bits -= b[i] * std::log2(x[i]);
  }
  return std::max(bits, 0.0);
}

}  // namespace

double pairwise_information_bits(std::span<const double> b, const Divergences& D) {
  require_components(b, D, "pairwise_information_bits");
  return expected_surprise_bits(vector_of(b), overlaps(D) * vector_of(b));
}

double pairwise_group_information_bits(std::span<const double> b, std::span<const int> group,
                                       const Divergences& D) {
  require_components(b, D, "pairwise_group_information_bits");
  require_groups(b, group, "pairwise_group_information_bits");
  const Eigen::MatrixXd overlap = overlaps(D);
  const auto number = dense(group);
  const Eigen::VectorXd mass = masses(b, number);
  Eigen::VectorXd ratio = overlap * vector_of(b);
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (b[i] == 0.0) continue;
    double own = 0.0;
    for (std::size_t j = 0; j < b.size(); ++j) {
      if (number[j] == number[i]) {
        own += b[j] * overlap(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      }
    }
    ratio[static_cast<Eigen::Index>(i)] *= mass[number[i]] / own;
  }
  return expected_surprise_bits(vector_of(b), ratio);
}

double group_information_upper_bound_bits(std::span<const double> b, std::span<const int> group,
                                          const Divergences& D) {
  require_components(b, D, "group_information_upper_bound_bits");
  require_groups(b, group, "group_information_upper_bound_bits");
  const auto number = dense(group);
  const Eigen::VectorXd mass = masses(b, number);
  Eigen::MatrixXd share = Eigen::MatrixXd::Zero(size_of(b), mass.size());
  for (std::size_t i = 0; i < b.size(); ++i) {
    const double total = mass[number[i]];
    if (total > 0.0) share(static_cast<Eigen::Index>(i), number[i]) = b[i] / total;
  }
  // Finite, so that a share of 0 times it is 0.
  const Eigen::MatrixXd log_overlap =
      (overlaps(D) * share).array().max(std::numeric_limits<double>::min()).log();
  Eigen::MatrixXd overlap = (share.transpose() * log_overlap).array().exp();
  overlap.diagonal().setOnes();
  return expected_surprise_bits(mass, overlap * mass);
}

}  // namespace vantage
