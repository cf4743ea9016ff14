/// Gains that are sums over beams, as the literature writes them: a fan of beams over the field of
/// view, each worth something by itself. Where beams are dense they cross a cell several times and
/// count it as often, so such a gain ranks views but predicts no number of cells.
#pragma once

#include <Eigen/Core>

#include <concepts>
#include <cstddef>
#include <vector>

#include "vantage/core/fields.hpp"
#include "vantage/geometry/field_of_view.hpp"
#include "vantage/geometry/grid_frame.hpp"
#include "vantage/geometry/pose.hpp"
#include "vantage/planners/visibility/cell_tables.hpp"

namespace vantage {

/// How much of a beam an unobserved cell takes away, by default; see cell_opacities(). Not the
/// prior p(o) = 0.5: a cell of millimetres would halve every beam, which then is worth about two
/// cells whatever the view, and cells that one pass freed (p(o) = 0.3) would be a fog.
inline constexpr double kOpacityUnobserved = 0.01;

struct BeamFan {
  double step_rad = 0.01;
  void fields(auto&& f) {
    f("step_rad", step_rad, "angle between beams; higher is faster and may step over small things",
      between(0.001, 1.5));
  }
};

/// Unit vectors, sensor frame: an even lattice of tilts and azimuths, at most step_rad apart, each
/// beam in the middle of its part of the sector. A full turn meets itself without a doubled beam.
std::vector<Eigen::Vector3d> beam_directions(const FieldOfView& field_of_view, const BeamFan& fan);

/// `Beam` is the state of one beam: start() at the sensor, enter(cell) for each cell met (false:
/// the beam ends there), total() for what it is worth so far.
template <class G>
concept BeamGain = requires(const G& gain, const GainContext& context, typename G::Beam beam,
                            std::size_t cell) {
  { gain.fan } -> std::convertible_to<BeamFan>;
  { gain.beam(gain.prepare(context)) } -> std::same_as<typename G::Beam>;
  beam.start();
  { beam.enter(cell) } -> std::same_as<bool>;
  { beam.total() } -> std::same_as<double>;
};

/// Sum of total() over the fan, each beam clipped to the sensor's range and to the grid; in the
/// gain's unit.  [AmanatidesWoo1987]
template <BeamGain G, class Tables>
double sum_over_view(const G& gain, const Tables& tables, const GridFrame& grid,
                     const Pose& T_world_sensor, const FieldOfView& field_of_view) {
  const Eigen::Vector3d p_sensor = T_world_sensor.translation();
  typename G::Beam beam = gain.beam(tables);
  double sum = 0.0;
  for (const Eigen::Vector3d& direction : beam_directions(field_of_view, gain.fan)) {
    const Eigen::Vector3d d = T_world_sensor.linear() * direction;
    beam.start();
    walk_ray(grid, p_sensor + field_of_view.range_min_m * d,
             p_sensor + field_of_view.range_max_m * d,
             [&](std::size_t cell) { return beam.enter(cell); });
    sum += beam.total();
  }
  return sum;
}

}  // namespace vantage
