/// A run folder as the recorder leaves it, with made-up numbers: a sphere, a box and a mug on a
/// table, found by nine scans round it.
#pragma once

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "vantage/belief/map/occupancy_grid.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/rng.hpp"
#include "vantage/geometry/pose.hpp"
#include "vantage/report/report_data.hpp"

namespace vantage::support {

inline constexpr int kSampleScans = 9;

inline GridFrame sample_frame() {
  return make_grid_frame({0.0, 0.0, 0.972}, {1.0, 1.0, 0.504}, {129, 129, 65});
}

/// Distance to the nearest object's surface, negative inside, in m; p in the world.
inline double sample_distance(const Eigen::Vector3d& p) {
  const double table_z = 0.72;
  const auto sphere = [&](double x, double y, double r) {
    return (p - Eigen::Vector3d(x, y, table_z + r)).norm() - r;
  };
  const auto box = [&](double x, double y, double yaw, const Eigen::Vector3d& half) {
    const Eigen::Vector3d q = make_pose({x, y, table_z + half.z()}, yaw).inverse() * p;
    return (q.cwiseAbs() - half).maxCoeff();
  };
  const auto mug = [&](double x, double y, double yaw) {
    const Eigen::Vector3d q = make_pose({x, y, table_z}, yaw).inverse() * p;
    const double radius = q.head<2>().norm();
    const double wall = std::max(std::abs(radius - 0.055) - 0.006, std::abs(q.z() - 0.07) - 0.07);
    const double floor = std::max(radius - 0.055, std::abs(q.z() - 0.006) - 0.006);
    const double ring = std::hypot(q.x() - 0.055, q.z() - 0.07) - 0.042;
    const double handle = q.x() > 0.055 ? std::hypot(ring, q.y()) - 0.010 : 1.0;
    return std::min({wall, floor, handle});
  };
  const auto bottle = [&](double x, double y) {
    const double radius = std::hypot(p.x() - x, p.y() - y);
    const double h = p.z() - table_z;
    const double neck = 0.016 + 0.024 * std::clamp((0.24 - h) / 0.06, 0.0, 1.0);
    return std::max(radius - neck, std::abs(h - 0.15) - 0.15);
  };
  return std::min({sphere(-0.2, 0.2, 0.09), box(0.2, 0.22, 0.5, {0.12, 0.05, 0.15}),
                   mug(0.12, -0.2, -0.6), bottle(-0.28, -0.12), sphere(0.33, -0.02, 0.045),
                   box(-0.08, -0.32, -0.2, {0.09, 0.06, 0.03})});
}

/// Cells on the objects' surfaces occupied, those outside near them free, the rest unobserved.
inline OccupancyGrid sample_grid() {
  OccupancyGrid grid(sample_frame());
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const double distance = sample_distance(grid.frame.centre(grid.frame.cell(i)));
    if (std::abs(distance) < 0.006) grid.log_odds[i] = 3.0F;
    if (distance >= 0.006) grid.log_odds[i] = -3.0F;
  }
  return grid;
}

inline Pose sample_view(int id) {
  const int place = id / 3;
  const double azimuth = 2.0 * std::numbers::pi * place / 10.0;
  const double yaw = azimuth + std::numbers::pi + (id % 3 - 1) * std::numbers::pi / 12.0;
  return make_pose({1.15 * std::cos(azimuth), 1.15 * std::sin(azimuth), 1.17}, yaw);
}

inline int sample_choice(int scan) { return scan == 0 ? 1 : 3 * (scan * 3 % 10) + scan % 3; }

/// The first scan that comes from the side a cell looks to.
inline std::uint16_t sample_step(const Eigen::Vector3d& p) {
  int best = 0;
  double nearest = 1e9;
  for (int scan = 0; scan < kSampleScans; ++scan) {
    const double distance =
        (sample_view(sample_choice(scan)).translation() - p).norm() + 0.04 * scan;
    if (distance < nearest) best = scan;
    nearest = std::min(nearest, distance);
  }
  return static_cast<std::uint16_t>(best);
}

inline VoxelMap sample_voxels(const OccupancyGrid& grid) {
  VoxelMap map{grid.frame.cell_size_m, grid.frame.box(), {}};
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const CellState state = grid.state(i);
    if (state == CellState::free) continue;
    const Eigen::Vector3d p = grid.frame.centre(grid.frame.cell(i));
    const Eigen::Vector3f q = p.cast<float>();
    const bool occupied = state == CellState::occupied;
    map.voxels.push_back({q.x(), q.y(), q.z(), occupied ? sample_step(p) : std::uint16_t{0},
                          occupied ? kVoxelOccupied : kVoxelUnobserved});
  }
  return map;
}

inline nlohmann::json view_json(const Pose& T) {
  const Eigen::Vector3d p = T.translation();
  return {{"x_m", p.x()}, {"y_m", p.y()}, {"z_m", p.z()}, {"yaw_rad", project_to_se2(T).yaw_rad}};
}

inline nlohmann::json sample_scan(int scan, Rng& rng) {
  const double left = 118000.0 * std::exp(-0.42 * scan) + 4200.0;
  const double actual = scan == 0 ? 152340.0 : 0.42 * left + rng.uniform(-3000.0, 3000.0);
  nlohmann::json predicted = nlohmann::json::object();
  const std::pair<const char*, double> gains[] = {
      {"simple", 1.9},          {"visibility_weighted", 1.3}, {"beer_lambert", 1.15},
      {"posterior_chain", 0.3}, {"adaptive", 1.04},           {"nearest_frontier", 1.9}};
  for (const auto& [name, bias] : gains) {
    predicted[name] = std::round(actual * (bias + rng.uniform(-0.1, 0.1)));
  }
  const double before_m = std::abs(rng.normal(0.02 + 0.004 * scan, 0.008));
  return {{"time_s", 14.0 + 21.5 * scan},
          {"unobserved_cells", std::round(left + 310000.0)},
          {"observable_unobserved_cells", std::round(left)},
          {"predicted", predicted},
          {"actual_new_cells", std::round(actual)},
          {"chosen_view", scan == 0 ? -1 : sample_choice(scan)},
          {"candidates", 30},
          {"plan_time_s", 0.05 + 0.02 * rng.uniform()},
          {"leg_length_m", scan == 0 ? 0.0 : 1.1 + 0.8 * rng.uniform()},
          {"pose_error_m", 0.003 + 0.002 * rng.uniform()},
          {"pose_error_before_registration_m", before_m},
          {"fallback", scan == 4},
          {"view", view_json(sample_view(sample_choice(scan)))}};
}

inline nlohmann::json sample_metrics() {
  Rng rng(7);
  nlohmann::json metrics = {{"task", "next_best_view"},
                            {"status", "completed"},
                            {"seed", 7},
                            {"scene", "tabletop, 8 objects"},
                            {"method", "adaptive"},
                            {"simulated_time_s", 192.4},
                            {"wall_time_s", 61.7},
                            {"real_time_factor", 3.118},
                            {"path_length_m", 12.31},
                            {"collisions", 0},
                            {"observable_cells", 274540},
                            {"state_hash", "9f2c41d07be6a813"},
                            {"observability", 0.9962},
                            {"map", {{"precision", 0.981}, {"recall", 0.934}}}};
  double path_length_m = 0.0;
  for (int scan = 0; scan < kSampleScans; ++scan) {
    metrics["scans"].push_back(sample_scan(scan, rng));
    path_length_m += metrics["scans"].back()["leg_length_m"].get<double>();
    metrics["scans"].back()["path_length_m"] = path_length_m;
  }
  metrics["path_length_m"] = path_length_m;
  for (int id = 0; id < 30; ++id) {
    metrics["candidates"].push_back(view_json(sample_view(id)));
    metrics["candidates"].back()["id"] = id;
  }
  const Eigen::AlignedBox3d box = sample_frame().box();
  metrics["region"] = {{"min_m", {box.min().x(), box.min().y(), box.min().z()}},
                       {"max_m", {box.max().x(), box.max().y(), box.max().z()}}};
  return metrics;
}

/// Round the table from view to view, `drift_m` off the true path.
inline std::string sample_trajectory(double drift_m) {
  std::string text = "# time_s x y z qx qy qz qw\n";
  for (int scan = 0; scan + 1 < kSampleScans; ++scan) {
    const Eigen::Vector3d from = sample_view(sample_choice(scan)).translation();
    const Eigen::Vector3d to = sample_view(sample_choice(scan + 1)).translation();
    const double start = std::atan2(from.y(), from.x());
    const double turn = wrap_angle(std::atan2(to.y(), to.x()) - start);
    for (int k = 0; k < 60; ++k) {
      const double angle = start + turn * k / 60.0;
      const double radius_m = 1.15 + drift_m * std::sin(5.0 * angle + scan) +
                              0.12 * std::sin(std::numbers::pi * k / 60.0);
      text += fmt::format("{:.2f} {:.4f} {:.4f} 0 0 0 {:.5f} {:.5f}\n",
                          14.0 + 21.5 * (scan + k / 60.0), radius_m * std::cos(angle),
                          radius_m * std::sin(angle), std::sin(0.5 * angle), std::cos(0.5 * angle));
    }
  }
  return text;
}

inline std::string sample_steps(const nlohmann::json& metrics) {
  std::string text =
      "time_s,scan,chosen_view,fallback,unobserved_cells,observable_unobserved_cells,"
      "actual_new_cells,plan_time_s,path_length_m,leg_length_m,pose_error_m\n";
  int number = 0;
  for (const auto& s : metrics["scans"]) {
    text += fmt::format(
        "{},{},{},{},{},{},{},{},{},{},{}\n", s["time_s"].get<double>(), ++number,
        s["chosen_view"].get<int>(), s["fallback"].get<bool>(), s["unobserved_cells"].get<double>(),
        s["observable_unobserved_cells"].get<double>(), s["actual_new_cells"].get<double>(),
        s["plan_time_s"].get<double>(), s["path_length_m"].get<double>(),
        s["leg_length_m"].get<double>(), s["pose_error_m"].get<double>());
  }
  return text;
}

inline void write_sample_run(const std::filesystem::path& folder) {
  const nlohmann::json metrics = sample_metrics();
  write_file(folder / "metrics.json", metrics.dump(1));
  write_file(folder / "manifest.json",
             R"({"command": "vantage run --seed 7", "versions": {"vantage": "0.1.0"}, "seed": 7})");
  write_file(folder / "config.yaml", "seed: 7\nscans: 9\ngain:\n  name: adaptive\n");
  write_file(folder / "steps.csv", sample_steps(metrics));
  write_file(folder / "trajectory.tum", sample_trajectory(0.0));
  write_file(folder / "trajectory_estimated.tum", sample_trajectory(0.03));
  static const VoxelMap map = sample_voxels(sample_grid());
  write_voxels(folder / "voxels.bin", map);
}

}  // namespace vantage::support
