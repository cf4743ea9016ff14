#include "vantage/sim/world/model_check.hpp"

#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <vector>

#include "vantage/core/error.hpp"
#include "vantage/sim/world/mjcf_files.hpp"

namespace vantage {
namespace {

constexpr double kLongestTimestep_s = 0.1;
/// The canonical text of a scene has six significant digits.
constexpr double kRounding = 1e-4;

/// One array of numbers of a model, `width` per object.
struct ModelArray {
  std::string_view what;
  mjtObj kind;
  int objects;
  int width;
  const mjtNum* numbers;
};

std::vector<ModelArray> scene_arrays(const mjModel& m) {
  return {
      {"position", mjOBJ_BODY, m.nbody, 3, m.body_pos},
      {"orientation", mjOBJ_BODY, m.nbody, 4, m.body_quat},
      {"centre of mass", mjOBJ_BODY, m.nbody, 3, m.body_ipos},
      {"mass", mjOBJ_BODY, m.nbody, 1, m.body_mass},
      {"inertia", mjOBJ_BODY, m.nbody, 3, m.body_inertia},
      {"axis", mjOBJ_JOINT, m.njnt, 3, m.jnt_axis},
      {"anchor", mjOBJ_JOINT, m.njnt, 3, m.jnt_pos},
      {"range", mjOBJ_JOINT, m.njnt, 2, m.jnt_range},
      {"stiffness", mjOBJ_JOINT, m.njnt, 1, m.jnt_stiffness},
      {"position", mjOBJ_GEOM, m.ngeom, 3, m.geom_pos},
      {"orientation", mjOBJ_GEOM, m.ngeom, 4, m.geom_quat},
      {"size", mjOBJ_GEOM, m.ngeom, 3, m.geom_size},
      {"friction", mjOBJ_GEOM, m.ngeom, 3, m.geom_friction},
      {"position", mjOBJ_SITE, m.nsite, 3, m.site_pos},
      {"position", mjOBJ_CAMERA, m.ncam, 3, m.cam_pos},
      {"position", mjOBJ_LIGHT, m.nlight, 3, m.light_pos},
  };
}

/// Numbers that are not laid out per scene object.
std::vector<ModelArray> other_arrays(const mjModel& m) {
  return {
      {"start position (qpos0)", mjOBJ_UNKNOWN, m.nq, 1, m.qpos0},
      {"spring reference", mjOBJ_UNKNOWN, m.nq, 1, m.qpos_spring},
      {"joint damping", mjOBJ_UNKNOWN, m.nv, 1, m.dof_damping},
      {"joint armature", mjOBJ_UNKNOWN, m.nv, 1, m.dof_armature},
      {"joint friction", mjOBJ_UNKNOWN, m.nv, 1, m.dof_frictionloss},
      {"gain", mjOBJ_ACTUATOR, m.nu, mjNGAIN, m.actuator_gainprm},
      {"bias", mjOBJ_ACTUATOR, m.nu, mjNBIAS, m.actuator_biasprm},
      {"gear", mjOBJ_ACTUATOR, m.nu, 6, m.actuator_gear},
      {"control range", mjOBJ_ACTUATOR, m.nu, 2, m.actuator_ctrlrange},
      {"force range", mjOBJ_ACTUATOR, m.nu, 2, m.actuator_forcerange},
      {"gravity", mjOBJ_UNKNOWN, 1, 3, m.opt.gravity},
      {"wind", mjOBJ_UNKNOWN, 1, 3, m.opt.wind},
      {"density", mjOBJ_UNKNOWN, 1, 1, &m.opt.density},
      {"viscosity", mjOBJ_UNKNOWN, 1, 1, &m.opt.viscosity},
  };
}

std::string object_text(const mjModel& model, mjtObj kind, int id) {
  if (kind == mjOBJ_UNKNOWN) return fmt::format("number {}", id);
  const char* name = mj_id2name(&model, kind, id);
  return name != nullptr && *name != '\0'
             ? fmt::format("{} '{}'", mju_type2Str(kind), name)
             : fmt::format("unnamed {} number {}", mju_type2Str(kind), id);
}

void check_finite(const mjModel& model, const std::vector<ModelArray>& arrays,
                  const std::string& file) {
  for (const ModelArray& array : arrays) {
    for (int i = 0; i < array.objects * array.width; ++i) {
      if (!std::isfinite(array.numbers[i])) {
        throw InputError(fmt::format("{}: {} of {} is {}", file, array.what,
                                     object_text(model, array.kind, i / array.width),
                                     array.numbers[i]));
      }
    }
  }
}

bool same(double a, double b) {
  return std::abs(a - b) <= std::max(1e-6, kRounding * std::max(std::abs(a), std::abs(b)));
}

bool is_mesh(const mjModel& model, int geom) {
  return model.geom_type[geom] == mjGEOM_MESH && model.geom_dataid[geom] >= 0;
}

/// Of a mesh MuJoCo's own frame is compared by where it puts the vertices: its axes are those of
/// inertia, and round meshes have none that rounding would not turn.
bool is_frame_of_mesh(const mjModel& model, const ModelArray& array, int i) {
  return array.kind == mjOBJ_GEOM && array.what != "friction" && is_mesh(model, i / array.width);
}

void check_same(const mjModel& model, const ModelArray& alone, const ModelArray& together,
                const std::string& file) {
  for (int i = 0; i < alone.objects * alone.width; ++i) {
    if (is_frame_of_mesh(model, alone, i)) continue;
    if (same(alone.numbers[i], together.numbers[i])) continue;
    throw InputError(fmt::format(
        "{}: cannot stand beside a robot: {} of {} would change from {:.6g} to {:.6g}. Compiler "
        "settings that act on a whole model (settotalmass, boundmass, ...) have to be removed",
        file, alone.what, object_text(model, alone.kind, i / alone.width), alone.numbers[i],
        together.numbers[i]));
  }
}

/// A vertex of a geom's mesh in the frame of its body.
std::array<mjtNum, 3> placed_vertex(const mjModel& model, int geom, int vertex) {
  const float* p = model.mesh_vert + 3 * (model.mesh_vertadr[model.geom_dataid[geom]] + vertex);
  const std::array<mjtNum, 3> p_mesh{p[0], p[1], p[2]};
  std::array<mjtNum, 3> p_body{};
  mju_rotVecQuat(p_body.data(), p_mesh.data(), model.geom_quat + 4 * geom);
  mju_addTo3(p_body.data(), model.geom_pos + 3 * geom);
  return p_body;
}

void check_same_mesh(const mjModel& scene, const mjModel& both, int geom, const std::string& file) {
  constexpr double kSame_m = 1e-3;
  const int vertices = scene.mesh_vertnum[scene.geom_dataid[geom]];
  bool same_mesh = is_mesh(both, geom) && both.mesh_vertnum[both.geom_dataid[geom]] == vertices;
  for (int i = 0; same_mesh && i < vertices; ++i) {
    const auto alone = placed_vertex(scene, geom, i);
    const auto together = placed_vertex(both, geom, i);
    same_mesh = mju_dist3(alone.data(), together.data()) <= kSame_m;
  }
  if (same_mesh) return;
  throw InputError(fmt::format("{}: cannot stand beside a robot: the mesh of {} would change", file,
                               object_text(scene, mjOBJ_GEOM, geom)));
}

}  // namespace

void check_model(const mjModel& model, const std::string& file) {
  const double timestep_s = model.opt.timestep;
  if (!(timestep_s > 0.0 && timestep_s <= kLongestTimestep_s)) {
    throw InputError(fmt::format("{}: option timestep is {} s, must be above 0 and at most {} s",
                                 file, timestep_s, kLongestTimestep_s));
  }
  check_finite(model, scene_arrays(model), file);
  check_finite(model, other_arrays(model), file);
  for (int i = 0; i < 3 * model.nmeshvert; ++i) {
    if (!std::isfinite(model.mesh_vert[i])) {
      throw InputError(fmt::format("{}: a mesh has a vertex that is not finite", file));
    }
  }
}

void check_no_robot_names(const mjModel& model, const std::string& file) {
  constexpr std::string_view prefix = "robot/";
  // All names lie behind each other, each with a final zero; the first is the model's own.
  for (int begin = 0; begin < model.nnames;) {
    const std::string_view name = model.names + begin;
    if (name.starts_with(prefix)) {
      throw InputError(
          fmt::format("{}: the name '{}' starts with '{}', which is kept for the robot; rename it",
                      file, name, prefix));
    }
    begin += static_cast<int>(name.size()) + 1;
  }
}

void check_no_files(std::string_view mjcf, const std::string& file) {
  for (const MjcfAttribute& attribute : mjcf_attributes(mjcf)) {
    if (!attribute.names_file()) continue;
    throw InputError(
        fmt::format("{}: refers to '{}'; a robot is one MJCF file of primitives, without meshes, "
                    "textures and includes",
                    file, attribute.value));
  }
}

void check_same_scene(const mjModel& scene, const mjModel& both, const std::string& file) {
  const std::vector<ModelArray> alone = scene_arrays(scene);
  const std::vector<ModelArray> together = scene_arrays(both);
  for (std::size_t i = 0; i < alone.size(); ++i) {
    if (together[i].objects < alone[i].objects) {
      throw InputError(fmt::format("{}: cannot stand beside a robot: loses a {}", file,
                                   mju_type2Str(alone[i].kind)));
    }
    check_same(scene, alone[i], together[i], file);
  }
  for (int geom = 0; geom < scene.ngeom; ++geom) {
    if (is_mesh(scene, geom)) check_same_mesh(scene, both, geom, file);
  }
}

}  // namespace vantage
