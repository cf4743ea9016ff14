/// Where straight lines through a building meet its surfaces.
#pragma once

#include <cstdint>
#include <vector>

#include "vantage/building/building_mesh.hpp"

namespace vantage {

struct Crossing {
  std::uint32_t line = 0;  ///< v * u_m.size() + u
  double at_m = 0.0;       ///< along the line
  int side = 0;            ///< 1 if the surface's normal points along the line, else -1
};

/// Of lines along `axis` at each pair of u_m, v_m (ascending), which are the next two axes in the
/// order x, y, z, x: by line, then along it. A line through an edge that two triangles share meets
/// one of them.
std::vector<Crossing> line_crossings(const BuildingMesh& mesh,
                                     const std::vector<Triangle>& triangles, int axis,
                                     const std::vector<double>& u_m,
                                     const std::vector<double>& v_m);

}  // namespace vantage
