#include "vantage/models/catalogue/flight/flight_scene.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace vantage {
namespace {

using Eigen::Vector2d;
using Polyline = std::vector<Vector2d>;

FlightScene scenario_1() {
  return {.name = "trajectory_1",
          .about = "45 waypoints, 5 objects: lanes along the room, then across it",
          .room_m = {10.0, 10.0},
          .corners_m = {{-3.6, -2.6},
                        {3.0, -2.6},
                        {3.65, -1.95},
                        {3.0, -1.3},
                        {-2.6, -1.3},
                        {-3.6, -0.3},
                        {-2.6, 0.7},
                        {3.2, 0.7},
                        {3.85, 1.35},
                        {3.2, 2.0},
                        {0.2, 2.0},
                        {-0.6, 1.2},
                        {-0.6, -3.2},
                        {0.4, -4.0},
                        {1.4, -3.2},
                        {1.4, 2.3},
                        {0.6, 3.1},
                        {-2.4, 3.1}},
          .waypoints = 45,
          .support_surfaces = {{{-1.35, -1.95}, 0.80},
                               {{0.4, -0.3}, 0.84, 0.4},
                               {{2.5, -0.3}, 0.78, 0.0, true},
                               {{0.6, 1.35}, 0.80, -0.3},
                               {{-1.6, -0.3}, 0.82, 0.0, true}},
          .obstacles = {{"sideboard", {4.7, -0.8}, {0.5, 1.4, 0.75}},
                        {"cupboard", {-4.7, 2.6}, {0.5, 1.2, 2.0}}}};
}

FlightScene scenario_2() {
  return {.name = "trajectory_2",
          .about = "45 waypoints, 7 objects: to and fro",
          .room_m = {11.0, 8.4},
          .corners_m = {{-4.2, -3.2},
                        {3.3, -3.2},
                        {3.9, -2.55},
                        {3.3, -1.9},
                        {-3.1, -1.9},
                        {-4.0, -0.95},
                        {-3.1, 0.0},
                        {3.3, 0.0},
                        {3.9, 0.65},
                        {3.3, 1.3},
                        {-3.2, 1.3},
                        {-3.9, 1.95},
                        {-3.2, 2.6},
                        {4.0, 2.6}},
          .waypoints = 45,
          .support_surfaces = {{{-1.9, -2.5}, 0.80, 0.2},
                               {{1.2, -2.6}, 0.82, 0.0, true},
                               {{-0.4, -0.95}, 0.78},
                               {{2.0, -0.9}, 0.84, 0.6},
                               {{-2.0, 0.6}, 0.80, 0.0, true},
                               {{1.0, 0.7}, 0.80, -0.2},
                               {{-0.4, 1.95}, 0.82}},
          .obstacles = {{"sideboard", {-1.0, 3.9}, {1.6, 0.45, 0.8}},
                        {"column", {-4.7, -0.2}, {0.3, 0.3, 2.5}}}};
}

FlightScene scenario_3() {
  return {.name = "trajectory_3",
          .about = "56 waypoints, 10 objects: to and fro, obstacles where one would turn aside",
          .room_m = {11.4, 9.4},
          .corners_m = {{-4.4, -3.4},
                        {3.6, -3.4},
                        {4.25, -2.75},
                        {3.6, -2.1},
                        {-3.2, -2.1},
                        {-4.2, -1.1},
                        {-3.2, -0.1},
                        {3.6, -0.1},
                        {4.25, 0.55},
                        {3.6, 1.2},
                        {-3.2, 1.2},
                        {-4.2, 2.2},
                        {-3.2, 3.2},
                        {4.6, 3.2}},
          .waypoints = 56,
          .support_surfaces = {{{-2.6, -2.75}, 0.80, 0.3},
                               {{-0.5, -2.8}, 0.82, 0.0, true},
                               {{1.8, -2.75}, 0.78},
                               {{-0.9, -1.1}, 0.80, 0.0, true},
                               {{2.5, -1.15}, 0.84, 0.5},
                               {{-2.0, 0.5}, 0.80},
                               {{0.1, 0.6}, 0.80, 0.0, true},
                               {{2.2, 0.55}, 0.82, -0.4},
                               {{-1.2, 2.25}, 0.78, 0.2},
                               {{1.7, 2.6}, 0.80, 0.0, true}},
          .obstacles = {{"column", {0.7, -1.1}, {0.26, 0.26, 2.5}},
                        {"column", {-2.45, -1.1}, {0.24, 0.24, 2.5}},
                        {"column", {0.4, 2.2}, {0.26, 0.26, 2.5}},
                        {"column", {3.0, 2.2}, {0.24, 0.24, 2.5}},
                        {"cupboard", {4.15, -1.1}, {0.4, 0.6, 2.0}}}};
}

FlightScene scenario_4() {
  return {.name = "trajectory_4",
          .about = "44 waypoints, 4 objects: a flying arena",
          .room_m = {8.6, 6.4},
          .corners_m = {{-3.4, -2.05},
                        {2.4, -2.05},
                        {2.95, -1.5},
                        {2.4, -0.95},
                        {-2.4, -0.95},
                        {-3.2, 0.0},
                        {-2.4, 0.95},
                        {2.4, 0.95},
                        {2.95, 1.5},
                        {2.4, 2.05},
                        {-3.0, 2.05}},
          .waypoints = 44,
          .support_surfaces = {{{-0.9, -1.5}, 0.80},
                               {{0.7, -1.5}, 0.82, 0.0, true},
                               {{0.7, 1.5}, 0.80, 0.3},
                               {{-0.9, 0.0}, 0.78, 0.0, true}}};
}

Polyline cut_corners(const Polyline& line) {
  Polyline cut{line.front()};
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    cut.push_back(0.75 * line[i] + 0.25 * line[i + 1]);
    cut.push_back(0.25 * line[i] + 0.75 * line[i + 1]);
  }
  cut.push_back(line.back());
  return cut;
}

Polyline rounded(const FlightScene& scene) {
  Polyline line = scene.corners_m;
  for (int i = 0; i < 4; ++i) line = cut_corners(line);
  return line;
}

Polyline evenly(const Polyline& line, int points) {
  std::vector<double> run_m{0.0};
  for (std::size_t i = 1; i < line.size(); ++i) {
    run_m.push_back(run_m.back() + (line[i] - line[i - 1]).norm());
  }
  Polyline even;
  std::size_t k = 0;
  for (int i = 0; i < points; ++i) {
    const double at_m = run_m.back() * i / (points - 1);
    while (k + 2 < run_m.size() && run_m[k + 1] < at_m) ++k;
    const double share = (at_m - run_m[k]) / (run_m[k + 1] - run_m[k]);
    even.push_back(line[k] + share * (line[k + 1] - line[k]));
  }
  return even;
}

double distance_m(const FlightObstacle& obstacle, const Vector2d& p) {
  const Vector2d off = Eigen::Rotation2Dd(-obstacle.yaw_rad) * Vector2d(p - obstacle.p_world_m);
  if (obstacle.kind == "column") return off.norm() - 0.5 * obstacle.size_m.x();
  const Vector2d beyond = off.cwiseAbs() - 0.5 * obstacle.size_m.head<2>();
  return beyond.cwiseMax(0.0).norm();
}

}  // namespace

std::vector<FlightScene> flight_scenes() {
  return {scenario_1(), scenario_2(), scenario_3(), scenario_4()};
}

std::vector<PathPoint> flight_path_points(const FlightScene& scene) {
  const Polyline even = evenly(rounded(scene), scene.waypoints);
  std::vector<PathPoint> points;
  for (std::size_t i = 0; i < even.size(); ++i) {
    const Vector2d along = even[std::min(i + 1, even.size() - 1)] - even[i == 0 ? 0 : i - 1];
    points.push_back({even[i], std::atan2(along.y(), along.x())});
  }
  return points;
}

double path_clearance_m(const FlightScene& scene) {
  double min_m = std::numeric_limits<double>::infinity();
  for (const Vector2d& p : evenly(rounded(scene), 2000)) {
    min_m = std::min(min_m, (0.5 * scene.room_m - p.cwiseAbs()).minCoeff());
    for (const FlightObstacle& obstacle : scene.obstacles) {
      min_m = std::min(min_m, distance_m(obstacle, p));
    }
  }
  return min_m;
}

}  // namespace vantage
