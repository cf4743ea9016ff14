/// A triangle mesh in its own frame that answers ray queries; what RayScene instances meshes with.
/// Embree finds the triangles that a ray may meet, their distances are computed here: Embree's own
/// differ in the last digits between processors, and with them which of two triangles is met first.
/// Not for use outside ray_scene.cpp: it needs Embree's headers.
#pragma once

#include <embree3/rtcore.h>

#include <array>
#include <limits>
#include <memory>
#include <type_traits>
#include <vector>

#include "vantage/sim/world/mesh_surface.hpp"

namespace vantage {

struct ReleaseEmbree {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using EmbreeDevice = std::unique_ptr<std::remove_pointer_t<RTCDevice>, ReleaseEmbree>;
using EmbreeScene = std::unique_ptr<std::remove_pointer_t<RTCScene>, ReleaseEmbree>;

/// What a ray is asked for: the nearest hit, or any, which ends the search.
enum class Wanted { nearest, any };

/// Stays where it is: Embree keeps its address.
class EmbreeMesh {
 public:
  EmbreeMesh(RTCDevice device, const SurfaceMesh& mesh);
  EmbreeMesh(const EmbreeMesh&) = delete;
  EmbreeMesh& operator=(const EmbreeMesh&) = delete;

  [[nodiscard]] const Eigen::AlignedBox3d& box() const { return box_m_; }

  /// Distance along the unit vector `d` to the first triangle, either side, or to any, or infinity
  /// if that is not below `range_max_m`. A ray through an edge meets the triangles on both sides.
  [[nodiscard]] double cast(const Eigen::Vector3d& p, const Eigen::Vector3d& d, double range_max_m,
                            Wanted wanted = Wanted::nearest) const;

 private:
  static void bounds(const RTCBoundsFunctionArguments* arguments);
  static void intersect(const RTCIntersectFunctionNArguments* arguments);

  struct Triangle {
    std::array<Eigen::Vector3d, 3> corners_m;
    Eigen::Vector3d normal;  ///< of any length
    double offset;           ///< of its plane: where `normal` meets it
  };
  /// Whether it is met before `nearest_m`, which becomes its distance then.
  static bool meet(const Triangle& triangle, const Eigen::Vector3d& p, const Eigen::Vector3d& d,
                   double& nearest_m);

  std::vector<Triangle> triangles_;
  Eigen::AlignedBox3d box_m_;
  EmbreeScene scene_;
};

/// Ends a search of Embree.
constexpr float kSearchEnds = -std::numeric_limits<float>::infinity();

/// Rounded up to float with room for a tie, so that Embree does not skip what lies just as near.
float search_limit_m(double distance_m);

/// What holds `box_m` after rounding to float, for rays among coordinates of up to `reach_m` that
/// are rounded to float too.
RTCBounds padded_bounds(const Eigen::AlignedBox3d& box_m, double reach_m);

/// The largest coordinate, by size, of any point of it.
double reach_m(const Eigen::AlignedBox3d& box_m);

/// From `p` along `d` up to `range_max_m`.
RTCRayHit embree_ray(const Eigen::Vector3d& p, const Eigen::Vector3d& d, double range_max_m);

}  // namespace vantage
