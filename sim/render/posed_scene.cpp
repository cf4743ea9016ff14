#include "vantage/sim/render/posed_scene.hpp"

#include <mujoco/mujoco.h>

#include <string>
#include <utility>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {

int id_of(const mjModel& model, mjtObj kind, std::string_view name) {
  const int id = mj_name2id(&model, kind, std::string(name).c_str());
  expects(id >= 0, "a name of the model");
  return id;
}

}  // namespace

PosedScene::PosedScene(ModelPtr model, int width_px, int height_px,
                       std::shared_ptr<OffscreenContext> context)
    : model_(std::move(model)),
      data_(mj_makeData(model_.get())),
      renderer_(make_offscreen_renderer(*model_, width_px, height_px, std::move(context))) {}

void PosedScene::set_pose(std::string_view body, const Pose& T_world_body) {
  const int mocap = model_->body_mocapid[id_of(*model_, mjOBJ_BODY, body)];
  expects(mocap >= 0, "a mocap body");
  const Eigen::Quaterniond q(T_world_body.linear());
  Eigen::Map<Eigen::Vector3d>(data_->mocap_pos + 3 * mocap) = T_world_body.translation();
  Eigen::Map<Eigen::Vector4d>(data_->mocap_quat + 4 * mocap) << q.w(), q.x(), q.y(), q.z();
}

void PosedScene::render(std::string_view camera, const RenderRequest& request,
                        RenderedImages& out) {
  mj_kinematics(model_.get(), data_.get());
  mj_camlight(model_.get(), data_.get());
  renderer_->render(*model_, *data_, FixedCamera{id_of(*model_, mjOBJ_CAMERA, camera), {}}, request,
                    out);
}

int PosedScene::geom_id(std::string_view name) const { return id_of(*model_, mjOBJ_GEOM, name); }

}  // namespace vantage
