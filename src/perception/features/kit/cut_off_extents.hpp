/// Which extents of an object are whole where something stands in front of it.
#pragma once

#include <vector>

#include "vantage/information/censored_gaussian.hpp"
#include "vantage/perception/features/kit/upright_extents.hpp"
#include "vantage/perception/object_view.hpp"

namespace vantage {

/// Where an object's height begins.
enum class Foot {
  of_object,   ///< at its lowest points: may be hidden
  of_support,  ///< at what it stands on
};

/// What its height and its greater and smaller extent tell: a lower bound where the object is cut
/// off at an end of it, or along much of its edge. Empty if it is cut off nowhere.
/// @param up unit length, camera frame
std::vector<Reading> extent_readings(const ObjectView& view, const UprightExtents& box,
                                     const Eigen::Vector3d& up, Foot foot);

}  // namespace vantage
