/// From where people look at a whole scene.
#pragma once

#include "vantage/sim/render/renderer.hpp"

namespace vantage {

/// The scene's own camera "overview"; without one, obliquely from above at all that stands still.
/// Wherever that is, a request `for_people` leaves out the walls and the ceiling before it.
CameraView overview_camera(const mjModel& model);

}  // namespace vantage
