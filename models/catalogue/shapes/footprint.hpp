/// Convex outlines on the table, for placing things beside each other.
#pragma once

#include <Eigen/Core>

#include <span>
#include <vector>

#include "vantage/geometry/pose.hpp"
#include "vantage/models/catalogue/shapes/mesh.hpp"

namespace vantage {

using Outline = std::vector<Eigen::Vector2d>;  ///< convex, counter-clockwise, metres

/// The convex hull of points that do not lie on a line. [Andrew1979]
Outline convex_outline(std::vector<Eigen::Vector2d> points);
Outline convex_footprint(const TriangleMesh& mesh);
Outline moved(std::span<const Eigen::Vector2d> outline, const Pose2& T_new_old);

/// Whether two outlines come nearer than `clearance_m`, by separating axes: never misses a contact;
/// corners that face each other count as nearer than they are.
bool too_close(std::span<const Eigen::Vector2d> a, std::span<const Eigen::Vector2d> b,
               double clearance_m);

}  // namespace vantage
