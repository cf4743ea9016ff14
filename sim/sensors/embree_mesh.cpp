#include "vantage/sim/sensors/embree_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vantage {
namespace {

constexpr double nothing = std::numeric_limits<double>::infinity();

/// A ray on its way through Embree; the base class must come first.
struct TriangleQuery : RTCIntersectContext {
  Eigen::Vector3d p;
  Eigen::Vector3d d;
  double skipped_m = 0.0;  ///< where Embree's ray begins
  double nearest_m = nothing;
  Wanted wanted = Wanted::nearest;
};

}  // namespace

EmbreeMesh::EmbreeMesh(RTCDevice device, const SurfaceMesh& mesh) : scene_(rtcNewScene(device)) {
  for (const Eigen::Vector3d& p : mesh.vertices_m) box_m_.extend(p);
  for (const auto& [i, j, k] : mesh.triangles) {
    const Eigen::Vector3d& a = mesh.vertices_m[static_cast<std::size_t>(i)];
    const Eigen::Vector3d& b = mesh.vertices_m[static_cast<std::size_t>(j)];
    const Eigen::Vector3d& c = mesh.vertices_m[static_cast<std::size_t>(k)];
    const Eigen::Vector3d normal = (b - a).cross(c - a);
    triangles_.push_back({{a, b, c}, normal, normal.dot(a)});
  }
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(triangles_.size()));
  rtcSetGeometryUserData(geometry, this);
  rtcSetGeometryBoundsFunction(geometry, &EmbreeMesh::bounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry, &EmbreeMesh::intersect);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_.get(), geometry);
  rtcReleaseGeometry(geometry);
  rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
  rtcCommitScene(scene_.get());
}

void EmbreeMesh::bounds(const RTCBoundsFunctionArguments* arguments) {
  const auto& mesh = *static_cast<const EmbreeMesh*>(arguments->geometryUserPtr);
  Eigen::AlignedBox3d box_m;
  for (const Eigen::Vector3d& corner : mesh.triangles_[arguments->primID].corners_m) {
    box_m.extend(corner);
  }
  *arguments->bounds_o = padded_bounds(box_m, reach_m(mesh.box_m_));
}

void EmbreeMesh::intersect(const RTCIntersectFunctionNArguments* arguments) {
  if (arguments->valid[0] == 0) return;
  const auto& mesh = *static_cast<const EmbreeMesh*>(arguments->geometryUserPtr);
  auto& query = *static_cast<TriangleQuery*>(arguments->context);
  if (!meet(mesh.triangles_[arguments->primID], query.p, query.d, query.nearest_m)) return;
  RTCRayN* ray = RTCRayHitN_RayN(arguments->rayhit, arguments->N);
  RTCRayN_tfar(ray, arguments->N, 0) =
      query.wanted == Wanted::any ? kSearchEnds : search_limit_m(query.nearest_m - query.skipped_m);
}

double EmbreeMesh::cast(const Eigen::Vector3d& p, const Eigen::Vector3d& d, double range_max_m,
                        Wanted wanted) const {
  // Embree searches in float: start where the ray enters the bounding sphere, not far away.
  const Eigen::Vector3d to_centre = box_m_.center() - p;
  const double radius = 0.5 * box_m_.diagonal().norm() + 1e-6;
  const double along = to_centre.dot(d);
  if (along + radius < 0.0 || (to_centre - along * d).norm() > radius) return nothing;

  TriangleQuery query;
  rtcInitIntersectContext(&query);
  query.p = p;
  query.d = d;
  query.nearest_m = range_max_m;
  query.wanted = wanted;
  query.skipped_m = std::max(0.0, along - radius);
  if (query.skipped_m >= range_max_m) return nothing;
  RTCRayHit ray = embree_ray(p + query.skipped_m * d, d,
                             std::min(range_max_m, along + radius) - query.skipped_m);
  rtcIntersect1(scene_.get(), &query, &ray);
  return query.nearest_m < range_max_m ? query.nearest_m : nothing;
}

/// Two triangles that share an edge compute the same number for it but for its sign, so that no ray
/// passes between them.
bool EmbreeMesh::meet(const Triangle& triangle, const Eigen::Vector3d& p, const Eigen::Vector3d& d,
                      double& nearest_m) {
  const double distance_m = (triangle.offset - triangle.normal.dot(p)) / triangle.normal.dot(d);
  if (!(distance_m >= 0.0 && distance_m < nearest_m)) return false;
  const Eigen::Vector3d a = triangle.corners_m[0] - p;
  const Eigen::Vector3d b = triangle.corners_m[1] - p;
  const Eigen::Vector3d c = triangle.corners_m[2] - p;
  const auto [least, most] = std::minmax({a.cross(b).dot(d), b.cross(c).dot(d), c.cross(a).dot(d)});
  if (least < 0.0 && most > 0.0) return false;
  nearest_m = distance_m;
  return true;
}

float search_limit_m(double distance_m) { return static_cast<float>(distance_m * 1.00001 + 1e-5); }

double reach_m(const Eigen::AlignedBox3d& box_m) {
  return box_m.min().cwiseAbs().cwiseMax(box_m.max().cwiseAbs()).maxCoeff();
}

RTCBounds padded_bounds(const Eigen::AlignedBox3d& box_m, double reach_m) {
  const double pad_m = 1e-5 + 1e-6 * reach_m;
  const Eigen::Vector3f low = (box_m.min().array() - pad_m).cast<float>();
  const Eigen::Vector3f high = (box_m.max().array() + pad_m).cast<float>();
  return {low.x(), low.y(), low.z(), 0.0F, high.x(), high.y(), high.z(), 0.0F};
}

RTCRayHit embree_ray(const Eigen::Vector3d& p, const Eigen::Vector3d& d, double range_max_m) {
  const Eigen::Vector3f origin = p.cast<float>();
  const Eigen::Vector3f direction = d.cast<float>();
  RTCRayHit ray{};
  ray.ray = {origin.x(),
             origin.y(),
             origin.z(),
             0.0F,
             direction.x(),
             direction.y(),
             direction.z(),
             0.0F,
             search_limit_m(range_max_m),
             0xFFFFFFFFU,
             0,
             0};
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  return ray;
}

}  // namespace vantage
