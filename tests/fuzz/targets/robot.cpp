// robot.yaml of a user's.
#include "tests/fuzz/fuzz_target.hpp"
#include "vantage/sim/robots/robot_description.hpp"

namespace vantage::fuzz {

void read_input(std::string_view bytes, const InputFolder& folder) {
  folder.put("mine/pr2.xml", "<mujoco/>");
  folder.put("mine/robot.yaml", bytes);
  read_robot(folder.path() / "mine");
}

}  // namespace vantage::fuzz
