#include "vantage/building/building_frame.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "vantage/building/line_crossings.hpp"

namespace vantage {
namespace {

constexpr double kQuarterTurn_rad = 0.5 * std::numbers::pi;

struct Facing {
  double heading_rad;  ///< in [0, a quarter turn)
  double area_m2;
};

std::vector<Facing> upright_faces(const BuildingMesh& mesh) {
  constexpr double kUpright = 0.1;
  std::vector<Facing> faces;
  for (const Triangle& t : mesh.triangles) {
    const Eigen::Vector3d normal = mesh.normal(t);
    if (std::abs(normal.z()) > kUpright * normal.norm()) continue;
    const double heading_rad = std::atan2(normal.y(), normal.x());
    faces.push_back({heading_rad - kQuarterTurn_rad * std::floor(heading_rad / kQuarterTurn_rad),
                     0.5 * normal.norm()});
  }
  return faces;
}

/// From `a` to `b`, the shorter way.
double turn_rad(double a_rad, double b_rad) {
  return std::remainder(b_rad - a_rad, kQuarterTurn_rad);
}

std::vector<double> evenly_spaced(double low_m, double high_m, double step_m) {
  std::vector<double> places;
  for (double at_m = low_m + 0.5 * step_m; at_m < high_m; at_m += step_m) places.push_back(at_m);
  return places;
}

/// Heights that one can stand at, ascending: of surfaces that face up or, if none does, of all.
std::vector<double> standing_heights_m(const BuildingMesh& mesh, bool facing_up) {
  constexpr double kHeadroom_m = 1.5;
  Eigen::AlignedBox3d box_m;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) box_m.extend(mesh.corner(t, i));
  }
  const double step_m = std::max(0.1, box_m.sizes().head<2>().maxCoeff() / 1000.0);
  const auto crossings = line_crossings(mesh, mesh.triangles, 2,
                                        evenly_spaced(box_m.min().x(), box_m.max().x(), step_m),
                                        evenly_spaced(box_m.min().y(), box_m.max().y(), step_m));
  std::vector<double> heights_m;
  for (std::size_t i = 0; i < crossings.size(); ++i) {
    const bool highest = i + 1 == crossings.size() || crossings[i + 1].line != crossings[i].line;
    if (facing_up && crossings[i].side < 0) continue;
    if (highest || crossings[i + 1].at_m - crossings[i].at_m >= kHeadroom_m) {
      heights_m.push_back(crossings[i].at_m);
    }
  }
  std::ranges::sort(heights_m);
  return heights_m;
}

}  // namespace

double wall_heading_rad(const BuildingMesh& mesh) {
  constexpr int kBins = 180;
  constexpr double kWide_rad = 0.0175;
  constexpr double kMost = 0.3;  // of the walls
  const std::vector<Facing> faces = upright_faces(mesh);
  std::vector<double> area_m2(kBins, 0.0);
  double all_m2 = 0.0;
  for (const Facing& face : faces) {
    const auto bin = static_cast<int>(face.heading_rad / kQuarterTurn_rad * kBins);
    area_m2[static_cast<std::size_t>(std::clamp(bin, 0, kBins - 1))] += face.area_m2;
    all_m2 += face.area_m2;
  }
  const auto peak = std::ranges::max_element(area_m2) - area_m2.begin();
  const double peak_rad = (static_cast<double>(peak) + 0.5) * kQuarterTurn_rad / kBins;
  double near_m2 = 0.0;
  double sum = 0.0;
  for (const Facing& face : faces) {
    const double off_rad = turn_rad(peak_rad, face.heading_rad);
    if (std::abs(off_rad) > kWide_rad) continue;
    near_m2 += face.area_m2;
    sum += face.area_m2 * off_rad;
  }
  if (!(near_m2 > kMost * all_m2)) return 0.0;
  const double heading_rad = turn_rad(0.0, peak_rad + sum / near_m2);
  return std::abs(heading_rad) < 1e-5 ? 0.0 : heading_rad;
}

std::optional<double> floor_height_m(const BuildingMesh& mesh) {
  constexpr double kLevel_m = 0.05;
  constexpr double kShare = 0.25;
  std::vector<double> heights_m = standing_heights_m(mesh, true);
  if (heights_m.empty()) heights_m = standing_heights_m(mesh, false);
  if (heights_m.empty()) return std::nullopt;
  const auto in_level = [&](double low_m) {
    return std::ranges::upper_bound(heights_m, low_m + kLevel_m) -
           std::ranges::lower_bound(heights_m, low_m);
  };
  std::ptrdiff_t most = 0;
  for (const double low_m : heights_m) most = std::max(most, in_level(low_m));
  for (std::size_t i = 0; i < heights_m.size(); ++i) {
    const std::ptrdiff_t count = in_level(heights_m[i]);
    if (static_cast<double>(count) >= kShare * static_cast<double>(most)) {
      return heights_m[i + static_cast<std::size_t>(count / 2)];
    }
  }
  return std::nullopt;
}

void transform(BuildingMesh& mesh, const Eigen::Isometry3d& T_scene_mesh) {
  for (Eigen::Vector3d& p_m : mesh.vertices_m) p_m = T_scene_mesh * p_m;
}

}  // namespace vantage
