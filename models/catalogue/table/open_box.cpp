#include "vantage/models/catalogue/table/open_box.hpp"

#include <array>
#include <cmath>
#include <utility>

namespace vantage {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kSizeSpread = 0.08;
constexpr double kHeadroom_m = 0.01;     // between a thing and what is above it
constexpr double kLeastRoom_m = 0.06;    // on top of a box, for anything to be put there
constexpr double kFromTheEdge_m = 0.02;  // of a top

struct Make {
  std::string_view name;
  Vector3d size_m;
  double wall_m;
  int tiers;
  int columns;
  std::string_view material;
};

const Make& make_of(OpenBox::Kind kind) {
  static const std::array<Make, 4> makes{
      {{"shelf", {0.19, 0.40, 0.33}, 0.012, 2, 1, "pine"},
       {"pigeonholes", {0.20, 0.40, 0.29}, 0.010, 2, 2, "pine"},
       {"crate", {0.23, 0.32, 0.24}, 0.012, 1, 1, "dark_wood"},
       {"carton", {0.22, 0.27, 0.21}, 0.005, 1, 1, "cardboard"}}};
  return makes[static_cast<std::size_t>(kind)];
}

}  // namespace

std::string_view kind_name(OpenBox::Kind kind) { return make_of(kind).name; }

OpenBox make_open_box(OpenBox::Kind kind, Rng& rng) {
  OpenBox box{.kind = kind, .size_m = make_of(kind).size_m, .T_world_box = {}};
  for (double& edge_m : box.size_m) {
    edge_m = std::round(1e3 * edge_m * rng.uniform(1.0 - kSizeSpread, 1.0)) / 1e3;
  }
  return box;
}

std::vector<Board> boards(const OpenBox& box) {
  const Make& make = make_of(box.kind);
  const Vector3d half = 0.5 * box.size_m;
  const double wall = 0.5 * make.wall_m;
  const double middle = half.z();
  const double inner_y = half.y() - 2.0 * wall;
  const double inner_z = half.z() - 2.0 * wall;
  std::vector<Board> all{
      {"back", {-half.x() + wall, 0.0, middle}, {wall, inner_y, inner_z}, make.material},
      {"left", {0.0, half.y() - wall, middle}, {half.x(), wall, inner_z}, make.material},
      {"right", {0.0, -half.y() + wall, middle}, {half.x(), wall, inner_z}, make.material},
      {"bottom", {0.0, 0.0, wall}, {half.x(), half.y(), wall}, make.material},
      {"top", {0.0, 0.0, 2.0 * half.z() - wall}, {half.x(), half.y(), wall}, make.material}};
  if (make.tiers == 2) {
    all.push_back({"shelf", {wall, 0.0, middle}, {half.x() - wall, inner_y, wall}, make.material});
  }
  if (make.columns == 2) {
    const double half_z = 0.5 * (inner_z - wall);
    for (const auto& [name, side] : {std::pair{"low_upright", -1.0}, {"high_upright", 1.0}}) {
      all.push_back({name,
                     {wall, 0.0, middle + side * (wall + half_z)},
                     {half.x() - wall, wall, half_z},
                     make.material});
    }
  }
  return all;
}

std::vector<Compartment> compartments(const OpenBox& box, double limit_m) {
  const Make& make = make_of(box.kind);
  const Vector3d half = 0.5 * box.size_m;
  const double tier_m = (box.size_m.z() - make.wall_m) / make.tiers;
  const double column_m = (box.size_m.y() - make.wall_m) / make.columns;
  std::vector<Compartment> all;
  for (int tier = 0; tier < make.tiers; ++tier) {
    for (int column = 0; column < make.columns; ++column) {
      const double right = -half.y() + make.wall_m + column * column_m;
      all.push_back({.min_m = {-half.x() + make.wall_m, right},
                     .max_m = {half.x(), right + column_m - make.wall_m},
                     .floor_m = make.wall_m + tier * tier_m,
                     .height_m = tier_m - make.wall_m - kHeadroom_m});
    }
  }
  const double room_m = limit_m - box.size_m.z();
  if (room_m >= kLeastRoom_m) {
    const Vector2d edge = half.head<2>() - Vector2d::Constant(kFromTheEdge_m);
    all.push_back({.min_m = -edge,
                   .max_m = edge,
                   .floor_m = box.size_m.z(),
                   .height_m = room_m,
                   .inside = false});
  }
  return all;
}

Outline outline(const OpenBox& box, double front_m) {
  const double x = 0.5 * box.size_m.x();
  const double y = 0.5 * box.size_m.y();
  return {{-x, -y}, {x + front_m, -y}, {x + front_m, y}, {-x, y}};
}

}  // namespace vantage
