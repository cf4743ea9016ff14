#include "vantage/planners/trajectory/esdf.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {

/// Squared distances between cells, m^2, along one axis after the other. What is farther than the
/// reach is at the reach, so that few rows matter to a row, each of them in one vectorised pass.
class Transform {
 public:
  Transform(const GridFrame& frame, double reach_m)
      : frame_(frame),
        nx_(static_cast<std::size_t>(frame.cells.x())),
        far_(static_cast<float>(reach_m * reach_m)),
        reach_m_(reach_m) {}

  /// From each cell to the nearest that is occupied, or to the nearest that is not.
  std::vector<float> squared_distances(std::span<const std::uint8_t> occupied, bool to_occupied) {
    std::vector<float> squared(frame_.size());
    for (std::size_t begin = 0; begin < squared.size(); begin += nx_) {
      along_x(occupied.subspan(begin, nx_), to_occupied, &squared[begin]);
    }
    const auto ny = static_cast<std::size_t>(frame_.cells.y());
    const auto nz = static_cast<std::size_t>(frame_.cells.z());
    for (std::size_t z = 0; z < nz; ++z) {
      across(&squared[z * ny * nx_], ny, nx_, frame_.cell_size_m.y());
    }
    for (std::size_t y = 0; y < ny; ++y) {
      across(&squared[y * nx_], nz, ny * nx_, frame_.cell_size_m.z());
    }
    return squared;
  }

 private:
  void along_x(std::span<const std::uint8_t> occupied, bool to_occupied, float* squared) const {
    const auto cell_m = static_cast<float>(frame_.cell_size_m.x());
    const auto reach_m = static_cast<float>(reach_m_);
    float away_m = reach_m;
    for (std::size_t x = 0; x < nx_; ++x) {
      away_m = (occupied[x] != 0) == to_occupied ? 0.0F : std::min(away_m + cell_m, reach_m);
      squared[x] = away_m;
    }
    for (std::size_t x = nx_; x-- > 0;) {
      away_m = std::min(away_m + cell_m, squared[x]);
      squared[x] = std::min(away_m * away_m, far_);
    }
  }

  /// The rows at first, first + stride, ...: each becomes the least of all, each with its squared
  /// distance on top.
  void across(float* first, std::size_t rows, std::size_t stride, double cell_m) {
    before_.resize(rows * nx_);
    nothing_.resize(rows);
    settled_.resize(rows);
    for (std::size_t row = 0; row < rows; ++row) {
      const std::span<const float> from(first + row * stride, nx_);
      std::ranges::copy(from, before_.begin() + static_cast<std::ptrdiff_t>(row * nx_));
      nothing_[row] = std::ranges::all_of(from, [&](float d) { return d >= far_; }) ? 1 : 0;
      settled_[row] = std::ranges::all_of(from, [](float d) { return d == 0.0F; }) ? 1 : 0;
    }
    const auto reach = static_cast<std::size_t>(reach_m_ / cell_m);
    for (std::size_t row = 0; row < rows; ++row) {
      if (settled_[row] != 0) continue;
      float* const to = first + row * stride;
      const std::size_t end = std::min(rows, row + reach + 1);
      for (std::size_t other = row > reach ? row - reach : 0; other < end; ++other) {
        if (other == row || nothing_[other] != 0) continue;
        const double away_m = (static_cast<double>(other) - static_cast<double>(row)) * cell_m;
        lower(&before_[other * nx_], static_cast<float>(away_m * away_m), to);
      }
    }
  }

  void lower(const float* from, float added, float* to) const {
    for (std::size_t x = 0; x < nx_; ++x) {
      const float d = from[x] + added;
      to[x] = d < to[x] ? d : to[x];
    }
  }

  const GridFrame& frame_;
  std::size_t nx_;
  float far_;
  double reach_m_;
  std::vector<float> before_;
  std::vector<std::uint8_t> nothing_;  // in reach of the row
  std::vector<std::uint8_t> settled_;  // nothing is nearer
};

}  // namespace

Esdf::Esdf(const GridFrame& frame, std::span<const std::uint8_t> occupied, double reach_m)
    : frame_(frame), reach_m_(reach_m) {
  expects(occupied.size() == frame.size(), "a flag for each cell");
  expects(reach_m > 0.0, "distances reach somewhere");
  const double half_m = 0.5 * frame.cell_size_m.minCoeff();
  Transform transform(frame_, reach_m + half_m);
  signed_m_ = transform.squared_distances(occupied, true);
  const std::vector<float> inside = transform.squared_distances(occupied, false);
  const auto half = static_cast<float>(half_m);
  for (std::size_t i = 0; i < signed_m_.size(); ++i) {
    const float out = std::sqrt(signed_m_[i]) - half;
    const float in = half - std::sqrt(inside[i]);
    signed_m_[i] = inside[i] > 0.0F ? in : out;
  }
}

/// The cell of a place among cell centres, and where in it.
struct Esdf::Corner {
  std::array<float, 8> value;  // x fastest
  Eigen::Vector3d share;       // of the way to the upper ones
  Eigen::Vector3d beyond_m;    // outside the outer centres
};

Esdf::Corner Esdf::corner(const Eigen::Vector3d& p_world) const {
  Corner c;
  std::array<std::size_t, 3> low{};
  std::array<std::size_t, 3> step{};
  const std::array<std::size_t, 3> stride{
      1, static_cast<std::size_t>(frame_.cells.x()),
      static_cast<std::size_t>(frame_.cells.x()) * static_cast<std::size_t>(frame_.cells.y())};
  for (int axis = 0; axis < 3; ++axis) {
    const double cell_m = frame_.cell_size_m[axis];
    const int last = frame_.cells[axis] - 1;
    const double at = (p_world[axis] - frame_.min_corner_m[axis]) / cell_m - 0.5;
    const double inside = std::clamp(at, 0.0, static_cast<double>(last));
    const int cell = std::min(static_cast<int>(inside), std::max(last - 1, 0));
    c.share[axis] = inside - cell;
    c.beyond_m[axis] = (at - inside) * cell_m;
    const auto a = static_cast<std::size_t>(axis);
    low[a] = static_cast<std::size_t>(cell) * stride[a];
    step[a] = last > 0 ? stride[a] : 0;
  }
  const float* const base = &signed_m_[low[0] + low[1] + low[2]];
  for (std::size_t k = 0; k < 8; ++k) {
    c.value[k] = base[(k & 1U) * step[0] + (k >> 1U & 1U) * step[1] + (k >> 2U) * step[2]];
  }
  return c;
}

double Esdf::distance_m(const Eigen::Vector3d& p_world) const {
  const Corner c = corner(p_world);
  const auto mix = [](double a, double b, double share) { return a + share * (b - a); };
  const auto level = [&](std::size_t k) {
    return mix(mix(c.value[k], c.value[k + 1], c.share.x()),
               mix(c.value[k + 2], c.value[k + 3], c.share.x()), c.share.y());
  };
  const double inside = mix(level(0), level(4), c.share.z());
  const double beyond2 = c.beyond_m.squaredNorm();
  return beyond2 > 0.0 ? inside + std::sqrt(beyond2) : inside;
}

Esdf::Sample Esdf::sample(const Eigen::Vector3d& p_world) const {
  const Corner c = corner(p_world);
  Sample s;
  for (std::size_t k = 0; k < 8; ++k) {
    Eigen::Vector3d weight;
    Eigen::Vector3d slope;
    for (int axis = 0; axis < 3; ++axis) {
      const bool upper = (k >> static_cast<unsigned>(axis) & 1U) != 0;
      weight[axis] = upper ? c.share[axis] : 1.0 - c.share[axis];
      slope[axis] = c.beyond_m[axis] != 0.0 ? 0.0 : (upper ? 1.0 : -1.0) / frame_.cell_size_m[axis];
    }
    const double value = c.value[k];
    s.distance_m += value * weight.prod();
    s.gradient += value * Eigen::Vector3d(slope.x() * weight.y() * weight.z(),
                                          weight.x() * slope.y() * weight.z(),
                                          weight.x() * weight.y() * slope.z());
  }
  const double beyond_m = c.beyond_m.norm();
  if (beyond_m > 0.0) {
    s.distance_m += beyond_m;
    s.gradient += c.beyond_m / beyond_m;
  }
  return s;
}

namespace {

/// @param occupied_at (index of a cell of `whole`) -> whether it is
Esdf cut_out(const GridFrame& whole, const Eigen::AlignedBox3d& window, double reach_m,
             auto&& occupied_at) {
  const Eigen::Array3i last = whole.cells - 1;
  const Eigen::Array3i low = whole.cell_at(window.min()).max(0).min(last);
  const Eigen::Array3i high = whole.cell_at(window.max()).max(low).min(last);
  GridFrame frame = whole;
  frame.min_corner_m += (low.cast<double>() * whole.cell_size_m.array()).matrix();
  frame.cells = high - low + 1;
  std::vector<std::uint8_t> occupied(frame.size());
  for (std::size_t i = 0; i < occupied.size(); ++i) {
    occupied[i] = occupied_at(whole.index(low + frame.cell(i))) ? 1 : 0;
  }
  return {frame, occupied, reach_m};
}

}  // namespace

Esdf make_esdf(const OccupancyGrid& map, const Eigen::AlignedBox3d& window, double reach_m) {
  return cut_out(map.frame, window, reach_m,
                 [&](std::size_t cell) { return map.state(cell) == CellState::occupied; });
}

Esdf make_esdf(const GridFrame& frame, std::span<const std::uint8_t> occupied,
               const Eigen::AlignedBox3d& window, double reach_m) {
  return cut_out(frame, window, reach_m, [&](std::size_t cell) { return occupied[cell] != 0; });
}

}  // namespace vantage
