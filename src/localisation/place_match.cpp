#include "vantage/localisation/place_match.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "vantage/core/error.hpp"
#include "vantage/perception/clouds/kd_tree.hpp"

namespace vantage {
namespace {

constexpr double kMatchCell_m = 0.05;
constexpr double kTurnStep_rad = 0.0125;  // a cell at 4 m
/// Of the score, for a pose at the edge of the window: decides between poses that fit alike.
constexpr double kPull = 0.06;
constexpr std::uint8_t kHit = 3;
constexpr std::uint8_t kBeside = 2;
constexpr std::size_t kMaxPoints = 300;
constexpr int kPieceSteps = 4;  // 0.2 m to both sides

/// Sparse points have no normal.
bool knows_surface(const PointCloud& cloud, std::size_t i) { return !cloud.normals[i].isZero(); }

/// The place from above: how well a point falls on a surface.
class Picture {
 public:
  Picture(const PointCloud& place, double margin_m) {
    Eigen::AlignedBox2d box;
    for (const Eigen::Vector3f& p : place.points) box.extend(p.head<2>().cast<double>());
    low_m_ = box.min() - Eigen::Vector2d::Constant(margin_m);
    cells_ = ((box.sizes().array() + 2.0 * margin_m) / kMatchCell_m).ceil().cast<int>() + 1;
    worth_.assign(static_cast<std::size_t>(cells_.x()) * static_cast<std::size_t>(cells_.y()), 0);
    for (std::size_t i = 0; i < place.size(); ++i) {
      if (knows_surface(place, i)) draw_piece(place, i);
    }
  }

  [[nodiscard]] Eigen::Array2i cell_of(const Eigen::Vector2d& p_m) const {
    return ((p_m - low_m_) / kMatchCell_m).array().floor().cast<int>();
  }
  [[nodiscard]] int worth(const Eigen::Array2i& cell) const {
    return contains(cell) ? worth_[index(cell)] : 0;
  }

 private:
  [[nodiscard]] bool contains(const Eigen::Array2i& cell) const {
    return (cell >= 0).all() && (cell < cells_).all();
  }
  [[nodiscard]] std::size_t index(const Eigen::Array2i& cell) const {
    return static_cast<std::size_t>(cell.y()) * static_cast<std::size_t>(cells_.x()) +
           static_cast<std::size_t>(cell.x());
  }
  /// A point stands for a piece of a surface: far from the scanner they are sparse, and which way
  /// they lie along a wall tells where the scanner was, not where the wall is.
  void draw_piece(const PointCloud& place, std::size_t i) {
    const Eigen::Vector2d p = place.points[i].head<2>().cast<double>();
    const Eigen::Vector2d normal = place.normals[i].head<2>().cast<double>();
    const Eigen::Vector2d along(-normal.y(), normal.x());
    for (int step = -kPieceSteps; step <= kPieceSteps; ++step) {
      draw(cell_of(p + step * kMatchCell_m * along));
    }
  }
  void draw(const Eigen::Array2i& at) {
    for (int y = -1; y <= 1; ++y) {
      for (int x = -1; x <= 1; ++x) {
        const Eigen::Array2i cell = at + Eigen::Array2i(x, y);
        if (!contains(cell)) continue;
        std::uint8_t& worth = worth_[index(cell)];
        worth = std::max(worth, x == 0 && y == 0 ? kHit : kBeside);
      }
    }
  }

  Eigen::Vector2d low_m_;
  Eigen::Array2i cells_;
  std::vector<std::uint8_t> worth_;
};

/// At most kMaxPoints of the surfaces.
std::vector<Eigen::Vector2d> surface_points(const PointCloud& scan) {
  std::vector<Eigen::Vector2d> points;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (knows_surface(scan, i)) points.emplace_back(scan.points[i].head<2>().cast<double>());
  }
  const std::size_t stride = (points.size() + kMaxPoints - 1) / kMaxPoints;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < points.size(); i += stride) points[kept++] = points[i];
  points.resize(kept);
  return points;
}

}  // namespace

Pose2 search_pose(const PointCloud& scan, const PointCloud& place, const Pose2& guess,
                  const SearchWindow& window) {
  expects(scan.has_normals() && place.has_normals(), "clouds with normals");
  const std::vector<Eigen::Vector2d> points = surface_points(scan);
  if (points.empty() || place.empty()) return guess;
  const Picture picture(place, kMatchCell_m);
  const int shifts = static_cast<int>(std::ceil(window.shift_m / kMatchCell_m));
  const int turns = static_cast<int>(std::ceil(window.turn_rad / kTurnStep_rad));
  Pose2 best = guess;
  double best_score = -1.0;
  for (int t = -turns; t <= turns; ++t) {
    const double yaw_rad = guess.yaw_rad + t * kTurnStep_rad;
    std::vector<Eigen::Array2i> cells;
    const Eigen::Rotation2Dd rotation(yaw_rad);
    for (const Eigen::Vector2d& p : points) {
      cells.push_back(picture.cell_of(rotation * p + Eigen::Vector2d(guess.x_m, guess.y_m)));
    }
    for (int y = -shifts; y <= shifts; ++y) {
      for (int x = -shifts; x <= shifts; ++x) {
        int sum = 0;
        for (const Eigen::Array2i& cell : cells) sum += picture.worth(cell + Eigen::Array2i(x, y));
        const double off = (x * x + y * y) / std::max(1.0, 1.0 * shifts * shifts) +
                           t * t / std::max(1.0, 1.0 * turns * turns);
        const double score = sum / (double{kHit} * static_cast<double>(cells.size())) - kPull * off;
        if (score <= best_score) continue;
        best_score = score;
        best = {guess.x_m + x * kMatchCell_m, guess.y_m + y * kMatchCell_m, wrap_angle(yaw_rad)};
      }
    }
  }
  return best;
}

Agreement agreement(const PointCloud& scan, const PointCloud& place, const Pose2& T_place_scan) {
  constexpr double kNear_m = 0.5;
  constexpr double kOn_m = 0.08;
  constexpr double kMinCosine = 0.7;
  if (scan.empty() || place.empty()) return {};
  expects(scan.has_normals() && place.has_normals(), "clouds with normals");
  const PointCloud there = transform(scan, to_se3(T_place_scan));
  const KdTree tree(place.points);
  Agreement result;
  std::size_t on = 0;
  for (std::size_t i = 0; i < there.size(); ++i) {
    const auto found = tree.nearest(there.points[i], kNear_m);
    if (!found || !knows_surface(there, i) || !knows_surface(place, found->index)) continue;
    ++result.near;
    const Eigen::Vector3f& normal = place.normals[found->index];
    const bool faces = static_cast<double>(there.normals[i].dot(normal)) > kMinCosine;
    result.facing += faces ? 1 : 0;
    const Eigen::Vector3f off = there.points[i] - place.points[found->index];
    on += faces && std::abs(static_cast<double>(off.dot(normal))) < kOn_m ? 1 : 0;
  }
  if (result.near > 0) result.share = static_cast<double>(on) / static_cast<double>(result.near);
  return result;
}

}  // namespace vantage
