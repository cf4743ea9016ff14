#include "vantage/belief/map/block_field.hpp"

#include <algorithm>
#include <cmath>

#include "vantage/core/error.hpp"
#include "vantage/core/rounding.hpp"

namespace vantage {
namespace {

/// exp(-d^2 / (2 sigma^2)) for d = 0, 1, ... up to three sigma.
std::vector<double> gaussian_weights(double sigma) {
  std::vector<double> weights{1.0};
  for (int d = 1; d <= ceil_int(3.0 * sigma); ++d) {
    weights.push_back(std::exp(-0.5 * d * d / (sigma * sigma)));
  }
  return weights;
}

/// Along one line of `count` numbers, `stride` apart.
void gather_line(const double* from, double* to, int count, std::ptrdiff_t stride,
                 const std::vector<double>& weights) {
  const int reach = static_cast<int>(weights.size()) - 1;
  for (int i = 0; i < count; ++i) {
    double sum = 0.0;
    for (int j = std::max(0, i - reach); j <= std::min(count - 1, i + reach); ++j) {
      sum += weights[static_cast<std::size_t>(std::abs(i - j))] * from[j * stride];
    }
    to[i * stride] = sum;
  }
}

}  // namespace

BlockField uniform_field(const Eigen::Array3i& cells, double number) {
  return {.layout = {.cells = cells}, .per_block = {number}};
}

BlockField gather_neighbours(const BlockField& field, const Eigen::Array2d& sigma_blocks) {
  expects((sigma_blocks >= 0.0).all(), "a reach of at least 0");
  const auto along_x = gaussian_weights(sigma_blocks.x());
  const auto along_y = gaussian_weights(sigma_blocks.y());
  const BlockLayout& layout = field.layout;
  BlockField rows = field;
  BlockField gathered = field;
  for (int z = 0; z < layout.blocks.z(); ++z) {
    for (int y = 0; y < layout.blocks.y(); ++y) {
      const std::size_t start = layout.index(0, y, z);
      gather_line(&field.per_block[start], &rows.per_block[start], layout.blocks.x(), 1, along_x);
    }
    for (int x = 0; x < layout.blocks.x(); ++x) {
      const std::size_t start = layout.index(x, 0, z);
      gather_line(&rows.per_block[start], &gathered.per_block[start], layout.blocks.y(),
                  layout.blocks.x(), along_y);
    }
  }
  return gathered;
}

}  // namespace vantage
