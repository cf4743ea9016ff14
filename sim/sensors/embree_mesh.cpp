#include "vantage/sim/sensors/embree_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace vantage {
namespace {

void upload(RTCGeometry geometry, const SurfaceMesh& mesh) {
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                               RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                               mesh.vertices_m.size()));
  for (const Eigen::Vector3d& p : mesh.vertices_m) {
    for (int axis = 0; axis < 3; ++axis) *vertices++ = static_cast<float>(p[axis]);
  }
  auto* indices = static_cast<unsigned*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(unsigned), mesh.triangles.size()));
  for (const auto& triangle : mesh.triangles) {
    for (const int vertex : triangle) *indices++ = static_cast<unsigned>(vertex);
  }
}

}  // namespace

EmbreeMesh::EmbreeMesh(RTCDevice device, SurfaceMesh mesh)
    : mesh_(std::move(mesh)), scene_(rtcNewScene(device)) {
  for (const Eigen::Vector3d& p : mesh_.vertices_m) box_m_.extend(p);
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  upload(geometry, mesh_);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_.get(), geometry);
  rtcReleaseGeometry(geometry);
  rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
  rtcCommitScene(scene_.get());
}

double EmbreeMesh::cast(const Eigen::Vector3d& p, const Eigen::Vector3d& d,
                        double range_max_m) const {
  constexpr double nothing = std::numeric_limits<double>::infinity();
  // Embree computes in float: start where the ray enters the bounding sphere, not far away.
  const Eigen::Vector3d to_centre = box_m_.center() - p;
  const double radius = 0.5 * box_m_.diagonal().norm() + 1e-6;
  const double along = to_centre.dot(d);
  if (along + radius < 0.0 || (to_centre - along * d).norm() > radius) return nothing;
  const double skipped = std::max(0.0, along - radius);
  if (skipped >= range_max_m) return nothing;

  const Eigen::Vector3f origin = (p + skipped * d).cast<float>();
  const Eigen::Vector3f direction = d.cast<float>();
  RTCRayHit query{};
  query.ray = {origin.x(),
               origin.y(),
               origin.z(),
               0.0F,
               direction.x(),
               direction.y(),
               direction.z(),
               0.0F,
               static_cast<float>(2.1 * radius + std::max(0.0, along) - skipped),
               0xFFFFFFFFU,
               0,
               0};
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene_.get(), &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return nothing;
  const double distance =
      distance_to_plane(query.hit.primID, p, d, skipped + static_cast<double>(query.ray.tfar));
  return distance < range_max_m ? distance : nothing;
}

double EmbreeMesh::distance_to_plane(std::size_t triangle, const Eigen::Vector3d& p,
                                     const Eigen::Vector3d& d, double otherwise) const {
  const auto& [a, b, c] = mesh_.triangles[triangle];
  const Eigen::Vector3d& p_a = mesh_.vertices_m[static_cast<std::size_t>(a)];
  const Eigen::Vector3d normal = (mesh_.vertices_m[static_cast<std::size_t>(b)] - p_a)
                                     .cross(mesh_.vertices_m[static_cast<std::size_t>(c)] - p_a);
  const double slope = normal.dot(d);
  if (std::abs(slope) < 1e-6 * normal.norm()) return otherwise;
  return std::max(0.0, normal.dot(p_a - p) / slope);
}

}  // namespace vantage
