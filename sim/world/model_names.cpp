#include "vantage/sim/world/model_names.hpp"

#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <utility>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {

int mujoco_kind(ModelObject kind) {
  switch (kind) {
    case ModelObject::body: return mjOBJ_BODY;
    case ModelObject::joint: return mjOBJ_JOINT;
    case ModelObject::geom: return mjOBJ_GEOM;
    case ModelObject::site: return mjOBJ_SITE;
    case ModelObject::camera: return mjOBJ_CAMERA;
    case ModelObject::actuator: return mjOBJ_ACTUATOR;
  }
  return mjOBJ_UNKNOWN;
}

}  // namespace

std::optional<int> find_model_id(const mjModel& model, ModelObject kind, const std::string& name) {
  const int id = mj_name2id(&model, mujoco_kind(kind), name.c_str());
  return id < 0 ? std::nullopt : std::optional(id);
}

int model_id(const mjModel& model, ModelObject kind, const std::string& name) {
  if (const auto id = find_model_id(model, kind, name)) return *id;
  throw InputError(
      fmt::format("the model has no {} called '{}'", mju_type2Str(mujoco_kind(kind)), name));
}

std::string model_name(const mjModel& model, ModelObject kind, int id) {
  const char* name = mj_id2name(&model, mujoco_kind(kind), id);
  return name == nullptr ? "" : name;
}

std::vector<std::string> model_names(const mjModel& model, ModelObject kind) {
  const auto count = [&] {
    switch (kind) {
      case ModelObject::body: return model.nbody;
      case ModelObject::joint: return model.njnt;
      case ModelObject::geom: return model.ngeom;
      case ModelObject::site: return model.nsite;
      case ModelObject::camera: return model.ncam;
      case ModelObject::actuator: return model.nu;
    }
    return 0;
  };
  std::vector<std::string> names;
  for (int id = 0; id < count(); ++id) {
    if (auto name = model_name(model, kind, id); !name.empty()) names.push_back(std::move(name));
  }
  return names;
}

}  // namespace vantage
