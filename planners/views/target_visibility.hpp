/// How much of a thing on the map a view will see.
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <span>

#include "vantage/geometry/grid_frame.hpp"
#include "vantage/geometry/upright_cylinder.hpp"

namespace vantage {

/// Expected share of the surface facing the eye that the eye sees: the mean, over the surface, of
/// what the cells on the way let pass (Beer-Lambert). Cells of the target itself hide nothing of
/// it, nor does what lies outside of the grid.
/// @param transmission of each cell, `frame.index` order: 1 free, 0 occupied, in between unobserved
/// @param own 1 for each cell that is the target's own; empty: those in the cylinder are
/// @param margin_m by how much cells outside the cylinder still count as in it
/// @return 0 .. 1
double visible_share(const GridFrame& frame, std::span<const float> transmission,
                     const UprightCylinder& target, std::span<const std::uint8_t> own,
                     const Eigen::Vector3d& p_eye_m, double margin_m);

}  // namespace vantage
