/// A horizon straight ahead, and things beside it and in its way.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "vantage/planners/trajectory/flight_cost.hpp"

namespace vantage::test {

/// `count` points along x, 0.5 m apart from the origin on, 1.2 m high, heading ahead.
inline Horizon straight_flight(Eigen::Index count = 10) {
  Horizon horizon;
  horizon.points.resize(4, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    horizon.points.col(i) << 0.5 * static_cast<double>(i), 0.0, 1.2, 0.0;
  }
  horizon.before << -0.5, 0.0, 1.2, 0.0;
  horizon.after << 0.5 * static_cast<double>(count), 0.0, 1.2, 0.0;
  return horizon;
}

/// Upright columns of 0.2 m radius, 2 m high, in cells of 0.1 m round that flight.
inline Esdf columns(const std::vector<Eigen::Vector2d>& centres_m) {
  const GridFrame frame = make_grid_frame({2.25, 0.0, 1.0}, {8.0, 6.0, 2.0}, {80, 60, 20});
  std::vector<std::uint8_t> occupied(frame.size(), 0);
  for (std::size_t cell = 0; cell < frame.size(); ++cell) {
    const Eigen::Vector2d p = frame.centre(frame.cell(cell)).head<2>();
    for (const auto& centre : centres_m) {
      if ((p - centre).norm() < 0.2) occupied[cell] = 1;
    }
  }
  return {frame, occupied};
}

/// Least on the straight ways between the points.
inline double clearance_m(const Esdf& surface, const Horizon& horizon) {
  double min_m = surface.distance_m(horizon.point(0).head<3>());
  for (Eigen::Index i = 1; i < horizon.count(); ++i) {
    for (double share = 0.05; share < 1.01; share += 0.05) {
      const Eigen::Vector4d place = (1.0 - share) * horizon.point(i - 1) + share * horizon.point(i);
      min_m = std::min(min_m, surface.distance_m(place.head<3>()));
    }
  }
  return min_m;
}

}  // namespace vantage::test
