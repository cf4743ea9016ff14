/// What a piece of furniture is bumped into by: convex pieces that leave its recesses open.
#pragma once

#include <vector>

#include "vantage/models/catalogue/shapes/footprint.hpp"
#include "vantage/models/catalogue/shapes/mesh.hpp"

namespace vantage {

/// The connected parts of `mesh`, put together as long as the convex outline of a piece, seen from
/// above, nowhere reaches farther than `slack_m` beyond what the mesh covers there: a desk is one
/// piece, a screen on two long feet is three. The largest outline first. A part counts as the
/// convex hull of itself.
std::vector<TriangleMesh> solid_pieces(const TriangleMesh& mesh, double slack_m);

}  // namespace vantage
