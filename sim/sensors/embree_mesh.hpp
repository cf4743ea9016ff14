/// A triangle mesh in its own frame that answers ray queries; what RayScene instances meshes with.
/// Not for use outside ray_scene.cpp: it needs Embree's headers.
#pragma once

#include <embree3/rtcore.h>

#include <memory>
#include <type_traits>

#include "vantage/sim/world/mesh_surface.hpp"

namespace vantage {

struct ReleaseEmbree {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using EmbreeDevice = std::unique_ptr<std::remove_pointer_t<RTCDevice>, ReleaseEmbree>;
using EmbreeScene = std::unique_ptr<std::remove_pointer_t<RTCScene>, ReleaseEmbree>;

class EmbreeMesh {
 public:
  EmbreeMesh(RTCDevice device, SurfaceMesh mesh);

  [[nodiscard]] const Eigen::AlignedBox3d& box() const { return box_m_; }

  /// Distance along the unit vector `d` to the first triangle, either side, or infinity if that is
  /// not below `range_max_m`.
  [[nodiscard]] double cast(const Eigen::Vector3d& p, const Eigen::Vector3d& d,
                            double range_max_m) const;

 private:
  [[nodiscard]] double distance_to_plane(std::size_t triangle, const Eigen::Vector3d& p,
                                         const Eigen::Vector3d& d, double otherwise) const;

  SurfaceMesh mesh_;
  Eigen::AlignedBox3d box_m_;
  EmbreeScene scene_;
};

}  // namespace vantage
