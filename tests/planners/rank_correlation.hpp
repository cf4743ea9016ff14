#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace vantage::test {

/// Of values without ties.
inline std::vector<double> ranks(std::span<const double> values) {
  std::vector<double> result;
  for (const double value : values) {
    result.push_back(static_cast<double>(
        std::ranges::count_if(values, [&](double other) { return other < value; })));
  }
  return result;
}

/// [Spearman1904]
inline double rank_correlation(std::span<const double> a, std::span<const double> b) {
  const auto ranks_a = ranks(a);
  const auto ranks_b = ranks(b);
  const double middle = 0.5 * static_cast<double>(a.size() - 1);
  double ab = 0.0;
  double aa = 0.0;
  double bb = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ab += (ranks_a[i] - middle) * (ranks_b[i] - middle);
    aa += (ranks_a[i] - middle) * (ranks_a[i] - middle);
    bb += (ranks_b[i] - middle) * (ranks_b[i] - middle);
  }
  return ab / std::sqrt(aa * bb);
}

}  // namespace vantage::test
