#include "vantage/cli/validation/settings_file.hpp"

#include <algorithm>
#include <array>

#include "vantage/core/error.hpp"
#include "vantage/core/fields.hpp"
#include "vantage/core/yaml.hpp"
#include "vantage/geometry/rgbd_camera.hpp"
#include "vantage/recipe/model_recipe.hpp"
#include "vantage/study/study.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;

Validation validate_recipe(const fs::path& file) {
  return validation_of([&] {
    read_model_recipe(file);
    return Validation{};
  });
}

Validation validate_sensor(const fs::path& file) {
  return validation_of([&] {
    FieldOfView sensor = kRgbdCamera;
    read_into(read_yaml(file), sensor);
    return Validation{};
  });
}

ConfigNode read_if_yaml(const fs::path& file) {
  try {
    return read_yaml(file);
  } catch (const Error&) {
    return {};  // who reads it as an episode says what is wrong
  }
}

}  // namespace

SettingsCheck settings_check(const fs::path& file) {
  if (is_study(file)) return validate_study;
  if (file.extension() != ".yaml" && file.extension() != ".yml") return nullptr;
  const ConfigNode root = read_if_yaml(file);
  const auto has = [&](const char* key) { return root.find(key) != nullptr; };
  if (has("recordings")) return validate_recipe;
  constexpr std::array kOfSensors{"half_width_rad", "tilt_min_rad", "tilt_max_rad", "range_min_m",
                                  "range_max_m"};
  return std::ranges::any_of(kOfSensors, has) ? validate_sensor : nullptr;
}

}  // namespace vantage
