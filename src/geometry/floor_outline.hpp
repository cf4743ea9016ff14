/// What stands on a floor, seen from above.
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "vantage/geometry/pose.hpp"

namespace vantage {

/// Corners of a convex outline, world x and y in m, counter-clockwise.
using FloorOutline = std::vector<Eigen::Vector2d>;

/// The convex hull of points that do not lie on a line. [Andrew1979]
FloorOutline convex_outline(std::vector<Eigen::Vector2d> points);
FloorOutline moved(std::span<const Eigen::Vector2d> outline, const Pose2& T_new_old);
/// Holds every point that is within `margin_m` of the outline, and at corners up to 2 % more.
FloorOutline grown(std::span<const Eigen::Vector2d> outline, double margin_m);
/// Of the largest disc about the origin inside the outline; negative if the origin is outside.
double inscribed_radius_m(std::span<const Eigen::Vector2d> outline);
/// Of the smallest disc about the origin that holds the outline.
double circumscribed_radius_m(std::span<const Eigen::Vector2d> outline);

/// Calls visit(row, first, last) for the rows of points (column, row) * spacing_m + origin_m that
/// have points inside a convex outline, or on it.
template <class Visit>
void for_each_row_inside(std::span<const Eigen::Vector2d> outline, const Eigen::Vector2d& origin_m,
                         double spacing_m, Visit&& visit) {
  double low_m = outline.front().y();
  double high_m = low_m;
  for (const Eigen::Vector2d& p : outline) {
    low_m = std::min(low_m, p.y());
    high_m = std::max(high_m, p.y());
  }
  const auto row_of = [&](double y_m) { return (y_m - origin_m.y()) / spacing_m; };
  const int last_row = static_cast<int>(std::floor(row_of(high_m)));
  for (int row = static_cast<int>(std::ceil(row_of(low_m))); row <= last_row; ++row) {
    const double y_m = origin_m.y() + row * spacing_m;
    double left_m = 1e300;
    double right_m = -1e300;
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Eigen::Vector2d& a = outline[i];
      const Eigen::Vector2d& b = outline[i + 1 == outline.size() ? 0 : i + 1];
      if (std::min(a.y(), b.y()) > y_m || std::max(a.y(), b.y()) < y_m) continue;
      const double share = a.y() == b.y() ? 0.0 : (y_m - a.y()) / (b.y() - a.y());
      const double x_m = a.x() + share * (b.x() - a.x());
      left_m = std::min({left_m, x_m, a.y() == b.y() ? b.x() : x_m});
      right_m = std::max({right_m, x_m, a.y() == b.y() ? b.x() : x_m});
    }
    if (left_m > right_m) continue;  // rounded off the outline
    const int first = static_cast<int>(std::ceil((left_m - origin_m.x()) / spacing_m));
    const int last = static_cast<int>(std::floor((right_m - origin_m.x()) / spacing_m));
    if (first <= last) visit(row, first, last);
  }
}

}  // namespace vantage
