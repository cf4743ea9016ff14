// Intrinsics and poses beside a user's pictures.
#include "tests/fuzz/fuzz_target.hpp"
#include "vantage/core/error.hpp"
#include "vantage/dataset/pictures/intrinsics_file.hpp"
#include "vantage/dataset/pictures/pose_file.hpp"

namespace vantage::fuzz {

void read_input(std::string_view bytes, const InputFolder& folder) {
  const auto file = folder.put("camera.yaml", bytes);
  try {
    read_intrinsics(file);
  } catch (const Error&) {
  }
  read_picture_pose(file);
}

}  // namespace vantage::fuzz
