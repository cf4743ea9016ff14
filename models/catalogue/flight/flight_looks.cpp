#include "vantage/models/catalogue/flight/flight_looks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "vantage/models/catalogue/flight/wall_looks.hpp"

namespace vantage {
namespace {

using Eigen::Vector3d;

constexpr std::array<std::string_view, 3> kCabinets{"look_oak", "look_white", "look_walnut"};

/// A box that covers a solid one, a little proud of it on all sides but below.
std::string cover(const Vector3d& middle_m, const Vector3d& half_m, std::string_view material) {
  constexpr double kProud_m = 0.001;
  return look_box(middle_m, half_m + Vector3d(kProud_m, kProud_m, 0.5 * kProud_m), material);
}

std::string disc(double z_m, double radius_m, double half_m, std::string_view material) {
  return fmt::format(
      "        <geom class=\"looks\" type=\"cylinder\" pos=\"0 0 {:.5g}\" size=\"{:.5g} {:.5g}\" "
      "material=\"{}\"/>\n",
      z_m, radius_m, half_m, material);
}

/// Panels side by side or above each other on the front (-y) of a box, each with a handle.
struct Fronts {
  double half_width_m = 0.2;
  double front_m = 0.2;  ///< the solid's front is at y = -front_m
  double bottom_m = 0.1;
  double top_m = 0.7;
  int columns = 1;
  int rows = 1;
};

std::string fronts(const Fronts& f, std::string_view material, bool handles_aside) {
  constexpr double kGap_m = 0.008;
  const double width = 2.0 * f.half_width_m / f.columns;
  const double height = (f.top_m - f.bottom_m) / f.rows;
  std::string text;
  for (int column = 0; column < f.columns; ++column) {
    for (int row = 0; row < f.rows; ++row) {
      const double x = -f.half_width_m + (column + 0.5) * width;
      const double z = f.bottom_m + (row + 0.5) * height;
      text += look_panel({x, -f.front_m, z}, 0.5 * width - kGap_m, 0.5 * height - kGap_m, 0.003,
                         material);
      const double aside =
          handles_aside ? (column % 2 == 0 ? 1.0 : -1.0) * (0.5 * width - 0.05) : 0;
      const double handle_half = handles_aside ? 0.012 : std::min(0.07, 0.3 * width);
      text += look_panel({x + aside, -f.front_m, handles_aside ? z : z + 0.22 * height},
                         handle_half, handles_aside ? 0.07 : 0.011, kLooksProud_m, "look_metal");
    }
  }
  return text;
}

std::string chest_of_drawers(const FlightSupport& support, std::string_view wood) {
  constexpr double kHalf_m = kPedestalHalf_m - 0.02;
  constexpr double kHalfTop_m = 0.02;
  constexpr double kPlinth_m = 0.07;
  const double below_m = support.top_m - 2.0 * kHalfTop_m;
  const double half_m = 0.5 * (below_m - kPlinth_m);
  std::string text =
      cover({0, 0, 0.5 * kPlinth_m}, {kHalf_m, kHalf_m, 0.5 * kPlinth_m}, "look_dark");
  text += cover({0, 0, kPlinth_m + half_m}, {kHalf_m, kHalf_m, half_m}, wood);
  text += cover({0, 0, support.top_m - kHalfTop_m}, {kPedestalHalf_m, kPedestalHalf_m, kHalfTop_m},
                wood == kCabinets[1] ? "look_oak" : wood);
  const std::string_view front = wood == kCabinets[0] ? "look_oak_light" : wood;
  text += look_panel({0, -kHalf_m, kPlinth_m + half_m}, kHalf_m - 0.012, half_m - 0.012, 0.002,
                     "look_gap");
  text +=
      fronts({kHalf_m - 0.015, kHalf_m, kPlinth_m + 0.015, below_m - 0.015, 1, 3}, front, false);
  return text;
}

std::string bistro_table(const FlightSupport& support) {
  constexpr double kHalfTop_m = 0.02;
  const double below_m = support.top_m - 2.0 * kHalfTop_m;
  return disc(support.top_m - kHalfTop_m, kRoundTableRadius_m + 0.001, kHalfTop_m - 0.002,
              "look_walnut") +
         disc(support.top_m - 0.004, kRoundTableRadius_m - 0.012, 0.0045, "look_oak_light") +
         disc(0.5 * below_m, 0.036, 0.5 * below_m, "look_metal") +
         disc(0.01, 0.201, 0.0105, "look_metal");
}

std::string column(const FlightObstacle& obstacle) {
  const double radius_m = 0.5 * obstacle.size_m.x();
  std::string text = disc(0.06, radius_m + kLooksProud_m, 0.06, "look_trim");
  text += disc(obstacle.size_m.z() - 0.04, radius_m + kLooksProud_m, 0.0405, "look_trim");
  for (const double z_m : {0.135, 0.3, 2.2})
    text += disc(z_m, radius_m + 0.003, 0.012, "look_trim");
  return text;
}

/// A cupboard or a sideboard: doors on the long side that looks into the room.
std::string doors_of(const FlightObstacle& obstacle, bool along_y) {
  const Vector3d half = 0.5 * obstacle.size_m;
  const double width_m = along_y ? obstacle.size_m.y() : obstacle.size_m.x();
  const double depth_m = along_y ? obstacle.size_m.x() : obstacle.size_m.y();
  const int columns = std::max(2, static_cast<int>(std::lround(width_m / 0.45)));
  const double top_m = obstacle.size_m.z() - 0.04;
  const double front_m = 0.5 * depth_m;
  const Fronts panels{0.5 * width_m - 0.015, front_m, 0.095, top_m - 0.01, columns, 1};
  return cover({0, 0, half.z()}, {0.5 * width_m, front_m, half.z()}, "look_walnut") +
         look_panel({0, -front_m, 0.04}, 0.5 * width_m, 0.04, 0.003, "look_dark") +
         look_panel({0, -front_m, 0.5 * (0.085 + top_m)}, 0.5 * width_m - 0.008,
                    0.5 * (top_m - 0.085), 0.002, "look_gap") +
         fronts(panels, "look_oak", true);
}

std::string obstacle_looks(const FlightObstacle& obstacle, const std::string& name) {
  if (obstacle.kind == "column") {
    return look_body(name, obstacle.p_world_m, obstacle.yaw_rad, column(obstacle));
  }
  const bool along_y = obstacle.size_m.y() > obstacle.size_m.x();
  const double inward = along_y ? obstacle.p_world_m.x() : obstacle.p_world_m.y();
  double yaw_rad = along_y ? -0.5 * std::numbers::pi : 0.0;  // the front at -y looks to -x, to -y
  if (inward < 0.0) yaw_rad += std::numbers::pi;
  return look_body(name, obstacle.p_world_m, obstacle.yaw_rad + yaw_rad,
                   doors_of(obstacle, along_y));
}

std::string floor_looks(const Eigen::Vector2d& room_m) {
  std::string text = fmt::format(
      "        <geom class=\"looks\" type=\"plane\" pos=\"0 0 0.0006\" size=\"{:.5g} {:.5g} "
      "0.1\" material=\"look_boards\"/>\n",
      0.5 * room_m.x(), 0.5 * room_m.y());
  // A rug: layers far enough apart for the depth of a picture from across the room.
  const std::array<double, 4> inset_m{0.0, 0.12, 0.30, 0.34};
  for (std::size_t i = 0; i < inset_m.size(); ++i) {
    const Eigen::Vector2d half_m = 0.24 * room_m - Eigen::Vector2d::Constant(inset_m[i]);
    const double half_thick_m = 0.5 * (0.0018 + 0.00105 * static_cast<double>(i));
    text += look_box({0, 0, half_thick_m}, {half_m.x(), half_m.y(), half_thick_m},
                     i % 2 == 0 ? "look_rug_edge" : "look_rug");
  }
  return text;
}

}  // namespace

std::string looks_class() {
  return "  <default>\n    <default class=\"looks\">\n      <geom contype=\"0\" conaffinity=\"0\" "
         "group=\"5\"/>\n    </default>\n  </default>\n";
}

std::string looks_assets() {
  struct Colour {
    std::string_view name, rgb, more;
  };
  constexpr std::array<Colour, 18> kColours{{
      {"look_oak", "0.72 0.56 0.38", ""},
      {"look_oak_light", "0.80 0.65 0.46", ""},
      {"look_walnut", "0.46 0.32 0.22", ""},
      {"look_white", "0.88 0.87 0.84", ""},
      {"look_dark", "0.16 0.15 0.15", ""},
      {"look_gap", "0.22 0.17 0.13", ""},
      {"look_metal", "0.34 0.35 0.37", ""},
      {"look_trim", "0.93 0.92 0.89", ""},
      {"look_plaster", "0.87 0.85 0.79", ""},
      {"look_glass", "0.66 0.80 0.92", " emission=\"0.35\""},
      {"look_garden", "0.50 0.62 0.42", " emission=\"0.25\""},
      {"look_leaf", "0.62 0.44 0.29", ""},
      {"look_leaf_panel", "0.55 0.38 0.25", ""},
      {"look_rug", "0.20 0.35 0.42", ""},
      {"look_rug_edge", "0.78 0.70 0.55", ""},
      {"look_paint_a", "0.80 0.36 0.22", ""},
      {"look_paint_b", "0.18 0.36 0.52", ""},
      {"look_paint_c", "0.90 0.74 0.34", ""},
  }};
  std::string text =
      "    <texture name=\"look_boards\" type=\"2d\" builtin=\"checker\" rgb1=\"0.64 0.50 0.36\" "
      "rgb2=\"0.58 0.44 0.31\" mark=\"edge\" markrgb=\"0.42 0.31 0.21\" width=\"256\" "
      "height=\"256\"/>\n"
      "    <material name=\"look_boards\" texture=\"look_boards\" texrepeat=\"1 8\" "
      "texuniform=\"true\" specular=\"0.05\"/>\n";
  for (const Colour& colour : kColours) {
    text += fmt::format("    <material name=\"{}\" rgba=\"{} 1\" specular=\"0.05\"{}/>\n",
                        colour.name, colour.rgb, colour.more);
  }
  return text;
}

std::string looks_bodies(const FlightScene& scene) {
  std::string text = "    <body name=\"looks\">\n";
  text += look_body("floor", Eigen::Vector2d::Zero(), 0.0, floor_looks(scene.room_m));
  text += wall_looks(scene);
  for (std::size_t i = 0; i < scene.support_surfaces.size(); ++i) {
    const FlightSupport& support = scene.support_surfaces[i];
    text += look_body(
        fmt::format("stand_{}", i), support.p_world_m, support.yaw_rad,
        support.round ? bistro_table(support) : chest_of_drawers(support, kCabinets[i % 3]));
  }
  for (std::size_t i = 0; i < scene.obstacles.size(); ++i) {
    text += obstacle_looks(scene.obstacles[i], fmt::format("obstacle_{}", i));
  }
  return text + "    </body>\n";
}

}  // namespace vantage
