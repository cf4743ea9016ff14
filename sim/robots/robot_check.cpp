#include "vantage/sim/robots/robot_check.hpp"

#include "vantage/core/atomic_file.hpp"
#include "vantage/sim/robots/mobile_base.hpp"
#include "vantage/sim/robots/quadrotor.hpp"
#include "vantage/sim/world/model_check.hpp"
#include "vantage/sim/world/scene.hpp"

namespace vantage {

void check_robot(const RobotFolder& robot) {
  const LoadedModel alone = load_model({.scene = robot.mjcf, .robot = {}});
  check_no_files(read_file(robot.mjcf), robot.mjcf.string());
  const std::string where = robot.description.string();
  if (const auto* base = std::get_if<MobileBaseDescription>(&robot.kind)) {
    MobileBase(*alone.model, *base, where);
  } else {
    Quadrotor(*alone.model, std::get<QuadrotorDescription>(robot.kind), where, robot.mjcf.string());
  }
}

}  // namespace vantage
