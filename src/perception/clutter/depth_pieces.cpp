#include "vantage/perception/clutter/depth_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vantage {
namespace {

/// Smaller ones are noise, or too little to tell whose they are.
constexpr int kLeastPixels = 12;
/// A part of an object is over what else is seen of it, or so near.
constexpr double kPart_m = 0.015;

}  // namespace

double DepthPiece::nearest_m(const Eigen::Vector2d& p_world_m) const {
  double least_m2 = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector2d& p : points) {
    least_m2 = std::min(least_m2, (p - p_world_m).squaredNorm());
  }
  return std::sqrt(least_m2);
}

double DepthPiece::distance_m(const Eigen::Vector2d& p_world_m) const {
  if (inside_hull(hull, p_world_m)) return 0.0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Eigen::Vector2d a = hull[i];
    const Eigen::Vector2d d = hull[(i + 1) % hull.size()] - a;
    const double t =
        d.squaredNorm() > 0.0 ? std::clamp(d.dot(p_world_m - a) / d.squaredNorm(), 0.0, 1.0) : 0.0;
    least = std::min(least, (a + t * d - p_world_m).norm());
  }
  return least;
}

Eigen::Vector3d DepthPieces::p_world(const cv::Point& at) const {
  const cv::Point corner = column_.patch.place.tl();
  return T_ * (static_cast<double>(column_.patch.depth_m(at)) *
               images_.ray(corner.y + at.y, corner.x + at.x));
}

bool DepthPieces::inside(const cv::Point& at) const {
  return at.x >= 0 && at.y >= 0 && at.x < column_.rises.cols && at.y < column_.rises.rows;
}

bool DepthPieces::nearer(const cv::Point& other, const cv::Point& at) const {
  const float z_m = column_.patch.depth_m(other);
  return z_m > 0.0F && std::isfinite(z_m) &&
         static_cast<double>(column_.patch.depth_m(at) - z_m) > step_.at_m(z_m);
}

bool DepthPieces::is_bare(const Eigen::Vector3d& p_world_m, double reach_m) const {
  const Eigen::Vector3d p = T_.inverse() * p_world_m;
  if (p.z() <= 0.0) return false;  // behind the camera
  const Eigen::Array2d centre(0.5 * (images_.width_px - 1), 0.5 * (images_.height_px - 1));
  const Eigen::Array2i px =
      (p.head<2>().array() / p.z() * images_.focal_px + centre).round().cast<int>();
  const cv::Point at = cv::Point(px.x(), px.y()) - column_.patch.place.tl();
  return inside(at) && column_.rises(at) == 0 && column_.heights_m(at) != kOutside &&
         (p_world(at) - p_world_m).head<2>().norm() <= reach_m;
}

std::vector<DepthPiece> DepthPieces::all() const {
  std::vector<DepthPiece> found;
  cv::Mat1b left = column_.rises.clone();
  for (int row = 0; row < left.rows; ++row) {
    for (int x = 0; x < left.cols; ++x) {
      if (left(row, x) == 0) continue;
      DepthPiece piece = piece_from({x, row}, left);
      if (std::ssize(piece.pixels) < kLeastPixels) continue;
      for (const cv::Point& at : piece.pixels) piece.points.emplace_back(p_world(at).head<2>());
      piece.hull = convex_hull(piece.points);
      found.push_back(std::move(piece));
    }
  }
  return found;
}

/// Takes its pixels out of `left`.
DepthPiece DepthPieces::piece_from(const cv::Point& seed, cv::Mat1b& left) const {
  DepthPiece piece;
  piece.pixels.push_back(seed);
  left(seed) = 0;
  for (std::size_t i = 0; i < piece.pixels.size(); ++i) {
    const cv::Point at = piece.pixels[i];
    for (const cv::Point& step :
         {cv::Point(1, 0), cv::Point(-1, 0), cv::Point(0, 1), cv::Point(0, -1)}) {
      const cv::Point next = at + step;
      if (!inside(next) || left(next) == 0 || nearer(next, at) || nearer(at, next)) continue;
      left(next) = 0;
      piece.pixels.push_back(next);
    }
  }
  return piece;
}

namespace {

/// Whether most of it is over what is seen of the other.
bool is_over(const DepthPiece& piece, const DepthPiece& other) {
  const auto over = std::ranges::count_if(
      piece.points, [&](const Eigen::Vector2d& p) { return other.distance_m(p) <= kPart_m; });
  return 2 * over > std::ssize(piece.points);
}

}  // namespace

std::vector<const DepthPiece*> round_place(const std::vector<DepthPiece>& pieces,
                                           const Eigen::Vector2d& p_world_m, double reach_m,
                                           bool is_bare) {
  const auto to_points_m = [&](const DepthPiece& piece) { return piece.nearest_m(p_world_m); };
  const auto to_hull_m = [&](const DepthPiece& piece) { return piece.distance_m(p_world_m); };
  std::vector<const DepthPiece*> own;
  if (pieces.empty()) return own;
  auto nearest = std::ranges::min_element(pieces, {}, to_points_m);
  const bool round_it = to_points_m(*nearest) > reach_m;
  if (round_it) nearest = std::ranges::min_element(pieces, {}, to_hull_m);
  if (round_it && (!is_bare || to_hull_m(*nearest) > reach_m)) return own;
  for (const DepthPiece& piece : pieces) {
    const bool at_place = to_points_m(piece) <= 0.5 * reach_m;
    if (&piece == &*nearest || at_place || is_over(piece, *nearest)) own.push_back(&piece);
  }
  return own;
}

}  // namespace vantage
