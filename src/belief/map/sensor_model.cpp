#include "vantage/belief/map/sensor_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

#include "vantage/core/parallel_for.hpp"
#include "vantage/core/rounding.hpp"
#include "vantage/geometry/grid_part.hpp"

namespace vantage {
namespace {

/// sigma_axis >= 0.65 h gives d^2 <= 3 (0.5 / 0.65)^2 = 1.78 at a cell's corner, where the default
/// peak leaves p(m|z) = 0.62.
constexpr double kSigmaPerCell = 0.65;
/// Where spread evidence stops: p(o) = 0.59.
constexpr float kSpreadLimit = 0.363965F;
/// A sum may be less than a part of it by that much.
constexpr double kRounding = 1.0 + 1e-12;

/// How far a point's evidence spreads, along each axis of the grid.
struct EvidenceSpread {
  EvidenceSpread(const GridFrame& frame, const InverseSensorModel& model)
      : sigma_m((kSigmaPerCell * frame.cell_size_m).array().max(model.sigma_m)),
        reach_m(model.spread_sigmas * sigma_m),
        d2_limit(model.spread_sigmas * model.spread_sigmas) {}
  Eigen::Array3d sigma_m;
  Eigen::Array3d reach_m;
  double d2_limit;
};

/// The cells about points.
GridPart cells_about(const GridFrame& frame, std::span<const Eigen::Vector3f> p_world,
                     const EvidenceSpread& spread) {
  Eigen::AlignedBox3d box_m;
  for (const Eigen::Vector3f& p : p_world) {
    if (p.allFinite()) box_m.extend(p.cast<double>());
  }
  const Eigen::Vector3d reach_m = spread.reach_m.matrix();
  if (box_m.isEmpty()) return {};
  return cells_about(frame, Eigen::AlignedBox3d(box_m.min() - reach_m, box_m.max() + reach_m));
}

/// What one scan says about each cell that it says anything about.
struct ScanEvidence {
  explicit ScanEvidence(const GridPart& cells)
      : reach(cells),
        d2(cells.size(), std::numeric_limits<float>::infinity()),
        hit(cells.size(), 0) {}
  GridPart reach;
  std::vector<float> d2;          ///< to the nearest point
  std::vector<std::uint8_t> hit;  ///< 1: a point lies in the cell
};

/// Cells along one axis that a point reaches, with their part of d^2.
struct Reach {
  int first = 0;
  std::vector<double> d2;

  void find(const GridFrame& frame, int axis, double p_m, double reach_m, double sigma_m) {
    const auto cell_at = [&](double at_m) {
      return floor_int((at_m - frame.min_corner_m[axis]) / frame.cell_size_m[axis]);
    };
    const int home = cell_at(p_m);
    first = std::max(std::min(cell_at(p_m - reach_m), home), 0);
    const int last = std::min(std::max(cell_at(p_m + reach_m), home), frame.cells[axis] - 1);
    d2.clear();
    for (int cell = first; cell <= last; ++cell) {
      const double centre_m = frame.min_corner_m[axis] + (cell + 0.5) * frame.cell_size_m[axis];
      const double d = (centre_m - p_m) / sigma_m;
      d2.push_back(d * d);
    }
  }
};

/// Spreads points over the slices of one worker.
class Spreader {
 public:
  Spreader(const GridFrame& frame, const EvidenceSpread& spread, ScanEvidence& evidence)
      : frame_(frame),
        spread_(spread),
        evidence_(evidence),
        near_(frame.box().min() - spread.reach_m.matrix(),
              frame.box().max() + spread.reach_m.matrix()) {}

  /// Into the slices [z_begin, z_end).
  void add(const Eigen::Vector3d& p_world, int z_begin, int z_end) {
    // NaN compares false, so a point that is not finite is outside.
    if (!near_.contains(p_world)) return;
    const auto find = [&](int axis) {
      along_[static_cast<std::size_t>(axis)].find(frame_, axis, p_world[axis],
                                                  spread_.reach_m[axis], spread_.sigma_m[axis]);
    };
    find(2);
    const Reach& along_z = along_[2];
    const int first = std::max(along_z.first, z_begin);
    const int last = std::min(along_z.first + static_cast<int>(along_z.d2.size()), z_end);
    if (first >= last) return;
    find(0);
    find(1);
    const Eigen::Array3i home = frame_.cell_at(p_world);
    home_ = frame_.contains(home) ? frame_.index(home) : frame_.size();
    if (home_ < frame_.size() && home.z() >= z_begin && home.z() < z_end) {
      evidence_.hit[evidence_.reach.index(home)] = 1;
    }
    for (int z = first; z < last; ++z) {
      add_to_slice(z, along_z.d2[static_cast<std::size_t>(z - along_z.first)]);
    }
  }

  /// A cell of the grid, and the same in the evidence.
  struct Touched {
    std::size_t cell;
    std::size_t in_reach;
  };
  /// Each cell with finite d2, once.
  [[nodiscard]] const std::vector<Touched>& touched() const { return touched_; }

 private:
  void add_to_slice(int z, double d2_z) {
    const auto& [along_x, along_y, along_z] = along_;
    for (std::size_t j = 0; j < along_y.d2.size(); ++j) {
      const std::size_t row = frame_.index({0, along_y.first + static_cast<int>(j), z});
      const bool holds_home = home_ - row < static_cast<std::size_t>(frame_.cells.x());
      if (along_y.d2[j] + d2_z > kRounding * spread_.d2_limit && !holds_home) continue;
      const Eigen::Array3i first(along_x.first, along_y.first + static_cast<int>(j), z);
      std::size_t cell = row + static_cast<std::size_t>(along_x.first);
      std::size_t in_reach = evidence_.reach.index(first);
      for (std::size_t i = 0; i < along_x.d2.size(); ++i, ++cell, ++in_reach) {
        const double d2 = along_x.d2[i] + along_y.d2[j] + d2_z;
        if (d2 > spread_.d2_limit && cell != home_) continue;
        float& best = evidence_.d2[in_reach];
        if (static_cast<float>(d2) >= best) continue;
        if (std::isinf(best)) touched_.push_back({cell, in_reach});
        best = static_cast<float>(d2);
      }
    }
  }

  const GridFrame& frame_;
  const EvidenceSpread& spread_;
  ScanEvidence& evidence_;
  Eigen::AlignedBox3d near_;
  std::array<Reach, 3> along_;
  std::size_t home_ = 0;
  std::vector<Touched> touched_;
};

/// Bounds of slices [z_0, z_1), [z_1, z_2), ... with about as many points each.
std::vector<int> even_slices(const GridFrame& frame, std::span<const Eigen::Vector3f> p_world,
                             int parts) {
  const int slices = frame.cells.z();
  std::vector<std::size_t> below(static_cast<std::size_t>(slices) + 1, 0);
  for (const Eigen::Vector3f& p : p_world) {
    const double z = (p.z() - frame.min_corner_m.z()) / frame.cell_size_m.z();
    if (z >= 0.0 && z < slices) ++below[static_cast<std::size_t>(z) + 1];
  }
  std::partial_sum(below.begin(), below.end(), below.begin());
  std::vector<int> bounds{0};
  for (int part = 1; part < parts; ++part) {
    const std::size_t wanted =
        below.back() * static_cast<std::size_t>(part) / static_cast<std::size_t>(parts);
    bounds.push_back(static_cast<int>(std::ranges::lower_bound(below, wanted) - below.begin()));
  }
  bounds.push_back(slices);
  return bounds;
}

/// Bayes in log odds, l <- l + logit p(m|z), up to the limit of what evidence of its kind may do.
float updated(float log_odds, float evidence, bool hit, float limit) {
  const CellState state = classify(log_odds);
  if (!hit && state == CellState::free) return log_odds;
  if (!hit && state == CellState::unobserved) limit = kSpreadLimit;
  return std::max(log_odds, std::min(log_odds + evidence, limit));
}

}  // namespace

void add_measurements(OccupancyGrid& grid, std::span<const Eigen::Vector3f> p_world,
                      const InverseSensorModel& model, int threads) {
  check_options(model, "inverse sensor model");
  expects(threads >= 1, "add_measurements needs a thread");
  const EvidenceSpread spread(grid.frame, model);
  ScanEvidence scan(cells_about(grid.frame, p_world, spread));
  const auto limit = static_cast<float>(model.max_abs_log_odds);
  const std::vector<int> bounds = even_slices(grid.frame, p_world, threads);
  // A worker reads and writes the cells of its own slices alone.
  parallel_for(static_cast<std::size_t>(threads), threads, [&](std::size_t worker) {
    Spreader spreader(grid.frame, spread, scan);
    for (const Eigen::Vector3f& point : p_world) {
      spreader.add(point.cast<double>(), bounds[worker], bounds[worker + 1]);
    }
    for (const auto& [cell, in_reach] : spreader.touched()) {
      const double p = 0.5 + (model.p_occupied_peak - 0.5) * std::exp(-0.5 * scan.d2[in_reach]);
      float& log_odds = grid.log_odds[cell];
      const bool hit = scan.hit[in_reach] != 0;
      log_odds = updated(log_odds, static_cast<float>(log_odds_of(p)), hit, limit);
    }
  });
}

}  // namespace vantage
