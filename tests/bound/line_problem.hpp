/// Views on a line: ways between them can be told by heart.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "vantage/bound/cover_problem.hpp"

namespace vantage::test {

/// At those x, the k-th of which shows cell k.
inline CoverProblem views_at(const std::vector<double>& x_m) {
  CoverProblem problem;
  problem.speed_m_s = 1.0;
  problem.scan_s = 1.0;
  const auto n = static_cast<Eigen::Index>(x_m.size());
  problem.way_m = Eigen::MatrixXd::Zero(n, n);
  for (std::size_t i = 0; i < x_m.size(); ++i) {
    problem.shows.emplace_back((x_m.size() + 63) / 64, 0);
    problem.shows[i][i / 64] = std::uint64_t{1} << (i % 64);
    for (std::size_t j = 0; j < x_m.size(); ++j) {
      problem.way_m(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          std::abs(x_m[i] - x_m[j]);
    }
  }
  return problem;
}

/// `views` of them, half a metre from one to the next.
inline CoverProblem evenly_spaced_views(std::size_t views) {
  std::vector<double> x_m;
  for (std::size_t i = 0; i < views; ++i) x_m.push_back(0.5 * static_cast<double>(i));
  return views_at(x_m);
}

}  // namespace vantage::test
