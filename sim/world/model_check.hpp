/// What MuJoCo compiles without complaint and must not be simulated.
#pragma once

#include <string>
#include <string_view>

struct mjModel_;
using mjModel = mjModel_;

namespace vantage {

/// @throws InputError, starting with `file`, for a number that is not finite (positions, masses,
/// sizes, ranges, gains, meshes) or a time step outside (0, 0.1] s.
void check_model(const mjModel& model, const std::string& file);

/// @throws InputError, starting with `file`, if an object of the model is called `robot/...`.
void check_no_robot_names(const mjModel& model, const std::string& file);

/// @throws InputError, starting with `file`, if a robot's MJCF refers to another file: beside a
/// scene it would be looked for in the scene's folder.
void check_no_files(std::string_view mjcf, const std::string& file);

/// Makes sure that a scene means the same beside a robot as alone: `both` must begin with the
/// bodies, joints and geoms of `scene`, unchanged but for rounding.
/// @throws InputError, starting with `file`, naming what would change.
void check_same_scene(const mjModel& scene, const mjModel& both, const std::string& file);

}  // namespace vantage
