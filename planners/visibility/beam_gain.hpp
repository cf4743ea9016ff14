/// Gains over beams, as the literature writes them: a fan of beams over the field of view, each
/// worth something by itself. Where beams are dense they cross a cell several times and count it as
/// often, so such a gain ranks views but predicts no number of cells.
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

/// What a view is worth where every beam counts by itself: the sum of their total().
struct SumOfBeams {
  double sum = 0.0;
  template <class Beam>
  requires requires(const Beam& beam) {
    { beam.total() } -> std::same_as<double>;
  }
  void add(const Beam& beam) { sum += beam.total(); }
  [[nodiscard]] double total() const { return sum; }
};

/// The state of one view of the gain: its view() if it has one, else a SumOfBeams.
template <class G>
auto view_of_beams(const G& gain) {
  if constexpr (requires { gain.view(); }) {
    return gain.view();
  } else {
    return SumOfBeams{};
  }
}

/// `Beam` is the state of one beam: start() at the sensor, enter(cell) for each cell met (false:
/// the beam ends there), total() for what it is worth. A gain that is no sum of beams has view()
/// instead: the state of a view, with add(beam) for each beam that ended and total().
template <class G>
concept BeamGain = requires(const G& gain, const GainContext& context, typename G::Beam beam,
                            decltype(view_of_beams(gain)) view, std::size_t cell) {
  { gain.fan } -> std::convertible_to<BeamFan>;
  { gain.beam(gain.prepare(context)) } -> std::same_as<typename G::Beam>;
  beam.start();
  { beam.enter(cell) } -> std::same_as<bool>;
  view.add(beam);
  { view.total() } -> std::same_as<double>;
};

/// What the beams of the fan are worth together, each clipped to the sensor's range and to the
/// grid; in the gain's unit.  [AmanatidesWoo1987]
template <BeamGain G, class Tables>
double sum_over_view(const G& gain, const Tables& tables, const GridFrame& grid,
                     const Pose& T_world_sensor, const FieldOfView& field_of_view) {
  const Eigen::Vector3d p_sensor = T_world_sensor.translation();
  typename G::Beam beam = gain.beam(tables);
  auto view = view_of_beams(gain);
  for (const Eigen::Vector3d& direction : beam_directions(field_of_view, gain.fan)) {
    const Eigen::Vector3d d = T_world_sensor.linear() * direction;
    beam.start();
    walk_ray(grid, p_sensor + field_of_view.range_min_m * d,
             p_sensor + field_of_view.range_max_m * d,
             [&](std::size_t cell) { return beam.enter(cell); });
    view.add(beam);
  }
  return view.total();
}

}  // namespace vantage
