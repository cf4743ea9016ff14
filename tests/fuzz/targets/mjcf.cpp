// A scene of a user's, through MuJoCo and our checks.
#include "tests/fuzz/fuzz_target.hpp"
#include "vantage/sim/world/scene.hpp"

namespace vantage::fuzz {

void read_input(std::string_view bytes, const InputFolder& folder) {
  load_model(ModelSource{.scene = folder.put("scene.xml", bytes), .robot = {}});
}

}  // namespace vantage::fuzz
