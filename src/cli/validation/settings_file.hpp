/// Settings files that are no episodes, told by the keys that they alone have.
#pragma once

#include <filesystem>

#include "vantage/tasks/validate.hpp"

namespace vantage {

using SettingsCheck = Validation (*)(const std::filesystem::path&);

/// Of a study, a recipe of a model or a sensor; null: of none of these.
SettingsCheck settings_check(const std::filesystem::path& file);

}  // namespace vantage
