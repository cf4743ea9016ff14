/// Surface normals of a point cloud.
#pragma once

#include <Eigen/Core>

#include "vantage/core/fields.hpp"
#include "vantage/perception/clouds/point_cloud.hpp"

namespace vantage {

struct NormalOptions {
  double radius_m = 0.08;
  int min_neighbours = 5;
  double line_ratio = 0.05;
  void fields(auto&& f) {
    f("radius_m", radius_m,
      "radius of the neighbourhood that a normal is fitted to; higher is smoother and rounds edges",
      above(0.0));
    f("min_neighbours", min_neighbours,
      "least number of points in the neighbourhood, below which a point gets no normal",
      at_least(3));
    f("line_ratio", line_ratio,
      "ratio of the second to the greatest variance below which a neighbourhood is a line and no "
      "plane; higher takes more for lines",
      between(0.0, 1.0));
  }
};

/// Fills in `cloud.normals`: the direction of least spread of each point's neighbourhood
/// [Hoppe1992], pointing to the side of `p_viewpoint` (same frame as the cloud). A neighbourhood
/// that is a horizontal line, as a planar scanner draws it on a wall, gets the horizontal normal
/// across it; any other line, and a point without neighbours, gets zero.
void estimate_normals(PointCloud& cloud, const Eigen::Vector3d& p_viewpoint,
                      const NormalOptions& options = {});

}  // namespace vantage
