/// Convex outlines on the table, for placing things beside each other.
#pragma once

#include <Eigen/Core>

#include <span>
#include <vector>

#include "vantage/geometry/floor_outline.hpp"
#include "vantage/models/catalogue/shapes/mesh.hpp"

namespace vantage {

using Outline = FloorOutline;

Outline convex_footprint(const TriangleMesh& mesh);

/// Whether two outlines come nearer than `clearance_m`, by separating axes: never misses a contact;
/// corners that face each other count as nearer than they are.
bool too_close(std::span<const Eigen::Vector2d> a, std::span<const Eigen::Vector2d> b,
               double clearance_m);

}  // namespace vantage
