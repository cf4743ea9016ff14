#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "vantage/core/rng.hpp"
#include "vantage/models/catalogue/office/office_finish.hpp"
#include "vantage/models/catalogue/office/office_furniture.hpp"

namespace vantage::office {
namespace {

using enum Finish;
using Eigen::Vector2d;

void add_carton(TriangleMesh& mesh, const Eigen::Vector3d& size_m, const Eigen::Vector3d& foot_m,
                double yaw_rad) {
  TriangleMesh carton;
  add_block(carton, {-size_m.x() / 2, -size_m.y() / 2, 0.0},
            {size_m.x() / 2, size_m.y() / 2, size_m.z()}, cardboard);
  append(mesh, carton, make_pose(foot_m, yaw_rad));
}

/// What stands in one bay of a shelf, on a board at `z`.
void fill_bay(TriangleMesh& mesh, double half, double z, double room, Rng& rng) {
  const double left = -half + rng.uniform(0.0, 0.08);
  const std::size_t kind = rng.uniform_index(4);
  if (kind == 3) {
    add_carton(mesh, {0.24, 0.34, 0.22}, {0.02, left + 0.2, z - 0.002}, rng.uniform(-0.1, 0.1));
    return;
  }
  const double right = left + (2 * half - 0.1) * rng.uniform(0.55, 1.0);
  const double top = z + room * rng.uniform(0.68, 0.85);
  add_block(mesh, {-0.14, left, z - 0.002}, {0.10, right, top}, kind == 0 ? binders : books);
}

}  // namespace

TriangleMesh shelf(int variant) {
  constexpr std::array<Finish, kVariants> woods{oak, white, walnut, grey};
  const Finish wood = woods[static_cast<std::size_t>(variant)];
  const double half = variant % 2 == 0 ? 0.45 : 0.50;
  Rng rng = Rng::stream(static_cast<std::uint64_t>(variant), "shelf");
  TriangleMesh mesh;
  add_block(mesh, {-0.175, -half, 0.0}, {-0.16, half, 1.80}, wood);
  for (const double side : {-1.0, 1.0}) {
    const double y = side * (half - 0.011);
    add_block(mesh, {-0.17, y - 0.011, 0.0}, {0.175, y + 0.011, 1.80}, wood);
  }
  constexpr int kBays = 5;
  constexpr double kPitch_m = 0.34;
  for (int i = 0; i <= kBays; ++i) {
    const double z = 0.08 + kPitch_m * i;
    add_block(mesh, {-0.17, -half + 0.01, z - 0.02}, {0.165, half - 0.01, z}, wood);
    if (i < kBays) fill_bay(mesh, half - 0.03, z, kPitch_m - 0.02, rng);
  }
  return mesh;
}

TriangleMesh sideboard(int variant) {
  const double half = variant % 2 == 0 ? 0.60 : 0.80;
  const Finish body = variant < 2 ? white : oak;
  const int doors = variant % 2 == 0 ? 2 : 3;
  TriangleMesh mesh;
  add_block(mesh, {-0.22, -half, 0.05}, {0.20, half, 0.76}, body);
  add_block(mesh, {-0.20, -half + 0.03, 0.0}, {0.17, half - 0.03, 0.06}, dark);
  add_block(mesh, {-0.225, -half - 0.005, 0.755}, {0.225, half + 0.005, 0.78}, oak);
  for (int i = 0; i < doors; ++i) {
    const double y = -half + 2 * half * i / doors;
    const double y1 = -half + 2 * half * (i + 1) / doors;
    add_block(mesh, {0.195, y + 0.006, 0.07}, {0.218, y1 - 0.006, 0.745}, body);
    add_block(mesh, {0.215, y1 - 0.07, 0.40}, {0.235, y1 - 0.055, 0.54}, steel);
  }
  if (variant != 1) {
    add_block(mesh, {-0.15, -half + 0.10, 0.775}, {0.08, -half + 0.48, 1.03}, binders);
  }
  if (variant % 2 == 1) add_carton(mesh, {0.30, 0.40, 0.26}, {0.0, half - 0.34, 0.778}, 0.12);
  return mesh;
}

TriangleMesh filing_cabinet(int variant) {
  const int drawers = variant % 2 == 0 ? 4 : 3;
  const double height = 0.06 + 0.32 * drawers;
  const Finish body = variant < 2 ? grey : steel;
  TriangleMesh mesh;
  add_block(mesh, {-0.31, -0.24, 0.0}, {0.29, 0.24, height}, body);
  for (int i = 0; i < drawers; ++i) {
    const double z = 0.05 + 0.32 * i;
    add_block(mesh, {0.285, -0.225, z}, {0.31, 0.225, z + 0.30}, body);
    add_block(mesh, {0.305, -0.07, z + 0.21}, {0.33, 0.07, z + 0.225}, dark);
    add_block(mesh, {0.305, -0.05, z + 0.245}, {0.313, 0.05, z + 0.28}, paper);
  }
  if (variant == 1) add_carton(mesh, {0.40, 0.34, 0.25}, {-0.04, 0.0, height - 0.002}, 0.1);
  return mesh;
}

TriangleMesh copier(int variant) {
  TriangleMesh mesh;
  add_block(mesh, {-0.32, -0.30, 0.04}, {0.30, 0.30, 0.62}, white);
  add_block(mesh, {-0.30, -0.28, 0.0}, {0.28, 0.28, 0.05}, dark);
  for (int i = 0; i < 3; ++i) {
    const double z = 0.07 + 0.18 * i;
    add_block(mesh, {0.295, -0.28, z}, {0.315, 0.28, z + 0.165}, grey);
    add_block(mesh, {0.312, -0.10, z + 0.11}, {0.325, 0.10, z + 0.13}, dark);
  }
  add_block(mesh, {-0.32, -0.30, 0.60}, {0.02, 0.30, 0.80}, grey);
  add_block(mesh, {-0.32, -0.30, 0.78}, {0.30, 0.30, 1.00}, white);
  add_cushion(mesh, {-0.33, -0.31, 0.99}, {0.22, 0.31, variant % 2 == 0 ? 1.06 : 1.12}, dark);
  add_block(mesh, {0.22, -0.29, 0.98}, {0.31, 0.05, 1.02}, dark, spreadsheet);
  return mesh;
}

TriangleMesh boxes(int variant) {
  TriangleMesh mesh;
  switch (variant) {
    case 0: add_carton(mesh, {0.40, 0.55, 0.38}, {0, 0, 0}, 0.0); break;
    case 1:
      add_carton(mesh, {0.45, 0.60, 0.40}, {0, 0, 0}, 0.0);
      add_carton(mesh, {0.38, 0.50, 0.32}, {0.01, 0.02, 0.398}, 0.25);
      break;
    case 2:
      add_carton(mesh, {0.42, 0.42, 0.42}, {0, -0.24, 0}, 0.1);
      add_carton(mesh, {0.36, 0.46, 0.30}, {0.02, 0.27, 0}, -0.2);
      break;
    default:
      add_carton(mesh, {0.50, 0.60, 0.45}, {0, 0, 0}, 0.0);
      add_carton(mesh, {0.45, 0.55, 0.40}, {0, 0.01, 0.448}, -0.1);
      add_carton(mesh, {0.35, 0.42, 0.30}, {-0.02, -0.02, 0.846}, 0.3);
  }
  return mesh;
}

TriangleMesh plant(int variant) {
  Rng rng = Rng::stream(static_cast<std::uint64_t>(variant), "plant");
  const double height = 0.32 + 0.05 * variant;
  TriangleMesh mesh;
  const std::array<Vector2d, 6> pot{Vector2d(0, 0),
                                    Vector2d(0.13, 0),
                                    Vector2d(0.18, height),
                                    Vector2d(0.165, height),
                                    Vector2d(0.16, height - 0.05),
                                    Vector2d(0, height - 0.04)};
  add_turned(mesh, pot, {0, 0}, variant % 2 == 0 ? clay : white);
  add_rod(mesh, {0, 0, height - 0.06}, {0.01, 0.01, height + 0.45}, 0.018, walnut);
  const int leaves = 16 + 2 * variant;
  for (int i = 0; i < leaves; ++i) {
    const double share = static_cast<double>(i) / leaves;
    const double z = height + 0.02 + 0.42 * share;
    const double length = (0.62 - 0.12 * share) * rng.uniform(0.8, 1.0);
    const double width = rng.uniform(0.07, 0.11);
    add_leaf(mesh, {0, 0, z}, 2.4 * i + rng.uniform(-0.3, 0.3), length, width);
  }
  return mesh;
}

TriangleMesh waste_bin(int variant) {
  const double r = variant % 2 == 0 ? 0.14 : 0.17;
  const double height = variant % 2 == 0 ? 0.32 : 0.45;
  const std::array<Vector2d, 6> profile{Vector2d(0, 0),           Vector2d(r - 0.03, 0),
                                        Vector2d(r, height),      Vector2d(r - 0.01, height),
                                        Vector2d(r - 0.04, 0.02), Vector2d(0, 0.02)};
  TriangleMesh mesh;
  add_turned(mesh, profile, {0, 0}, variant < 2 ? dark : steel);
  add_cushion(mesh, {-0.07, -0.06, 0.015}, {0.06, 0.07, 0.16}, paper, make_pose({0, 0, 0}, 0.6));
  return mesh;
}

TriangleMesh coat_stand(int variant) {
  const Finish body = variant % 2 == 0 ? walnut : steel;
  TriangleMesh mesh;
  add_rod(mesh, {0, 0, 0.02}, {0, 0, 1.72}, 0.022, body);
  for (int i = 0; i < 4; ++i) {
    const double angle = std::numbers::pi * (0.25 + 0.5 * i);
    const Vector2d out(std::cos(angle), std::sin(angle));
    add_rod(mesh, {0.01 * out.x(), 0.01 * out.y(), 0.10}, {0.26 * out.x(), 0.26 * out.y(), 0.015},
            0.014, body);
    add_rod(mesh, {0.01 * out.x(), 0.01 * out.y(), 1.58}, {0.14 * out.x(), 0.14 * out.y(), 1.72},
            0.010, body);
  }
  constexpr std::array<Finish, kVariants> coats{blue_fabric, red_fabric, grey_fabric, green_fabric};
  add_cushion(mesh, {0.05, -0.20, 0.75}, {0.15, 0.20, 1.62},
              coats[static_cast<std::size_t>(variant)]);
  return mesh;
}

TriangleMesh window(int variant) {
  const double half = variant % 2 == 0 ? 0.9 : 0.7;
  TriangleMesh mesh;
  add_block(mesh, {-0.005, -half, 0.85}, {0.012, half, 1.90}, white, view);
  for (const double z : {0.85, 1.86}) add_block(mesh, {0, -half, z}, {0.03, half, z + 0.04}, white);
  for (const double y : {-half, -0.02, half - 0.04}) {
    add_block(mesh, {0, y, 0.86}, {0.028, y + 0.04, 1.89}, white);
  }
  return mesh;
}

TriangleMesh whiteboard(int variant) {
  const double half = variant % 2 == 0 ? 0.9 : 0.6;
  TriangleMesh mesh;
  add_block(mesh, {-0.005, -half, 0.90}, {0.02, half, 1.80}, steel);
  add_block(mesh, {0.01, -half + 0.02, 0.92}, {0.024, half - 0.02, 1.78}, white);
  add_block(mesh, {0.0, -0.3, 0.87}, {0.03, 0.3, 0.89}, grey);
  add_block(mesh, {0.015, -half + 0.1, 1.25}, {0.026, -half + 0.34, 1.6}, paper);
  return mesh;
}

TriangleMesh poster(int variant) {
  const double half = variant % 2 == 0 ? 0.30 : 0.42;
  TriangleMesh mesh;
  add_block(mesh, {-0.005, -half - 0.02, 0.93}, {0.015, half + 0.02, 1.77},
            variant < 2 ? dark : oak);
  add_block(mesh, {0.0, -half, 0.95}, {0.018, half, 1.75}, white,
            variant == 3 ? Finish::view : Finish::poster);
  return mesh;
}

}  // namespace vantage::office
