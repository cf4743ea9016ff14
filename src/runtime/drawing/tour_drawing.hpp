/// A planned tour as it is drawn into a map.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <string>

#include "vantage/planners/tours/planned_tour.hpp"
#include "vantage/runtime/drawing/map_view.hpp"

namespace vantage {

struct TourDrawing {
  /// Where the way to the next stop begins, world; none: that way is drawn already.
  std::optional<Eigen::Vector2d> from_m = {};
  double z_m = 0.0;        ///< of the floor, world
  std::size_t number = 1;  ///< of the next stop; those behind it are numbered on from there
  bool marks_next = true;  ///< whether the next stop has a disc of its own
  double unit = 1.0;       ///< pixels of a stroke
};

/// The way to the next stop is solid, the rest dashed, straight from stop to stop; the next stop a
/// disc, the others rings, with their numbers. Of stops that would cover each other the first one
/// has its number, the others are dots.
void draw_tour(MapCanvas& canvas, const MapCamera& camera, const PlannedTour& tour,
               const TourDrawing& how);

/// "plan: 5 views, 182 s; goes on as intended"; empty without stops.
std::string plan_text(const PlannedTour& tour);

}  // namespace vantage
