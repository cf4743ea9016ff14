/// A view the robot could take next.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "vantage/geometry/field_of_view.hpp"
#include "vantage/geometry/pose.hpp"

namespace vantage {

/// A set of cells: cell i is bit i % 64 of word i / 64.
using CellSet = std::vector<std::uint64_t>;

/// Geometry of a view, plus what the episode knows about getting there.
struct Candidate {
  int id = 0;  ///< index in the list it was proposed in
  Pose T_world_sensor = Pose::Identity();
  double path_length_m = 0.0;  ///< along the planned path; infinity where unreachable
  bool reachable = true;
  bool exhausted = false;  ///< tried before and not worth trying again, e.g. out of reach
  double gain_bits = 0.0;  ///< as the gain in use predicts it, in its unit where that is not bits
  std::optional<double> true_new_cells;  ///< what the view would really show; for `oracle` alone
  std::shared_ptr<const CellSet> true_new_cell_set;  ///< the same cell by cell; `oracle_lookahead`
};

}  // namespace vantage
