/// Names and ids of what a compiled model holds.
#pragma once

#include <optional>
#include <string>
#include <vector>

struct mjModel_;
using mjModel = mjModel_;

namespace vantage {

enum class ModelObject { body, joint, geom, site, camera, actuator };

/// @throws InputError naming the kind of object and the name if the model has none.
int model_id(const mjModel& model, ModelObject kind, const std::string& name);
std::optional<int> find_model_id(const mjModel& model, ModelObject kind, const std::string& name);
/// Empty for objects without a name.
std::string model_name(const mjModel& model, ModelObject kind, int id);

/// Of all objects of that kind that have a name, in the model's order.
std::vector<std::string> model_names(const mjModel& model, ModelObject kind);

}  // namespace vantage
