#include "vantage/models/catalogue/flight/wall_looks.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

namespace vantage {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// x runs along the wall to the right as one faces it, y into it.
struct Wall {
  std::string_view name;
  Vector2d middle_m;
  double yaw_rad = 0.0;
  double half_length_m = 1.0;
};

/// Part of a wall that is taken, from the floor up.
struct Taken {
  double from_m = 0.0;
  double to_m = 0.0;
  double height_m = 0.0;
};

enum class Item { window, door, picture };

struct Wanted {
  Item item;
  double share;  ///< of the half length, where its middle belongs
};

double width_m(Item item) {
  switch (item) {
    case Item::window: return 1.9;
    case Item::door: return 1.1;
    case Item::picture: return 0.9;
  }
  return 0.0;
}

double bottom_m(Item item) { return item == Item::door ? 0.0 : item == Item::window ? 0.85 : 1.2; }

std::vector<Taken> obstacles_before(const Wall& wall, const FlightScene& scene) {
  constexpr double kBefore_m = 0.7;
  std::vector<Taken> taken;
  for (const FlightObstacle& obstacle : scene.obstacles) {
    const Vector2d p =
        Eigen::Rotation2Dd(-wall.yaw_rad) * Vector2d(obstacle.p_world_m - wall.middle_m);
    const double reach_m = 0.5 * obstacle.size_m.head<2>().maxCoeff();
    if (p.y() + reach_m < -kBefore_m) continue;
    taken.push_back({p.x() - reach_m, p.x() + reach_m, obstacle.size_m.z()});
  }
  return taken;
}

/// Where the item fits, as near as may be to where it is wanted.
std::optional<double> place_of(const Wanted& wanted, const Wall& wall,
                               const std::vector<Taken>& taken) {
  constexpr double kApart_m = 0.12;
  const double half_m = 0.5 * width_m(wanted.item) + kApart_m;
  for (const double aside_m : {0.0, 0.3, -0.3, 0.7, -0.7, 1.2, -1.2}) {
    const double x = wanted.share * wall.half_length_m + aside_m;
    const bool fits = std::abs(x) + half_m < wall.half_length_m &&
                      std::ranges::none_of(taken, [&](const Taken& other) {
                        return other.height_m > bottom_m(wanted.item) &&
                               other.from_m < x + half_m && other.to_m > x - half_m;
                      });
    if (fits) return x;
  }
  return std::nullopt;
}

std::string window(double x) {
  constexpr double kMiddle_m = 1.5;
  std::string text = look_panel({x, 0, kMiddle_m}, 0.88, 0.66, 0.004, "look_trim");
  for (const double side : {-1.0, 1.0}) {
    const double pane = x + side * 0.405;
    text += look_panel({pane, 0, kMiddle_m + 0.14}, 0.375, 0.44, 0.0045, "look_glass");
    text += look_panel({pane, 0, kMiddle_m - 0.44}, 0.375, 0.14, 0.0045, "look_garden");
    text += look_panel({pane, 0, kMiddle_m + 0.24}, 0.375, 0.012, 0.005, "look_trim");
  }
  text += look_panel({x, 0, 0.82}, 0.94, 0.022, 0.005, "look_trim");
  text += look_panel({x, 0, 0.42}, 0.62, 0.26, 0.003, "look_white");  // a radiator
  for (int rib = -7; rib <= 7; ++rib) {
    text += look_panel({x + 0.08 * rib, 0, 0.42}, 0.012, 0.24, 0.0045, "look_plaster");
  }
  return text;
}

std::string door(double x) {
  std::string text = look_panel({x, 0, 1.06}, 0.53, 1.06, 0.003, "look_trim");
  text += look_panel({x, 0, 1.02}, 0.45, 1.015, 0.004, "look_leaf");
  for (const double z : {0.56, 1.48}) {
    text += look_panel({x, 0, z}, 0.31, 0.38, 0.0045, "look_leaf_panel");
    text += look_panel({x, 0, z}, 0.27, 0.34, 0.005, "look_leaf");
  }
  text += look_panel({x + 0.38, 0, 1.03}, 0.022, 0.09, 0.005, "look_metal");
  return text + look_panel({x + 0.335, 0, 1.06}, 0.065, 0.011, 0.005, "look_metal");
}

std::string picture(double x, int number) {
  constexpr std::array<std::string_view, 3> kPaint{"look_paint_a", "look_paint_b", "look_paint_c"};
  const auto paint = [&](int i) { return kPaint[static_cast<std::size_t>((number + i) % 3)]; };
  constexpr double kMiddle_m = 1.6;
  return look_panel({x, 0, kMiddle_m}, 0.42, 0.32, 0.0035, "look_dark") +
         look_panel({x, 0, kMiddle_m}, 0.395, 0.295, 0.004, "look_trim") +
         look_panel({x, 0, kMiddle_m}, 0.32, 0.22, 0.0043, paint(0)) +
         look_panel({x, 0, kMiddle_m - 0.12}, 0.32, 0.10, 0.0046, paint(1)) +
         look_panel({x + 0.12, 0, kMiddle_m + 0.06}, 0.06, 0.06, 0.005, paint(2));
}

std::string item_at(Item item, double x, int number) {
  switch (item) {
    case Item::window: return window(x);
    case Item::door: return door(x);
    case Item::picture: return picture(x, number);
  }
  return {};
}

std::string items_on(const Wall& wall, const std::vector<Wanted>& wanted,
                     const FlightScene& scene) {
  std::vector<Taken> taken = obstacles_before(wall, scene);
  std::string text = look_panel({0, 0, 1.25}, wall.half_length_m, 1.25, 0.001, "look_plaster") +
                     look_panel({0, 0, 0.045}, wall.half_length_m, 0.045, 0.0028, "look_trim") +
                     look_panel({0, 0, 2.46}, wall.half_length_m, 0.03, 0.0028, "look_trim");
  int number = static_cast<int>(wall.name.size());
  for (const Wanted& item : wanted) {
    const auto x = place_of(item, wall, taken);
    if (!x) continue;
    taken.push_back({*x - 0.5 * width_m(item.item), *x + 0.5 * width_m(item.item), 10.0});
    text += item_at(item.item, *x, number++);
  }
  return look_body(fmt::format("wall_{}", wall.name), wall.middle_m, wall.yaw_rad, text);
}

}  // namespace

std::string look_box(const Vector3d& middle_m, const Vector3d& half_m, std::string_view material) {
  return fmt::format(
      "        <geom class=\"looks\" type=\"box\" pos=\"{:.5g} {:.5g} {:.5g}\" size=\"{:.5g} "
      "{:.5g} "
      "{:.5g}\" material=\"{}\"/>\n",
      middle_m.x(), middle_m.y(), middle_m.z(), half_m.x(), half_m.y(), half_m.z(), material);
}

std::string look_panel(const Vector3d& middle_m, double half_width_m, double half_height_m,
                       double proud_m, std::string_view material) {
  constexpr double kSunk_m = 0.01;
  const Vector3d at_m = middle_m + Vector3d(0.0, 0.5 * (kSunk_m - proud_m), 0.0);
  return look_box(at_m, {half_width_m, 0.5 * (kSunk_m + proud_m), half_height_m}, material);
}

std::string look_body(const std::string& name, const Vector2d& p_world_m, double yaw_rad,
                      const std::string& geoms) {
  return fmt::format(
      "      <body name=\"looks/{}\" pos=\"{:.5g} {:.5g} 0\" euler=\"0 0 {:.5g}\">\n{}      "
      "</body>\n",
      name, p_world_m.x(), p_world_m.y(), yaw_rad, geoms);
}

std::string wall_looks(const FlightScene& scene) {
  constexpr double kQuarter_rad = 0.5 * std::numbers::pi;
  const Vector2d half = 0.5 * scene.room_m;
  const Wall north{"north", {0.0, half.y()}, 0.0, half.x()};
  const Wall west{"west", {-half.x(), 0.0}, kQuarter_rad, half.y()};
  const Wall south{"south", {0.0, -half.y()}, 2.0 * kQuarter_rad, half.x()};
  const Wall east{"east", {half.x(), 0.0}, -kQuarter_rad, half.y()};
  return items_on(north, {{Item::window, -0.5}, {Item::window, 0.5}, {Item::picture, 0.0}}, scene) +
         items_on(west, {{Item::door, -0.62}, {Item::window, 0.45}, {Item::picture, -0.1}}, scene) +
         items_on(south, {{Item::window, -0.5}, {Item::picture, 0.1}, {Item::picture, 0.5}},
                  scene) +
         items_on(east, {{Item::window, -0.45}, {Item::picture, 0.1}, {Item::picture, 0.5}}, scene);
}

}  // namespace vantage
