/// What a scenario has made of what was expected on the table. For the scene and for evaluators
/// alone.
#pragma once

#include "vantage/tasks/change_detection/change_detection_task.hpp"

namespace vantage {

/// @throws as draw_expected_object(); ConfigError if there is no other object
ObjectOnTable draw_object(const ChangeDetectionTask& task, std::uint64_t seed);

}  // namespace vantage
