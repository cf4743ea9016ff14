#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "vantage/models/catalogue/office/office_finish.hpp"
#include "vantage/models/catalogue/office/office_furniture.hpp"

namespace vantage::office {
namespace {

using enum Finish;
using Eigen::Vector3d;

constexpr std::array<Finish, kVariants> kCloth{dark, blue_fabric, grey_fabric, red_fabric};

void add_star_base(TriangleMesh& mesh) {
  for (int i = 0; i < 5; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 5.0;
    const Vector3d tip(0.30 * std::cos(angle), 0.30 * std::sin(angle), 0.05);
    add_rod(mesh, {0.05 * tip.x(), 0.05 * tip.y(), 0.11}, tip, 0.022, dark);
    const Vector3d across(-0.02 * std::sin(angle), 0.02 * std::cos(angle), 0.0);
    const Vector3d hub(tip.x(), tip.y(), 0.03);
    add_rod(mesh, hub - across, hub + across, 0.03, dark);
  }
}

}  // namespace

TriangleMesh office_chair(int variant) {
  const Finish cloth = kCloth[static_cast<std::size_t>(variant)];
  const double back = variant % 2 == 0 ? 1.08 : 0.95;
  TriangleMesh mesh;
  add_star_base(mesh);
  add_rod(mesh, {0, 0, 0.08}, {0, 0, 0.24}, 0.035, dark);
  add_rod(mesh, {0, 0, 0.22}, {0, 0, 0.44}, 0.022, steel);
  add_cushion(mesh, {-0.23, -0.24, 0.42}, {0.25, 0.24, 0.50}, cloth);
  add_rod(mesh, {-0.15, 0, 0.44}, {-0.28, 0, 0.46}, 0.02, dark);
  add_rod(mesh, {-0.27, 0, 0.45}, {-0.27, 0, 0.75}, 0.02, dark);
  const Pose reclined = make_pose({-0.24, 0, 0.56}, 0.0, -0.14);
  add_cushion(mesh, {-0.035, -0.22, 0.0}, {0.035, 0.22, back - 0.56}, cloth, reclined);
  if (variant < 3) {
    for (const double side : {-1.0, 1.0}) {
      add_rod(mesh, {-0.02, side * 0.22, 0.45}, {-0.02, side * 0.28, 0.66}, 0.015, dark);
      add_cushion(mesh, {-0.14, side * 0.28 - 0.035, 0.65}, {0.12, side * 0.28 + 0.035, 0.69},
                  dark);
    }
  }
  return mesh;
}

TriangleMesh visitor_chair(int variant) {
  constexpr std::array<Finish, kVariants> cloths{grey_fabric, oak, blue_fabric, green_fabric};
  const Finish cloth = cloths[static_cast<std::size_t>(variant)];
  TriangleMesh mesh;
  for (const double y : {-0.21, 0.21}) {
    add_rod(mesh, {0.20, y, 0.0}, {0.20, y, 0.44}, 0.014, steel);
    add_rod(mesh, {-0.24, y, 0.0}, {-0.19, y, 0.44}, 0.014, steel);
    add_rod(mesh, {-0.19, y, 0.43}, {-0.24, y, 0.84}, 0.014, steel);
    add_rod(mesh, {-0.20, y, 0.42}, {0.21, y, 0.42}, 0.014, steel);
  }
  add_cushion(mesh, {-0.20, -0.23, 0.42}, {0.22, 0.23, 0.47}, cloth);
  add_cushion(mesh, {-0.02, -0.22, 0.0}, {0.02, 0.22, 0.28}, cloth,
              make_pose({-0.205, 0, 0.58}, 0.0, -0.12));
  return mesh;
}

TriangleMesh sofa(double width_m, int seats, int variant) {
  constexpr std::array<Finish, kVariants> cloths{grey_fabric, green_fabric, blue_fabric,
                                                 red_fabric};
  const Finish cloth = cloths[static_cast<std::size_t>(variant)];
  const double half = width_m / 2;
  const double arm = 0.14;
  TriangleMesh mesh;
  add_block(mesh, {-0.40, -half + 0.02, 0.08}, {0.38, half - 0.02, 0.30}, cloth);
  add_cushion(mesh, {-0.42, -half + 0.05, 0.10}, {-0.22, half - 0.05, 0.82}, cloth);
  const double seat = (width_m - 2 * arm) / seats;
  for (int i = 0; i < seats; ++i) {
    const double y = -half + arm + seat * i;
    add_cushion(mesh, {-0.26, y + 0.004, 0.28}, {0.42, y + seat - 0.004, 0.45}, cloth);
    add_cushion(mesh, {-0.26, y + 0.01, 0.44}, {-0.10, y + seat - 0.01, 0.78}, cloth);
  }
  for (const double side : {-1.0, 1.0}) {
    const double y = side * (half - arm / 2);
    add_cushion(mesh, {-0.42, y - arm / 2, 0.07}, {0.40, y + arm / 2, 0.60}, cloth);
    for (const double x : {-0.36, 0.34}) {
      add_rod(mesh, {x, y, 0.0}, {x, y, 0.12}, 0.022, walnut);
    }
  }
  return mesh;
}

}  // namespace vantage::office
