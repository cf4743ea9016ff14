#include "vantage/tasks/recognition/table_obstacles.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace vantage {

Screen screen_round(const Outline& object, double spacing_m, double height_m) {
  constexpr double kRoom_m = 0.03;  // for errors of where the robot is told that it stands
  double reach_m = 0.0;
  for (const Eigen::Vector2d& p : object) reach_m = std::max(reach_m, p.norm());
  return {.half_m = reach_m + kRoom_m + spacing_m, .height_m = height_m};
}

Outline outline_of(const Screen& screen) {
  const double out_m = screen.half_m + Screen::kWall_m;
  return placed({{-out_m, -out_m}, {out_m, -out_m}, {out_m, out_m}, {-out_m, out_m}},
                screen.yaw_rad, screen.offset_m);
}

std::string mjcf_of(const Post& post, const std::string& name,
                    const Eigen::Vector3d& p_world_table_m) {
  return fmt::format(
      R"(    <body name="{0}" pos="{1} {2} {3}">
      <geom name="{0}" type="cylinder" pos="0 0 {4}" size="{5} {4}" rgba="0.25 0.26 0.3 1"/>
    </body>
)",
      name, p_world_table_m.x() + post.offset_m.x(), p_world_table_m.y() + post.offset_m.y(),
      p_world_table_m.z(), 0.5 * post.height_m, post.radius_m);
}

std::string mjcf_of(const Screen& screen, const std::string& name,
                    const Eigen::Vector3d& p_world_table_m) {
  const double wall_m = 0.5 * Screen::kWall_m;
  const double at_m = screen.half_m + wall_m;
  const double up_m = 0.5 * screen.height_m;
  const auto wall = [&](const char* which, double x_m, double y_m, double half_x_m,
                        double half_y_m) {
    return fmt::format(
        R"(      <geom name="{}_{}" type="box" pos="{} {} {}" size="{} {} {}" rgba="0.72 0.6 0.45 1"/>
)",
        name, which, x_m, y_m, up_m, half_x_m, half_y_m, up_m);
  };
  return fmt::format(R"(    <body name="{}" pos="{} {} {}" euler="0 0 {}">
)",
                     name, p_world_table_m.x() + screen.offset_m.x(),
                     p_world_table_m.y() + screen.offset_m.y(), p_world_table_m.z(),
                     screen.yaw_rad) +
         wall("back", -at_m, 0.0, wall_m, screen.half_m + Screen::kWall_m) +
         wall("left", 0.0, at_m, screen.half_m, wall_m) +
         wall("right", 0.0, -at_m, screen.half_m, wall_m) + "    </body>\n";
}

}  // namespace vantage
