/// Pictures without light.
#pragma once

#include <string>

#include "vantage/perception/object_view.hpp"

namespace vantage {

/// Why nothing can be told by colour or brightness: object and surroundings are black; empty if
/// they are not.
std::string lacks_light(const ObjectView& view);

}  // namespace vantage
