#include "vantage/belief/objects/object_states.hpp"

#include <algorithm>
#include <cmath>

#include "vantage/core/error.hpp"

namespace vantage {

int ObjectStates::bin_of_yaw(double yaw_rad) const {
  const auto bin = std::lround(yaw_rad / (2.0 * std::numbers::pi) * bins);
  return static_cast<int>((bin % bins + bins) % bins);
}

int state_seen(const ObjectStates& states, const std::string& object, double seen_yaw_rad) {
  const auto found = std::ranges::find(states.objects, object);
  expects(found != states.objects.end(), "the object is one of the states");
  return states.state(static_cast<int>(found - states.objects.begin()),
                      states.bin_of_yaw(seen_yaw_rad));
}

}  // namespace vantage
