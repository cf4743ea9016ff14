#include "vantage/sim/sensors/ray_scene.hpp"

#include <mujoco/mujoco.h>

#include <array>
#include <cmath>
#include <map>
#include <unordered_map>
#include <utility>
#include <vector>

#include "vantage/core/error.hpp"
#include "vantage/sim/sensors/embree_mesh.hpp"

namespace vantage {
namespace {

using RowMajor3d = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

struct SolidGeom {
  int geom_id = -1;
  int body_id = -1;
  int type = mjGEOM_NONE;
  Eigen::Vector3d size_m;
  Eigen::AlignedBox3d box_m;         ///< in the geom's frame; unused for planes
  const EmbreeMesh* mesh = nullptr;  ///< of meshes and height fields
  Eigen::Vector3d p_world_m = Eigen::Vector3d::Zero();
  RowMajor3d R_world = RowMajor3d::Zero();
};

/// @return whether it was elsewhere
bool place(SolidGeom& geom, const mjData& data) {
  const Eigen::Map<const Eigen::Vector3d> p_world_m(data.geom_xpos + 3 * geom.geom_id);
  const Eigen::Map<const RowMajor3d> R_world(data.geom_xmat + 9 * geom.geom_id);
  const bool changed = p_world_m != geom.p_world_m || R_world != geom.R_world;
  geom.p_world_m = p_world_m;
  geom.R_world = R_world;
  return changed;
}

/// Distance along the ray, infinity if it is not below `range_max_m`.
double cast_geom(const SolidGeom& geom, const Eigen::Vector3d& p, const Eigen::Vector3d& d,
                 double range_max_m, Wanted wanted) {
  if (geom.mesh != nullptr) {
    return geom.mesh->cast(geom.R_world.transpose() * (p - geom.p_world_m),
                           geom.R_world.transpose() * d, range_max_m, wanted);
  }
  const double distance = mju_rayGeom(geom.p_world_m.data(), geom.R_world.data(),
                                      geom.size_m.data(), p.data(), d.data(), geom.type);
  return distance >= 0.0 && distance < range_max_m ? distance
                                                   : std::numeric_limits<double>::infinity();
}

/// A ray on its way through Embree; the base class must come first.
struct RayQuery : RTCIntersectContext {
  RayQuery(const Eigen::Vector3d& from_m, const Eigen::Vector3d& along, double range_max_m,
           int without_body, Wanted what)
      : p_world_m(from_m), direction(along), exclude_body(without_body), wanted(what) {
    expects(std::abs(direction.squaredNorm() - 1.0) < 1e-9, "ray direction of length 1");
    rtcInitIntersectContext(this);
    best.distance_m = range_max_m;
  }

  Eigen::Vector3d p_world_m;
  Eigen::Vector3d direction;
  int exclude_body;
  Wanted wanted;
  RayHit best;

  /// @return whether `geom` is the nearest so far.
  bool meet(const SolidGeom& geom) {
    if (geom.body_id == exclude_body) return false;
    const double limit = std::nextafter(best.distance_m, std::numeric_limits<double>::infinity());
    const double distance = cast_geom(geom, p_world_m, direction, limit, wanted);
    const bool nearer =
        distance < best.distance_m || (distance == best.distance_m && std::isfinite(distance) &&
                                       (best.geom_id < 0 || geom.geom_id < best.geom_id));
    if (nearer) best = {distance, geom.geom_id};
    return nearer;
  }
};

Eigen::AlignedBox3d world_box(const SolidGeom& geom) {
  const Eigen::Vector3d centre = geom.p_world_m + geom.R_world * geom.box_m.center();
  const Eigen::Vector3d half = geom.R_world.cwiseAbs() * (0.5 * geom.box_m.sizes());
  return {centre - half, centre + half};
}

/// One for all scenes, which keep it. One thread builds: the same tree on every run. Embree would
/// wake another one for a second device, and a process that has threads cannot be forked.
EmbreeDevice shared_device() {
  static const EmbreeDevice device(rtcNewDevice("threads=1"));
  if (!device) throw Error(ExitCode::internal, "Embree: no device for ray casting");
  rtcRetainDevice(device.get());
  return EmbreeDevice(device.get());
}

}  // namespace

class RayScene::Impl {
 public:
  Impl(const mjModel& model, const mjData& data, const GeomFilter& filter);
  void update(const mjData& data);
  [[nodiscard]] RayHit cast(RayQuery& query) const;
  [[nodiscard]] bool blocks(RayQuery& query, int& blocker_id) const;

 private:
  /// Geoms in a tree of their own.
  struct Tree {
    std::vector<SolidGeom> geoms;
    EmbreeScene scene;
  };

  void add(const mjModel& model, const mjData& data, int geom_id);
  const EmbreeMesh* mesh_of(const mjModel& model, int geom_id);
  void plant(Tree& tree);
  static void commit(const Tree& tree);
  static void bounds(const RTCBoundsFunctionArguments* arguments);
  static void intersect(const RTCIntersectFunctionNArguments* arguments);

  EmbreeDevice device_;
  std::map<std::pair<int, int>, std::unique_ptr<EmbreeMesh>> meshes_;  ///< by geom type and asset
  std::vector<SolidGeom> planes_;  ///< unbounded and few: tested one by one
  Tree still_;                     ///< built once, however large
  Tree moving_;
  std::unordered_map<int, const SolidGeom*> bounded_;  ///< all but planes, by their ids
};

RayScene::Impl::Impl(const mjModel& model, const mjData& data, const GeomFilter& filter)
    : device_(shared_device()) {
  for (const int geom_id : solid_geoms(model, filter)) add(model, data, geom_id);
  plant(still_);
  plant(moving_);
}

/// Once all its geoms are there.
void RayScene::Impl::plant(Tree& tree) {
  for (const SolidGeom& geom : tree.geoms) bounded_[geom.geom_id] = &geom;
  tree.scene.reset(rtcNewScene(device_.get()));
  RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(tree.geoms.size()));
  rtcSetGeometryUserData(geometry, &tree);
  rtcSetGeometryBoundsFunction(geometry, &Impl::bounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry, &Impl::intersect);
  rtcAttachGeometryByID(tree.scene.get(), geometry, 0);
  rtcReleaseGeometry(geometry);
  rtcSetSceneFlags(tree.scene.get(), RTC_SCENE_FLAG_ROBUST);
  commit(tree);
}

void RayScene::Impl::add(const mjModel& model, const mjData& data, int geom_id) {
  SolidGeom geom;
  geom.geom_id = geom_id;
  geom.body_id = model.geom_bodyid[geom_id];
  geom.type = model.geom_type[geom_id];
  geom.size_m = Eigen::Map<const Eigen::Vector3d>(model.geom_size + 3 * geom_id);
  place(geom, data);
  if (geom.type == mjGEOM_PLANE) {
    planes_.push_back(geom);
    return;
  }
  geom.mesh = mesh_of(model, geom_id);
  if (geom.mesh != nullptr) {
    geom.box_m = geom.mesh->box();
  } else {
    const Eigen::Vector3d half = primitive_half_extent(model, geom_id);
    geom.box_m = {-half, half};
  }
  (is_moving_geom(model, geom_id) ? moving_ : still_).geoms.push_back(geom);
}

const EmbreeMesh* RayScene::Impl::mesh_of(const mjModel& model, int geom_id) {
  const int type = model.geom_type[geom_id];
  if (type != mjGEOM_MESH && type != mjGEOM_HFIELD) return nullptr;
  auto& mesh = meshes_[{type, model.geom_dataid[geom_id]}];
  if (!mesh) {
    mesh = std::make_unique<EmbreeMesh>(device_.get(), geom_triangles(model, geom_id, 1.0));
  }
  return mesh.get();
}

void RayScene::Impl::commit(const Tree& tree) {
  rtcCommitGeometry(rtcGetGeometry(tree.scene.get(), 0));
  rtcCommitScene(tree.scene.get());
}

/// What hangs on no joint may be put elsewhere too, but seldom is.
void RayScene::Impl::update(const mjData& data) {
  for (SolidGeom& plane : planes_) place(plane, data);
  for (SolidGeom& geom : moving_.geoms) place(geom, data);
  commit(moving_);
  bool changed = false;
  for (SolidGeom& geom : still_.geoms) changed = place(geom, data) || changed;
  if (changed) commit(still_);
}

void RayScene::Impl::bounds(const RTCBoundsFunctionArguments* arguments) {
  const auto& tree = *static_cast<const Tree*>(arguments->geometryUserPtr);
  const Eigen::AlignedBox3d box = world_box(tree.geoms[arguments->primID]);
  *arguments->bounds_o = padded_bounds(box, reach_m(box));
}

void RayScene::Impl::intersect(const RTCIntersectFunctionNArguments* arguments) {
  if (arguments->valid[0] == 0) return;
  const auto& tree = *static_cast<const Tree*>(arguments->geometryUserPtr);
  auto& query = *static_cast<RayQuery*>(arguments->context);
  if (!query.meet(tree.geoms[arguments->primID])) return;
  RTCRayN* ray = RTCRayHitN_RayN(arguments->rayhit, arguments->N);
  RTCRayN_tfar(ray, arguments->N, 0) =
      query.wanted == Wanted::any ? kSearchEnds : search_limit_m(query.best.distance_m);
}

RayHit RayScene::Impl::cast(RayQuery& query) const {
  const double range_max_m = query.best.distance_m;
  const auto is_over = [&] { return query.wanted == Wanted::any && query.best.hit(); };
  for (const SolidGeom& plane : planes_) query.meet(plane);
  for (const Tree* tree : {&still_, &moving_}) {
    if (tree->geoms.empty() || is_over()) continue;
    RTCRayHit ray = embree_ray(query.p_world_m, query.direction, query.best.distance_m);
    rtcIntersect1(tree->scene.get(), &query, &ray);
  }
  return query.best.hit() && query.best.distance_m <= range_max_m ? query.best : RayHit{};
}

bool RayScene::Impl::blocks(RayQuery& query, int& blocker_id) const {
  const auto last = bounded_.find(blocker_id);
  if (last != bounded_.end() && query.meet(*last->second)) return true;
  const RayHit hit = cast(query);
  if (hit.hit()) blocker_id = hit.geom_id;
  return hit.hit();
}

RayScene::RayScene(const mjModel& model, const mjData& data, const GeomFilter& filter)
    : impl_(std::make_unique<Impl>(model, data, filter)) {}
RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;

void RayScene::update(const mjData& data) { impl_->update(data); }

RayHit RayScene::cast(const Eigen::Vector3d& p_world_m, const Eigen::Vector3d& direction,
                      double range_max_m, int exclude_body) const {
  RayQuery query(p_world_m, direction, range_max_m, exclude_body, Wanted::nearest);
  return impl_->cast(query);
}

bool RayScene::blocks(const Eigen::Vector3d& p_world_m, const Eigen::Vector3d& direction,
                      double range_max_m, int exclude_body, int& blocker_id) const {
  RayQuery query(p_world_m, direction, range_max_m, exclude_body, Wanted::any);
  return impl_->blocks(query, blocker_id);
}

}  // namespace vantage
