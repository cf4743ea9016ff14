/// Lengths of the ways between many places.
#pragma once

#include <Eigen/Core>

#include <span>

#include "vantage/planners/navigation/path_field.hpp"

namespace vantage {

/// Of the ways that plan_path() would take over the cells of the field's map, by the same costs,
/// but not pulled straight: up to 8 % longer. Each place stands for the reachable cell it is in.
/// Symmetric; infinite to and from places that are not reachable, 0 on the diagonal. The result
/// does not depend on `threads`.
Eigen::MatrixXd path_lengths_m(const PathField& field, std::span<const Eigen::Vector2d> places_m,
                               int threads);

}  // namespace vantage
