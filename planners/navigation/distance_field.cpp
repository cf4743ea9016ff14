#include "vantage/planners/navigation/distance_field.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "vantage/core/cancellation/stop_poll.hpp"

namespace vantage {
namespace {

/// Lower envelope of the parabolas (x - q)^2 + height[q], in one dimension. Scratch is kept between
/// calls.
class Envelope {
 public:
  explicit Envelope(std::size_t longest) : vertex_(longest), from_(longest + 1), height_(longest) {}

  /// Replaces line[0], line[stride], ... by the envelope at each of the `count` places.
  void transform(double* line, std::size_t count, std::size_t stride) {
    for (std::size_t x = 0; x < count; ++x) height_[x] = line[x * stride];
    const std::size_t parabolas = build(count);
    if (parabolas == 0) return;
    std::size_t k = 0;
    for (std::size_t x = 0; x < count; ++x) {
      while (k + 1 < parabolas && from_[k + 1] < static_cast<double>(x)) ++k;
      const double offset = static_cast<double>(x) - static_cast<double>(vertex_[k]);
      line[x * stride] = offset * offset + height_[vertex_[k]];
    }
  }

 private:
  /// @return the number of parabolas that touch the envelope.
  std::size_t build(std::size_t count) {
    std::size_t parabolas = 0;
    for (std::size_t q = 0; q < count; ++q) {
      if (height_[q] == kInfinity) continue;
      double from = -kInfinity;
      while (parabolas > 0) {
        from = intersection(vertex_[parabolas - 1], q);
        if (from > from_[parabolas - 1]) break;
        --parabolas;  // never the first, which takes over at -infinity
      }
      vertex_[parabolas] = q;
      from_[parabolas] = from;
      ++parabolas;
    }
    return parabolas;
  }

  /// Where the parabola of q takes over from that of p < q.
  [[nodiscard]] double intersection(std::size_t p, std::size_t q) const {
    const auto xp = static_cast<double>(p);
    const auto xq = static_cast<double>(q);
    return (height_[q] + xq * xq - height_[p] - xp * xp) / (2.0 * (xq - xp));
  }

  std::vector<std::size_t> vertex_;
  std::vector<double> from_;
  std::vector<double> height_;
};

}  // namespace

std::vector<double> squared_distances_cells(std::span<const std::uint8_t> source, int nx, int ny) {
  const auto width = static_cast<std::size_t>(nx);
  const auto height = static_cast<std::size_t>(ny);
  expects(source.size() == width * height, "a source flag for each cell");
  std::vector<double> squared(source.size());
  for (std::size_t i = 0; i < source.size(); ++i) squared[i] = source[i] != 0 ? 0.0 : kInfinity;
  Envelope envelope(std::max(width, height));
  for (std::size_t x = 0; x < width; ++x) {
    envelope.transform(&squared[x], height, width);
    poll_stop();
  }
  for (std::size_t y = 0; y < height; ++y) {
    envelope.transform(&squared[y * width], width, 1);
    poll_stop();
  }
  return squared;
}

std::vector<float> clearances_m(const FloorMap& map) {
  // One ring of cells more on every side stands for the unknown outside.
  const int nx = map.nx + 2;
  const int ny = map.ny + 2;
  const auto padded = [&](const Eigen::Array2i& cell) {
    return static_cast<std::size_t>(cell.y() + 1) * static_cast<std::size_t>(nx) +
           static_cast<std::size_t>(cell.x() + 1);
  };
  std::vector<std::uint8_t> source(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny), 1);
  for (std::size_t cell = 0; cell < map.size(); ++cell) {
    source[padded(map.cell(cell))] = map.state(cell) == CellState::free ? 0 : 1;
  }
  const std::vector<double> squared = squared_distances_cells(source, nx, ny);
  std::vector<float> clearance_m(map.size());
  for (std::size_t cell = 0; cell < map.size(); ++cell) {
    clearance_m[cell] = static_cast<float>(std::sqrt(squared[padded(map.cell(cell))]) * map.cell_m);
  }
  return clearance_m;
}

}  // namespace vantage
