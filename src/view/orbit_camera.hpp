/// How a mouse moves a camera that circles a point.
#pragma once

#include "vantage/sim/render/renderer.hpp"

namespace vantage {

/// Drags are in heights of the image, x right, y down. Half a turn per height; never over the
/// top.
FreeCamera orbited(FreeCamera camera, const Eigen::Vector2d& drag);

/// Moves the camera so that what is at the distance of its point follows the mouse.
FreeCamera panned(FreeCamera camera, const Eigen::Vector2d& drag);

/// A tenth nearer per notch of the wheel, for negative ones farther away.
FreeCamera zoomed(FreeCamera camera, double notches);

}  // namespace vantage
