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

std::vector<DepthPiece> DepthPieces::all() const {
  std::vector<DepthPiece> found;
  cv::Mat1b left = column_.rises.clone();
  for (int row = 0; row < left.rows; ++row) {
    for (int x = 0; x < left.cols; ++x) {
      if (left(row, x) == 0) continue;
      DepthPiece piece = piece_from({x, row}, left);
      if (std::ssize(piece.pixels) < kLeastPixels) continue;
      std::vector<Eigen::Vector2d> points;
      for (const cv::Point& at : piece.pixels) points.emplace_back(p_world(at).head<2>());
      for (const Eigen::Vector2d& p : points) piece.middle_m += p;
      piece.middle_m /= static_cast<double>(points.size());
      piece.hull = convex_hull(std::move(points));
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

std::vector<const DepthPiece*> round_place(const std::vector<DepthPiece>& pieces,
                                           const Eigen::Vector2d& p_world_m, double reach_m) {
  std::vector<const DepthPiece*> own;
  const auto away_m = [&](const DepthPiece& piece) { return piece.distance_m(p_world_m); };
  const auto nearest = std::ranges::min_element(pieces, {}, away_m);
  if (nearest == pieces.end() || away_m(*nearest) > reach_m) return own;
  for (const DepthPiece& piece : pieces) {
    const bool at_place = away_m(piece) <= 0.5 * reach_m;
    if (&piece == &*nearest || at_place || nearest->distance_m(piece.middle_m) <= kPart_m) {
      own.push_back(&piece);
    }
  }
  return own;
}

}  // namespace vantage
