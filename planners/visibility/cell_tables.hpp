/// What the gains of a decision read of the map: worked out once per cell, not once per step of a
/// ray.
#pragma once

#include <concepts>
#include <cstddef>
#include <vector>

#include "vantage/belief/map/block_field.hpp"
#include "vantage/belief/map/occupancy_grid.hpp"

namespace vantage {

struct GainContext {
  const OccupancyGrid& grid;
  /// p(a beam passes an unobserved cell), as learnt on the run; `adaptive` needs it, the others do
  /// not look.
  const BlockField* transmission = nullptr;
};

/// One entry per cell, `frame.index` order. A gain fills what it reads and leaves the rest empty;
/// `state` is read of every gain that is `unobserved_only`.
struct CellTables {
  std::vector<CellState> state;
  std::vector<float> p_occupied;
  std::vector<float> entropy_bits;
  std::vector<float> utility;       ///< of seeing the cell, in the gain's unit
  std::vector<float> transmission;  ///< share of a beam that a cell lets pass, [0, 1]
};

std::vector<CellState> cell_states(const OccupancyGrid& grid);
std::vector<float> cell_probabilities(const OccupancyGrid& grid);
std::vector<float> cell_entropies_bits(const OccupancyGrid& grid);
/// The same with 0 in known cells.
std::vector<float> unobserved_entropies_bits(const OccupancyGrid& grid);
/// 1 in free cells, 0 in occupied ones, `unobserved` in unobserved ones.
std::vector<float> cell_transmissions(const OccupancyGrid& grid, const BlockField& unobserved);
/// p(a beam ends in the cell it met): p(o) of occupied cells; of the others what p(o) would be had
/// it started from the prior `opacity_unobserved` instead of 0.5. At 0.5 it is p(o) throughout.
std::vector<float> cell_opacities(const OccupancyGrid& grid, double opacity_unobserved);
/// 1 - opacity, and 0 in occupied cells: there beams end.
std::vector<float> beam_transmissions(const OccupancyGrid& grid, double opacity_unobserved);

/// A gain that is a sum over cells of their utility to the ray that sees them. `Ray` is the
/// state of one ray: start() at the sensor, pass(cell) for each cell crossed (false: nothing behind
/// it counts, the walk may stop), utility(cell) in the gain's unit for the cell the ray ends in. A
/// gain that spares rays to cells without utility says which by `counts(tables, cell)`.
template <class G>
concept RayGain = requires(const G& gain, const GainContext& context, const CellTables& tables,
                           typename G::Ray ray, std::size_t cell) {
  { G::unobserved_only } -> std::convertible_to<bool>;  // do known cells have no utility?
  { gain.prepare(context) } -> std::same_as<CellTables>;
  { gain.ray(tables) } -> std::same_as<typename G::Ray>;
  ray.start();
  { ray.pass(cell) } -> std::same_as<bool>;
  { ray.utility(cell) } -> std::same_as<double>;
};

}  // namespace vantage
