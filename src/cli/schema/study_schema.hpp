/// JSON schema of a study's file.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace vantage {

/// @param tasks from the name of a task to the schema of its episodes: a study's file does not say
/// of which its episode is, so its overrides are of any
nlohmann::ordered_json study_schema(const nlohmann::ordered_json& tasks);

}  // namespace vantage
