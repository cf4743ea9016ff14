/// MJCF literals inside tests.
#pragma once

#include <mujoco/mujoco.h>

#include <array>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>

#include "vantage/sim/world/mujoco_errors.hpp"

namespace vantage::test {

struct FreeMujoco {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
  void operator()(mjData* data) const { mj_deleteData(data); }
  void operator()(mjVFS* vfs) const {
    mj_deleteVFS(vfs);
    delete vfs;
  }
};

/// A compiled model and its state, with forward kinematics done.
struct MjcfModel {
  std::unique_ptr<mjModel, FreeMujoco> model;
  std::unique_ptr<mjData, FreeMujoco> data;

  [[nodiscard]] int body(const char* name) const {
    return mj_name2id(model.get(), mjOBJ_BODY, name);
  }
  [[nodiscard]] int geom(const char* name) const {
    return mj_name2id(model.get(), mjOBJ_GEOM, name);
  }
  [[nodiscard]] int camera(const char* name) const {
    return mj_name2id(model.get(), mjOBJ_CAMERA, name);
  }
};

inline MjcfModel compile_mjcf(const std::string& xml) {
  install_mujoco_handlers();
  auto* files = new mjVFS;  // 2 MB: too large for the stack
  mj_defaultVFS(files);
  const std::unique_ptr<mjVFS, FreeMujoco> owner(files);
  mj_makeEmptyFileVFS(files, "test.xml", static_cast<int>(xml.size()));
  std::memcpy(files->filedata[0], xml.data(), xml.size());
  std::array<char, 1000> error{};
  MjcfModel made;
  made.model.reset(mj_loadXML("test.xml", files, error.data(), static_cast<int>(error.size())));
  if (!made.model) throw std::runtime_error(error.data());
  made.data.reset(mj_makeData(made.model.get()));
  mj_forward(made.model.get(), made.data.get());
  return made;
}

}  // namespace vantage::test
