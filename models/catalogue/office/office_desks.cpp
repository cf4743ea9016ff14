#include <algorithm>
#include <array>
#include <cstdint>
#include <numbers>

#include "vantage/core/rng.hpp"
#include "vantage/models/catalogue/office/office_finish.hpp"
#include "vantage/models/catalogue/office/office_furniture.hpp"

namespace vantage::office {
namespace {

using enum Finish;
using Eigen::Vector2d;

constexpr double kTop_m = 0.73;

void add_monitor(TriangleMesh& mesh, double y, double width, double yaw_rad, Finish picture) {
  TriangleMesh screen;
  add_block(screen, {-0.10, -0.12, kTop_m - 0.005}, {0.10, 0.12, kTop_m + 0.012}, dark);
  add_block(screen, {-0.035, -0.03, kTop_m}, {-0.005, 0.03, kTop_m + 0.25}, dark);
  const double bottom = kTop_m + 0.11;
  const double height = 0.58 * width;
  add_block(screen, {-0.01, -width / 2, bottom}, {0.02, width / 2, bottom + height}, dark);
  add_block(screen, {0.015, -width / 2 + 0.015, bottom + 0.02},
            {0.023, width / 2 - 0.015, bottom + height - 0.015}, dark, picture);
  append(mesh, screen, make_pose({-0.17, y, 0.0}, yaw_rad));
}

void add_lamp(TriangleMesh& mesh, double y) {
  const std::array<Vector2d, 4> foot{Vector2d(0, kTop_m - 0.005), Vector2d(0.09, kTop_m - 0.005),
                                     Vector2d(0.08, kTop_m + 0.02), Vector2d(0, kTop_m + 0.02)};
  add_turned(mesh, foot, {-0.22, y}, dark);
  add_rod(mesh, {-0.22, y, kTop_m}, {-0.30, y, kTop_m + 0.28}, 0.010, steel);
  add_rod(mesh, {-0.304, y, kTop_m + 0.277}, {-0.06, y, kTop_m + 0.42}, 0.010, steel);
  const std::array<Vector2d, 4> shade{Vector2d(0, kTop_m + 0.36), Vector2d(0.08, kTop_m + 0.36),
                                      Vector2d(0.04, kTop_m + 0.44), Vector2d(0, kTop_m + 0.44)};
  add_turned(mesh, shade, {-0.05, y}, dark);
}

void add_mug(TriangleMesh& mesh, double x, double y) {
  const std::array<Vector2d, 6> profile{
      Vector2d(0, kTop_m - 0.003),    Vector2d(0.036, kTop_m - 0.003),
      Vector2d(0.042, kTop_m + 0.09), Vector2d(0.038, kTop_m + 0.09),
      Vector2d(0.034, kTop_m + 0.02), Vector2d(0, kTop_m + 0.02)};
  add_turned(mesh, profile, {x, y}, clay);
}

/// Drawers below the top, on the left of who sits there.
void add_pedestal(TriangleMesh& mesh, double half_width, Finish body) {
  const double y0 = half_width - 0.48;
  const double y1 = half_width - 0.06;
  add_block(mesh, {-0.30, y0, 0.03}, {0.33, y1, 0.64}, body);
  for (int i = 0; i < 3; ++i) {
    const double z = 0.05 + 0.195 * i;
    add_block(mesh, {0.32, y0 + 0.01, z}, {0.345, y1 - 0.01, z + 0.18}, body);
    add_block(mesh, {0.34, y0 + 0.13, z + 0.12}, {0.36, y1 - 0.13, z + 0.135}, steel);
  }
}

void add_legs(TriangleMesh& mesh, double half_width, bool panels, Finish body) {
  for (const double side : {-1.0, 1.0}) {
    const double outer = side * (half_width - 0.02);
    const double inner = side * (half_width - 0.05);
    const double low = std::min(outer, inner);
    const double high = std::max(outer, inner);
    if (panels) {
      add_block(mesh, {-0.38, low, 0.0}, {0.36, high, kTop_m - 0.02}, body);
      continue;
    }
    add_block(mesh, {-0.36, low - 0.02, 0.0}, {0.36, high + 0.02, 0.04}, steel);
    add_block(mesh, {-0.06, low, 0.03}, {0.06, high, kTop_m - 0.02}, steel);
  }
  add_block(mesh, {-0.36, -half_width + 0.06, panels ? 0.20 : 0.38},
            {-0.34, half_width - 0.06, kTop_m - 0.02}, body);
}

}  // namespace

TriangleMesh desk(int variant) {
  constexpr std::array<Finish, kVariants> tops{oak, white, walnut, oak};
  constexpr std::array<double, kVariants> widths{1.6, 1.4, 1.8, 1.6};
  const auto v = static_cast<std::size_t>(variant);
  const double half = widths[v] / 2;
  const Finish body = variant == 1 ? grey : tops[v];
  TriangleMesh mesh;
  add_block(mesh, {-0.40, -half, kTop_m - 0.03}, {0.40, half, kTop_m}, tops[v]);
  add_legs(mesh, half, variant != 1, body);
  add_pedestal(mesh, half, variant == 2 ? walnut : grey);
  add_monitor(mesh, variant == 2 ? -0.32 : -0.1, 0.54, variant == 2 ? 0.25 : 0.0,
              variant % 2 == 0 ? spreadsheet : editor);
  if (variant == 2 || variant == 3) {
    add_monitor(mesh, variant == 2 ? 0.30 : 0.5, 0.54, -0.25, editor);
  }
  const double hands = -0.05;
  add_block(mesh, {0.10, hands - 0.22, kTop_m - 0.005}, {0.24, hands + 0.22, kTop_m + 0.02},
            keyboard);
  add_cushion(mesh, {0.14, hands - 0.36, kTop_m - 0.005}, {0.24, hands - 0.30, kTop_m + 0.03},
              dark);
  add_block(mesh, {0.0, half - 0.42, kTop_m - 0.005}, {0.28, half - 0.20, kTop_m + 0.03}, paper);
  add_mug(mesh, -0.02, -half + 0.25);
  if (variant == 0 || variant == 2) add_lamp(mesh, half - 0.22);
  if (variant == 1 || variant == 3) {
    add_block(mesh, {-0.36, -half + 0.04, kTop_m - 0.005}, {-0.14, -half + 0.38, kTop_m + 0.28},
              books, books);
  }
  return mesh;
}

TriangleMesh desk_pair(int variant) {
  const TriangleMesh one = desk(variant < 2 ? 0 : 3);  // both as wide as the screen
  TriangleMesh mesh = partition(2 * (variant % 2));
  append(mesh, one, make_pose({0.44, 0.0, 0.0}, 0.0));
  append(mesh, one, make_pose({-0.44, 0.0, 0.0}, std::numbers::pi));
  return mesh;
}

TriangleMesh meeting_set(int variant) {
  const double half = variant % 2 == 0 ? 1.2 : 0.9;
  const Finish top = variant < 2 ? oak : walnut;
  TriangleMesh mesh;
  add_block(mesh, {-0.55, -half, 0.70}, {0.55, half, 0.74}, top);
  for (const double side : {-1.0, 1.0}) {
    const double y = side * (half - 0.30);
    add_block(mesh, {-0.38, y - 0.03, 0.0}, {0.38, y + 0.03, 0.71}, top);
  }
  add_block(mesh, {-0.02, -half + 0.3, 0.35}, {0.02, half - 0.3, 0.6}, top);
  add_block(mesh, {-0.10, -0.14, 0.735}, {0.10, 0.14, 0.775}, dark);  // conference telephone
  add_block(mesh, {0.22, 0.35, 0.735}, {0.45, 0.52, 0.75}, paper);
  add_block(mesh, {-0.45, -0.6, 0.735}, {-0.20, -0.43, 0.76}, paper);
  Rng rng = Rng::stream(static_cast<std::uint64_t>(variant), "meeting set");
  const int per_side = variant % 2 == 0 ? 3 : 2;
  for (int i = 0; i < per_side; ++i) {
    for (const double side : {1.0, -1.0}) {
      const double y = 0.72 * (i - 0.5 * (per_side - 1)) + rng.uniform(-0.05, 0.05);
      const double yaw = (side > 0 ? std::numbers::pi : 0.0) + rng.uniform(-0.25, 0.25);
      append(mesh, visitor_chair(variant),
             make_pose({side * rng.uniform(0.55, 0.70), y, 0.0}, yaw));
    }
  }
  return mesh;
}

TriangleMesh coffee_table(int variant) {
  const double r = variant % 2 == 0 ? 0.40 : 0.32;
  TriangleMesh mesh;
  const std::array<Vector2d, 4> top{Vector2d(0, 0.42), Vector2d(r, 0.42), Vector2d(r, 0.45),
                                    Vector2d(0, 0.45)};
  add_turned(mesh, top, {0, 0}, variant < 2 ? oak : walnut);
  const std::array<Vector2d, 4> foot{Vector2d(0, 0.0), Vector2d(0.24, 0.0), Vector2d(0.22, 0.03),
                                     Vector2d(0, 0.03)};
  add_turned(mesh, foot, {0, 0}, steel);
  add_rod(mesh, {0, 0, 0.02}, {0, 0, 0.43}, 0.035, steel);
  add_block(mesh, {-0.12, -0.02, 0.445}, {0.12, 0.16, 0.465}, paper);
  return mesh;
}

TriangleMesh partition(int variant) {
  constexpr std::array<Finish, kVariants> cloth{blue_fabric, grey_fabric, green_fabric, red_fabric};
  const double half = variant % 2 == 0 ? 0.8 : 0.7;
  TriangleMesh mesh;
  add_block(mesh, {-0.022, -half + 0.02, 0.12}, {0.022, half - 0.02, 1.48},
            cloth[static_cast<std::size_t>(variant)]);
  add_block(mesh, {-0.028, -half, 0.08}, {0.028, half, 0.14}, steel);
  add_block(mesh, {-0.028, -half, 1.46}, {0.028, half, 1.50}, steel);
  for (const double side : {-1.0, 1.0}) {
    const double y = side * (half - 0.015);
    add_block(mesh, {-0.03, y - 0.018, 0.03}, {0.03, y + 0.018, 1.495}, steel);
    add_block(mesh, {-0.20, y - 0.03, 0.0}, {0.20, y + 0.03, 0.04}, steel);
  }
  return mesh;
}

}  // namespace vantage::office
