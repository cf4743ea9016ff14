// Any YAML: what is read is written, and read again.
#include "vantage/core/yaml.hpp"

#include "tests/fuzz/fuzz_target.hpp"

namespace vantage::fuzz {

void read_input(std::string_view bytes, const InputFolder&) {
  const ConfigNode root = parse_yaml(bytes, "input.yaml");
  parse_yaml(to_yaml(root), "written.yaml");
}

}  // namespace vantage::fuzz
