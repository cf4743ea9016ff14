// A network of a user's.
#include "vantage/perception/features/onnx.hpp"

#include <tuple>

#include "tests/fuzz/fuzz_target.hpp"

namespace vantage::fuzz {

void read_input(std::string_view bytes, const InputFolder&) {
  const OnnxNetwork network(std::string(bytes), "network.onnx");
  std::ignore = network.compute(Eigen::VectorXf::Zero(3 * Onnx::side_px * Onnx::side_px));
}

}  // namespace vantage::fuzz
